# Tests by suite: one ctest for all tests of a gtest suite in one process, because most tests take less time than loading the
# libraries of their program. A failed test is named by its output; scripts/verification.py knows single tests by name.
if(CMAKE_SCRIPT_MODE_FILE)
  # As a script, after the program is built: writes LIST, with a test for each suite of PROGRAM.
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests --gtest_filter=-*.long_* OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "(^|\n)[^ \n][^ \n]*\\." suites "${listed}")
  string(REPLACE "," ";" properties "${PROPERTIES}")
  set(text "")
  foreach(suite IN LISTS suites)
    string(STRIP "${suite}" suite)
    string(REGEX REPLACE "\\.$" "" suite "${suite}")
    string(APPEND text "add_test(\"${PREFIX}${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*-*.long_*\")\n"
      "set_tests_properties(\"${PREFIX}${suite}\" PROPERTIES WORKING_DIRECTORY \"${FOLDER}\" ${properties})\n")
  endforeach()
  string(REPLACE ";" " " text "${text}")
  file(WRITE ${LIST} "${text}")
  return()
endif()

# platen_suites(PROGRAM PREFIX [PROPERTY VALUE]...): a test PREFIXSuite for each suite of PROGRAM, without its long forms.
function(platen_suites program prefix)
  set(list ${CMAKE_CURRENT_BINARY_DIR}/${program}_suites.cmake)
  string(REPLACE ";" "," properties "${ARGN}")
  add_custom_command(TARGET ${program} POST_BUILD BYPRODUCTS ${list} VERBATIM
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DPREFIX=${prefix} -DLIST=${list}
      "-DPROPERTIES=${properties}" -DFOLDER=${CMAKE_CURRENT_BINARY_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/suites.cmake)
  file(WRITE ${list}.in "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${program}_NOT_BUILT ${program}_NOT_BUILT)\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${list}.in)
endfunction()
