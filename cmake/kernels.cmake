# Kernels are compiled once per instruction set, from NAME_baseline.cc, NAME_avx2.cc and NAME_avx512.cc, and one is chosen at
# run time. platen_kernels(CONTRACTED NAME ...): with fused multiply-add, which changes the last bits, so that the
# instruction set is part of what a result depends on; platen_kernels(EXACT NAME ...): the same bits from each.
set(platen_kernel_options -O3 -fno-math-errno -fno-trapping-math -fno-signed-zeros -Wno-psabi)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND platen_kernel_options -Wno-maybe-uninitialized) # GCC 12 takes lanes filled one by one for uninitialised
endif()
if(PLATEN_SANITIZE)
  list(TRANSFORM platen_kernel_options REPLACE "-O3" "-O1") # else minutes a file
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(platen_options_avx2 -mavx2)
  set(platen_options_avx512 -mavx512f -mavx512vl -mavx512dq -mprefer-vector-width=512)
  set(platen_contraction -mfma -ffp-contract=fast)
endif()

function(platen_kernels how)
  foreach(name IN LISTS ARGN)
    foreach(set baseline avx2 avx512)
      set(options ${platen_kernel_options} ${platen_options_${set}})
      if(how STREQUAL "EXACT")
        list(APPEND options -ffp-contract=off)
      elseif(NOT set STREQUAL "baseline")
        list(APPEND options ${platen_contraction})
      endif()
      set_source_files_properties(${name}_${set}.cc PROPERTIES COMPILE_OPTIONS "${options}")
    endforeach()
  endforeach()
endfunction()
