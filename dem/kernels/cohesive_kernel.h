// Block kernel of bonds with history, for all such laws. One source, compiled once per instruction set
// (cohesive_kernel.inc.h).
#pragma once

#include "dem/kernels/bond_kernel.h"
#include "dem/laws/bond_law.h"

namespace platen::dem::kernels {

// History of each bond: a column for each member of the law's State, in its order; null beyond.
constexpr std::size_t most_scalars = 12, most_vectors = 4;
struct MemoryColumns {
  double *scalar[most_scalars] = {};
  Vector3 *vector[most_vectors] = {};
};

// The columns of bonds include velocities.
struct CohesiveColumns {
  BondColumns bonds;
  MemoryColumns memory;
};

// Values of cohesive bonds, row by row, from index 0.
struct CohesiveRowValues {
  double *energy;     // J
  double *force;      // N, magnitude of the force between the two
  double *dissipated; // J, by damage, or by friction of failed bonds
  double *damage;     // 0 ... 1
  double *plastic;    // J
};

struct CohesiveKernel {
  // Advances cohesive bonds [first, last) of one block by `dt` from their last state to the present, and sums
  // their forces and those of their dashpots.
  BlockFindings (*compute_forces)(const CohesiveColumns &, const BlockColumns &, const BondLaw &, double dt,
                                  std::size_t first, std::size_t last);
  // Values of cohesive bonds [first, last) of any block.
  void (*measure)(const CohesiveColumns &, const BondLaw &, const CohesiveRowValues &, std::size_t first,
                  std::size_t last);
};

extern const CohesiveKernel cohesive_kernel_baseline, cohesive_kernel_avx2, cohesive_kernel_avx512;

} // namespace platen::dem::kernels
