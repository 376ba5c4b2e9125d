# platen_bond_law(TARGET HEADER LAW): the loops over bonds of a law of TARGET's own, for each set of instructions. HEADER
# holds the class LAW, and declares outside_kernels<LAW>() (dem/laws/outside_law.h).
include(${CMAKE_CURRENT_LIST_DIR}/kernels.cmake)

function(platen_bond_law target header law)
  string(MAKE_C_IDENTIFIER "${law}" name)
  set(lanes_baseline 2)
  set(lanes_avx2 4)
  set(lanes_avx512 8)
  foreach(set baseline avx2 avx512)
    list(APPEND kernels ${name}_${set})
    set(declared "namespace platen::dem::kernels { struct BondKernels; extern const BondKernels ${name}_${set}; }\n")
    string(APPEND all "${declared}")
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_${set}.cc)
    file(GENERATE OUTPUT ${file} CONTENT "#include \"${header}\"
${declared}#define PLATEN_LANES ${lanes_${set}}
#define PLATEN_KERNELS ${name}_${set}
#define PLATEN_OUTSIDE_LAW ${law}
#include \"dem/kernels/bond_kernel.inc.h\"\n")
    target_sources(${target} PRIVATE ${file})
  endforeach()
  list(TRANSFORM kernels PREPEND "&kernels::")
  list(JOIN kernels ", " kernels)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${name}_kernels.cc)
  file(GENERATE OUTPUT ${file} CONTENT "#include \"${header}\"
${all}namespace platen::dem {
template <>
OutsideLaw::KernelsOfSets outside_kernels<${law}>() {
  return {${kernels}};
}
} // namespace platen::dem\n")
  target_sources(${target} PRIVATE ${file})
  platen_kernels(CONTRACTED ${CMAKE_CURRENT_BINARY_DIR}/${name})
endfunction()
