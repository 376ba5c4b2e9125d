// Block kernel of the parallel bond. One source, compiled once per instruction set (bond_kernel.inc.h).
#pragma once

#include <cstddef>

#include "dem/laws/parallel_bond.h"
#include "dem/vector3.h"

namespace platen::dem::kernels {

// Plain pointers to the columns that the kernel reads and writes.
struct BondColumns {
  const int *first, *second;
  const Vector3 *reference;
  const double *rest_length, *lever, *normal_stiffness, *bond_radius;
  const Vector3 *position;
  const Quaternion *orientation; // null: no rotation
  Vector3 *force, *torque_first, *torque_second;
  // Where asked for (not null): sigma_max / sigma_c and tau_max / tau_c of the rows, from index 0.
  double *tension_ratio, *shear_ratio;
};

// Computes rows [first, last); true where a row is at or above its strength.
using BondKernel = bool (*)(const BondColumns &, const ParallelBond &, std::size_t first, std::size_t last);
bool bond_kernel_baseline(const BondColumns &, const ParallelBond &, std::size_t first, std::size_t last);
bool bond_kernel_avx2(const BondColumns &, const ParallelBond &, std::size_t first, std::size_t last);
bool bond_kernel_avx512(const BondColumns &, const ParallelBond &, std::size_t first, std::size_t last);

} // namespace platen::dem::kernels
