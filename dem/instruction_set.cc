#include "dem/instruction_set.h"

namespace platen::dem {

InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

const char *name(InstructionSet set) {
  return for_set<const char *>(set, "baseline", "avx2", "avx512");
}

} // namespace platen::dem
