# Tests that run on several MPI ranks of this machine, more than it has cores, by anybody, root included.

set(platen_mpi_environment
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
  OMPI_MCA_hwloc_base_binding_policy=none # ranks of two tests would be bound to the same core
  OMPI_MCA_mpi_yield_when_idle=1          # a rank that waits leaves its core to the others
  OMPI_MCA_btl=self,vader OMPI_MCA_pml=ob1 # shared memory: no network is looked for
  OMPI_MCA_btl_vader_single_copy_mechanism=none) # which containers forbid

# platen_mpi_command(RESULT RANKS): mpiexec for so many ranks, to be followed by the program.
function(platen_mpi_command result ranks)
  set(${result} ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks} ${MPIEXEC_PREFLAGS} PARENT_SCOPE)
endfunction()

# platen_add_mpi_test(NAME name RANKS n... SOURCES file... [DELAYED n...] [LIBRARIES target...] [TIMEOUT seconds])
# A gtest program test_NAME with the main of tests/dist/mpi_main.cc, run as NAME.on_N_ranks, and as
# NAME.delayed_on_N_ranks with random delays before messages (tests/dist/delay). A run that hangs is ended after TIMEOUT
# by mpiexec, which tells so.
function(platen_add_mpi_test)
  cmake_parse_arguments(arg "" "NAME;TIMEOUT" "RANKS;DELAYED;SOURCES;LIBRARIES" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 60)
  endif()
  string(REPLACE "." "_" program test_${arg_NAME})
  add_executable(${program} ${arg_SOURCES} ${PROJECT_SOURCE_DIR}/tests/dist/mpi_main.cc)
  target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_link_libraries(${program} PRIVATE Platen::dist ${arg_LIBRARIES} platen_options GTest::gtest)
  foreach(ranks IN LISTS arg_RANKS)
    platen_mpi_command(run ${ranks})
    platen_register_mpi_test(${arg_NAME}.on_${ranks}_ranks ${ranks} ${arg_TIMEOUT} ${run} $<TARGET_FILE:${program}>)
  endforeach()
  if(PLATEN_SANITIZE) # its library must be loaded before any other
    set(arg_DELAYED "")
  endif()
  foreach(ranks IN LISTS arg_DELAYED)
    platen_mpi_command(run ${ranks})
    platen_register_mpi_test(${arg_NAME}.delayed_on_${ranks}_ranks ${ranks} ${arg_TIMEOUT} ${run}
      ${CMAKE_COMMAND} -E env LD_PRELOAD=$<TARGET_FILE:platen_mpi_delay> PLATEN_DELAY_US=300 PLATEN_DELAY_SEED=${ranks}
      $<TARGET_FILE:${program}>)
    add_dependencies(${program} platen_mpi_delay)
  endforeach()
endfunction()

function(platen_register_mpi_test name ranks timeout)
  add_test(NAME ${name} COMMAND ${ARGN})
  math(EXPR last "${timeout} + 20") # after mpiexec, which says what it ends
  set_tests_properties(${name} PROPERTIES TIMEOUT ${last}
    ENVIRONMENT "${platen_mpi_environment};MPIEXEC_TIMEOUT=${timeout}")
  if(ranks GREATER 1)
    set_tests_properties(${name} PROPERTIES PROCESSORS 2)
  endif()
endfunction()
