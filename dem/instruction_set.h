// Sets of instructions that the kernels are compiled for; one is chosen at run time.
#pragma once

namespace platen::dem {

enum class InstructionSet { baseline, avx2, avx512 };
InstructionSet best_instruction_set(); // that this processor has
const char *name(InstructionSet set);

} // namespace platen::dem
