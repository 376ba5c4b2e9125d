#include <algorithm>

#include "dem/bonds.h"
#include "dem/kernels/bond_kernel.h"
#include "dem/parallel.h"

namespace platen::dem {
namespace {

kernels::BondKernel kernel_of(InstructionSet set) {
  switch (set) {
    case InstructionSet::avx512:
      return kernels::bond_kernel_avx512;
    case InstructionSet::avx2:
      return kernels::bond_kernel_avx2;
    case InstructionSet::baseline:
      break;
  }
  return kernels::bond_kernel_baseline;
}

kernels::BondColumns columns_of(const Particles &p, Bonds &b) {
  kernels::BondColumns c{};
  c.first = b.first.data();
  c.second = b.second.data();
  c.reference = b.reference.data();
  c.rest_length = b.rest_length.data();
  c.lever = b.lever.data();
  c.normal_stiffness = b.normal_stiffness.data();
  c.bond_radius = b.bond_radius.data();
  c.position = p.position.data();
  c.orientation = p.has_rotation() ? p.orientation->data() : nullptr;
  c.force = b.force.data();
  c.torque_first = b.torque_first != nullptr ? b.torque_first->data() : nullptr;
  c.torque_second = b.torque_second != nullptr ? b.torque_second->data() : nullptr;
  return c;
}

} // namespace

InstructionSet best_instruction_set() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

const char *name(InstructionSet set) {
  return set == InstructionSet::avx512 ? "avx512" : (set == InstructionSet::avx2 ? "avx2" : "baseline");
}

void compute_bond_forces(const Particles &particles, Bonds &bonds, InstructionSet set,
                         std::vector<BondBreak> &breaks) {
  const kernels::BondKernel kernel = kernel_of(set);
  const kernels::BondColumns columns = columns_of(particles, bonds);
  std::vector<unsigned char> at_strength(number_of_blocks(bonds.size()), 0);
  for_each_block(bonds.size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    at_strength[block] = kernel(columns, bonds.law, first, last);
  });
  // Rare: the same kernel once more over the block, so that the ratios are those that raised the flag.
  for (std::size_t block = 0; block < at_strength.size(); ++block) {
    if (!at_strength[block]) continue;
    const std::size_t first = block * block_rows, last = std::min(bonds.size(), first + block_rows);
    double tension[block_rows], shear[block_rows];
    kernels::BondColumns with_ratios = columns;
    with_ratios.tension_ratio = tension;
    with_ratios.shear_ratio = shear;
    kernel(with_ratios, bonds.law, first, last);
    for (std::size_t k = first; k < last; ++k) {
      const double t = tension[k - first], s = shear[k - first];
      if (t < 1.0 && s < 1.0) continue;
      breaks.push_back(
          {static_cast<int>(k), t >= s ? BondState::broken_in_tension : BondState::broken_in_shear});
    }
  }
}

double bond_energy(const Particles &particles, const Bonds &bonds) {
  return ordered_sum<double>(bonds.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t k = first; k < last; ++k)
      if (bonds.normal_stiffness[k] != 0.0) sum += bonds.response(k, particles).energy;
    return sum;
  });
}

} // namespace platen::dem
