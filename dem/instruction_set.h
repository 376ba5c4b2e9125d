// Sets of instructions that the kernels are compiled for; one is chosen at run time.
#pragma once

namespace platen::dem {

enum class InstructionSet { baseline, avx2, avx512 };
InstructionSet best_instruction_set(); // that this processor has
const char *name(InstructionSet set);

// Of what exists once for each set, that of `set`.
template <class T>
const T &for_set(InstructionSet set, const T &baseline, const T &avx2, const T &avx512) {
  return set == InstructionSet::avx512 ? avx512 : (set == InstructionSet::avx2 ? avx2 : baseline);
}

} // namespace platen::dem
