# Long forms of tests: plain ctest leaves them out, "ctest -C Long" runs them as well (scripts/test_long.sh).

# platen_long_gtest(PROGRAM PREFIX TEST...): each TEST is Suite.long_name of the gtest program PROGRAM. Its
# quick tests are without them (platen_suites).
function(platen_long_gtest program prefix)
  foreach(test ${ARGN})
    add_test(NAME ${prefix}${test} CONFIGURATIONS Long COMMAND ${program} --gtest_filter=${test})
    set_tests_properties(${prefix}${test} PROPERTIES LABELS long TIMEOUT 14400
      FAIL_REGULAR_EXPRESSION "0 tests from 0 test suites")
  endforeach()
endfunction()
