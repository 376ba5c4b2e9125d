// Block kernels of the bond laws. One source, compiled once per instruction set (bond_kernel.inc.h).
#pragma once

#include <cstddef>

#include "base/vector3.h"
#include "dem/laws/bond_law.h"
#include "dem/pair_blocks.h"

namespace platen::dem::kernels {

// Contents of one row of a block, each part padded to four doubles: position and velocity, angular velocity
// and orientation, then the sums of force and torque; rotational parts only with rotation, velocities only if
// bonds need them. Parts that are read together share a cache line, and so do the sums.
constexpr int row_stride(bool rotation, bool motion) {
  return (rotation ? 16 : 8) + (motion ? 8 : 0);
}
template <bool rotation_, bool motion_>
struct RowLayout {
  static constexpr bool rotation = rotation_, motion = motion_;
  static constexpr int velocity = 4, spin = 8; // with motion
  static constexpr int orientation = motion ? 12 : 4;
  static constexpr int stride = row_stride(rotation, motion);
  static constexpr int sums = rotation ? stride - 8 : motion ? 8 : 4;
};
// Rows after those of a block's own particles and ghosts, for the unused lanes of the last SIMD vector.
constexpr int spare_rows = 2;

// One block of particles and the ghosts that its bonds reach, and the targets of their sums.
struct BlockColumns {
  double *rows;              // own + ghosts + spare_rows rows, aligned to 64 bytes
  int first_row;             // particle row of the first
  int own, ghosts;           // rows
  const int *ghost_particle; // particle row of each ghost
  Vector3 *force, *torque;   // of the block's first particle; torque null without rotation
  Vector3 *ghost_force, *ghost_torque;
};

// Plain pointers to the columns that the kernels read and write.
struct BondColumns {
  const int *first, *second;
  const PairBlocks::Ends *ends; // of the bond in its block, times row_stride
  const Vector3 *reference;
  const double *rest_length, *lever, *normal_stiffness, *bond_radius;
  const double *strength_factor; // null: all bonds have the same strength
  const Vector3 *position;       // columns of particles can be read one row beyond their end
  const Quaternion *orientation; // null: no rotation
  bool motion;                   // in the rows, RowLayout
  // Only for dashpots, and for laws that read motion.
  const Vector3 *velocity, *angular_velocity;
  // Null: no dashpots, or none against bending.
  const double *dashpot, *dashpot_bending;
  double dashpot_shear_ratio, dashpot_twist_ratio;
  Vector3 *dashpot_force, *dashpot_moment;
};

// Results of a pass over a block's bonds.
struct BlockFindings {
  // A bond may be at or above its strength; or a cohesive bond has failed, or been damaged, in this step.
  bool reached = false;
  double dashpot_power = 0; // W, sum of the dashpots' (force now + force before) times opening velocity
  std::size_t first_reached = 0, end_reached = 0; // range of rows that contains all such bonds
};

// Values of each bond, row by row, from index 0. Any pointer may be null.
struct BondRowValues {
  double *tension_ratio, *shear_ratio; // of strength
  double *energy;                      // J
  double *force;                       // N, magnitude of the force between the two
};

// Bonds [first, last) are those of one block.
struct BondKernels {
  // Forces of the bonds and their dashpots on the block's particles and ghosts.
  BlockFindings (*compute_forces)(const BondColumns &, const BlockColumns &, const BondLaw &,
                                  std::size_t first, std::size_t last);
  void (*measure)(const BondColumns &, const BondLaw &, const BondRowValues &, std::size_t first,
                  std::size_t last);
};

extern const BondKernels bond_kernels_baseline, bond_kernels_avx2, bond_kernels_avx512;

} // namespace platen::dem::kernels
