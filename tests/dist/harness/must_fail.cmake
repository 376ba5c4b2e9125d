# -DCOMMAND= a run of test_dist_harness, -DFILTER= its test, -DEXPECTED= what its output must match
execute_process(COMMAND ${COMMAND} --gtest_filter=${FILTER} RESULT_VARIABLE status OUTPUT_VARIABLE output
  ERROR_VARIABLE output)
message("${output}")
if(status EQUAL 0)
  message(FATAL_ERROR "a run with a fault on one rank ended with status 0")
endif()
if(NOT output MATCHES "${EXPECTED}")
  message(FATAL_ERROR "the output does not say \"${EXPECTED}\"")
endif()
