// Block kernel of the elasto-damage-plastic interfaces, which remember (laws/elasto_damage_plastic.h). One
// source, compiled once per instruction set (interface_kernel.inc.h).
#pragma once

#include "dem/kernels/bond_kernel.h"
#include "dem/laws/elasto_damage_plastic.h"

namespace platen::dem::kernels {

// Beside the columns of all bonds, which must give velocities too: what each interface remembers.
struct InterfaceColumns {
  BondColumns bonds;
  double *plastic, *tension_damage, *shear_damage, *dissipated;
  Vector3 *shear, *slider;
};

struct InterfaceKernel {
  // Brings interfaces [first, last), those of one block, to the present, `dt` after their last state, and
  // adds up their forces; true where one has failed in this step.
  bool (*compute_forces)(const InterfaceColumns &, const BlockColumns &, const ElastoDamagePlastic &,
                         double dt, std::size_t first, std::size_t last);
};

extern const InterfaceKernel interface_kernel_baseline, interface_kernel_avx2, interface_kernel_avx512;

} // namespace platen::dem::kernels
