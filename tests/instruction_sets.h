// The instruction sets that this processor has, each once.
#pragma once

#include <vector>

#include "dem/instruction_set.h"

namespace platen::dem {

inline std::vector<InstructionSet> instruction_sets_here() {
  std::vector<InstructionSet> sets{InstructionSet::baseline};
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512})
    if (set <= best_instruction_set()) sets.push_back(set);
  return sets;
}

} // namespace platen::dem
