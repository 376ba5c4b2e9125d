# -DCOMMAND= mpiexec on 3 ranks, -DPROGRAM= messages, -DWRAPPER= the library, -DFOLDER= to write in
set(file ${FOLDER}/counts.txt)
function(run result seed delay least)
  file(REMOVE ${file})
  execute_process(COMMAND ${COMMAND} ${CMAKE_COMMAND} -E env LD_PRELOAD=${WRAPPER} PLATEN_DELAY_SEED=${seed}
      PLATEN_DELAY_US=${delay} PLATEN_MPI_COUNT_FILE=${file} ${PROGRAM} ${least}
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0 OR NOT EXISTS ${file})
    message(FATAL_ERROR "status ${status}\n${output}")
  endif()
  file(READ ${file} text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# 10 rounds of 800 bytes and 4 times 20; rank 0 twice 8 more. An Allreduce of 24 bytes, an Iallreduce of 4, an Allgatherv
# of 4 (rank + 1).
set(expected "rank 0 of 3: messages 16 bytes 8096 collectives 3 collective_bytes 32 delays 0 delayed_us 0
rank 1 of 3: messages 14 bytes 8080 collectives 3 collective_bytes 36 delays 0 delayed_us 0
rank 2 of 3: messages 14 bytes 8080 collectives 3 collective_bytes 40 delays 0 delayed_us 0
")
run(quiet 1 0 0)
if(NOT quiet STREQUAL expected)
  message(FATAL_ERROR "without delays:\n${quiet}expected:\n${expected}")
endif()

# 30 calls of up to 4 ms in the rounds: 60 ms in the mean, half of it at least.
run(first 1 4000 30)
run(again 1 4000 30)
run(other 2 4000 30)
if(NOT first STREQUAL again)
  message(FATAL_ERROR "the same seed, other delays:\n${first}${again}")
endif()
if(first STREQUAL other)
  message(FATAL_ERROR "another seed, the same delays:\n${first}")
endif()
# Delays change no count, and each rank has its own.
string(REGEX REPLACE "delays [0-9]+ delayed_us [0-9]+" "delays 0 delayed_us 0" without "${first}")
if(NOT without STREQUAL expected)
  message(FATAL_ERROR "with delays:\n${first}expected but for these:\n${expected}")
endif()
string(REGEX MATCHALL "delayed_us [0-9]+" times "${first}")
list(REMOVE_DUPLICATES times)
list(LENGTH times different)
if(NOT different EQUAL 3)
  message(FATAL_ERROR "ranks with the same delays:\n${first}")
endif()
