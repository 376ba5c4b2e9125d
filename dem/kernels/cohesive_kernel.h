// Block kernel of bonds that remember, for all laws that do. One source, compiled once per instruction set
// (cohesive_kernel.inc.h).
#pragma once

#include "dem/kernels/bond_kernel.h"
#include "dem/laws/bond_law.h"

namespace platen::dem::kernels {

// What each bond remembers: a column for each member of the law's State, in its order; null beyond.
constexpr std::size_t most_scalars = 12, most_vectors = 4;
struct MemoryColumns {
  double *scalar[most_scalars] = {};
  Vector3 *vector[most_vectors] = {};
};

// Of bonds velocities too.
struct CohesiveColumns {
  BondColumns bonds;
  MemoryColumns memory;
};

// What cohesive bonds hold and have taken, row by row, from index 0.
struct CohesiveRowValues {
  double *energy;     // J
  double *force;      // N, size of the force between the two
  double *dissipated; // J, by damage, or by friction of what has failed
  double *damage;     // 0 ... 1
  double *plastic;    // J
};

struct CohesiveKernel {
  // Brings cohesive bonds [first, last), those of one block, to the present, `dt` after their last state, and
  // adds up their forces and those of their dashpots.
  BlockFindings (*compute_forces)(const CohesiveColumns &, const BlockColumns &, const BondLaw &, double dt,
                                  std::size_t first, std::size_t last);
  // Of cohesive bonds [first, last) of any block.
  void (*measure)(const CohesiveColumns &, const BondLaw &, const CohesiveRowValues &, std::size_t first,
                  std::size_t last);
};

extern const CohesiveKernel cohesive_kernel_baseline, cohesive_kernel_avx2, cohesive_kernel_avx512;

} // namespace platen::dem::kernels
