# Installs what was built, checks an installed scene with the installed program, and configures, builds and runs the
# installed examples against it as a user would.
# -DBUILD= of the project, -DAPPS= whether it has programs, -DFOLDER= to work in, -DCOMPILER=, -DGENERATOR=
function(run_all)
  foreach(command IN LISTS ARGN)
    string(REPLACE "|" ";" command "${command}")
    execute_process(COMMAND ${command} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
    message("${output}")
    if(NOT status EQUAL 0)
      message(FATAL_ERROR "status ${status}: ${command}")
    endif()
  endforeach()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run_all("${CMAKE_COMMAND}|--install|${BUILD}|--prefix|${FOLDER}/prefix")
set(share ${FOLDER}/prefix/share/platen)
set(EXAMPLES ${share}/examples)

# What the documents and scenes name by its path is there.
foreach(document IN ITEMS README.md docs/scene_files.md docs/theory.md docs/accuracy.md)
  file(READ ${share}/${document} text)
  get_filename_component(folder ${document} DIRECTORY)
  string(REPLACE "](" "link=" text "${text}")
  string(REGEX REPLACE "[][;]" "" text "${text}") # which CMake's lists would take for their own
  string(REGEX MATCHALL "link=[A-Za-z0-9_./-]+\\.(md|png|prm|py|sh)" links "${text}")
  foreach(link IN LISTS links)
    string(SUBSTRING "${link}" 5 -1 link)
    if(NOT EXISTS ${share}/${folder}/${link} AND NOT link MATCHES "CONTRIBUTING|CHANGELOG")
      message(FATAL_ERROR "${share}/${document} names ${link}, which is not installed")
    endif()
  endforeach()
endforeach()

if(APPS)
  # A scene that includes a part and has meshes; from elsewhere, so that nothing of the sources helps.
  file(MAKE_DIRECTORY ${FOLDER}/elsewhere)
  execute_process(COMMAND ${FOLDER}/prefix/bin/platen-compress ${share}/scenes/brush_platens.prm --dry-run
    WORKING_DIRECTORY ${FOLDER}/elsewhere RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE error)
  if(NOT status EQUAL 0 OR NOT output MATCHES "particles [1-9]")
    message(FATAL_ERROR "an installed scene: status ${status}\n${output}\n${error}")
  endif()
endif()
foreach(example_and_word IN ITEMS "crush|spheres: [1-9]" "extend|all holds")
  string(REGEX REPLACE "\\|.*" "" example "${example_and_word}")
  string(REGEX REPLACE "^[^|]*\\|" "" word "${example_and_word}")
  set(work ${FOLDER}/${example})
  run_all("${CMAKE_COMMAND}|-S|${EXAMPLES}/${example}|-B|${work}|-G|${GENERATOR}|-DCMAKE_CXX_COMPILER=${COMPILER}|-DCMAKE_PREFIX_PATH=${FOLDER}/prefix"
    "${CMAKE_COMMAND}|--build|${work}" "${work}/${example}")
  if(NOT output MATCHES "${word}")
    message(FATAL_ERROR "${example} did not print \"${word}\"")
  endif()
endforeach()
