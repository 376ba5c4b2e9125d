// Instruction sets for which the kernels are compiled; one is chosen at run time.
#pragma once

namespace platen::dem {

enum class InstructionSet { baseline, avx2, avx512 };
InstructionSet best_instruction_set(); // of this processor
const char *name(InstructionSet set);

// Selects the variant for `set`.
template <class T>
const T &for_set(InstructionSet set, const T &baseline, const T &avx2, const T &avx512) {
  return set == InstructionSet::avx512 ? avx512 : (set == InstructionSet::avx2 ? avx2 : baseline);
}

} // namespace platen::dem
