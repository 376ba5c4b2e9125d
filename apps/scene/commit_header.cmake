# Writes a header that defines PLATEN_COMMIT, at each build, and touches it only where the commit has changed:
#   cmake -DSOURCE=<repository> -DHEADER=<file to write> -P commit_header.cmake
execute_process(COMMAND git -C "${SOURCE}" describe --always --dirty --abbrev=10 --exclude "*"
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failure)
if(failure)
  set(commit "unknown")
endif()
set(text "#define PLATEN_COMMIT \"${commit}\"\n")
if(EXISTS "${HEADER}")
  file(READ "${HEADER}" former)
endif()
if(NOT "${text}" STREQUAL "${former}")
  file(WRITE "${HEADER}" "${text}")
endif()
