// Block kernels of the parallel bond. One source, compiled once per instruction set (bond_kernel.inc.h).
#pragma once

#include <cstddef>

#include "dem/laws/parallel_bond.h"
#include "dem/vector3.h"

namespace platen::dem::kernels {

// Doubles of one row of a block's sums: force and, with rotation, torque, each padded to four.
constexpr int sums_stride(bool rotation) {
  return rotation ? 8 : 4;
}

// Plain pointers to the columns that the kernels read and write.
struct BondColumns {
  const int *first, *second;
  const int *local; // row of `second` in the block's sums
  const Vector3 *reference;
  const double *rest_length, *lever, *normal_stiffness, *bond_radius;
  const Vector3 *position;       // columns of particles can be read one row beyond their end
  const Quaternion *orientation; // null: no rotation
  // Only for dashpots.
  const Vector3 *velocity, *angular_velocity;
  const double *dashpot, *dashpot_bending;
  double dashpot_shear_ratio, dashpot_twist_ratio;
  Vector3 *dashpot_force, *dashpot_moment;
  // Sums of forces and torques on the block's particles, on those outside that its bonds reach, and one row
  // more that nobody reads.
  double *sums;
  int first_row; // particle row of the first of the sums
  int spare_row; // the one that nobody reads
};

// What a bond holds, row by row, from index 0. Any pointer may be null.
struct BondRowValues {
  double *tension_ratio, *shear_ratio; // of strength
  double *energy;                      // J
  double *force;                       // N, size of the force between the two
};

struct BondKernels {
  // Adds the forces of bonds [first, last) to the sums; true where a bond may be at or above its strength.
  bool (*add_forces)(const BondColumns &, const ParallelBond &, std::size_t first, std::size_t last);
  // Adds the dashpots' forces; returns the sum of (force now + force before) times opening velocity, W.
  double (*add_dashpots)(const BondColumns &, std::size_t first, std::size_t last);
  void (*measure)(const BondColumns &, const ParallelBond &, const BondRowValues &, std::size_t first,
                  std::size_t last);
};

extern const BondKernels bond_kernels_baseline, bond_kernels_avx2, bond_kernels_avx512;

} // namespace platen::dem::kernels
