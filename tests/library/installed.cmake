# Installs what was built, and configures, builds and runs an example against it as a user would.
# -DBUILD= of the project, -DEXAMPLE= sources, -DFOLDER= to work in, -DCOMPILER=, -DGENERATOR=
file(REMOVE_RECURSE ${FOLDER})
foreach(command IN ITEMS
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${FOLDER}/prefix"
    "${CMAKE_COMMAND};-S;${EXAMPLE};-B;${FOLDER}/build;-G;${GENERATOR};-DCMAKE_CXX_COMPILER=${COMPILER};-DCMAKE_PREFIX_PATH=${FOLDER}/prefix"
    "${CMAKE_COMMAND};--build;${FOLDER}/build"
    "${FOLDER}/build/crush")
  execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  message("${output}")
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "status ${status}: ${command}")
  endif()
endforeach()
if(NOT output MATCHES "spheres: [1-9]")
  message(FATAL_ERROR "the example did not print a strength")
endif()
