#include <algorithm>
#include <cmath>

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

double add_bond_dashpots(const Particles &p, Bonds &b, double alpha, double dt) {
  constexpr double pi = 3.14159265358979323846;
  const bool turning = p.has_rotation();
  return ordered_sum<double>(b.size(), [&](std::size_t first, std::size_t last) {
    double work = 0;
    for (std::size_t k = first; k < last; ++k) {
      const double stiffness = b.normal_stiffness[k] * pi * b.bond_radius[k] * b.bond_radius[k];
      if (stiffness == 0.0) continue;
      const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
      const double ratio = b.law.parameters.stiffness_ratio,
                   half_square = 0.5 * b.bond_radius[k] * b.bond_radius[k];
      const double m = p.mass[i] * p.mass[j] / (p.mass[i] + p.mass[j]);
      const double cn = 2 * alpha * std::sqrt(stiffness * m),
                   cs = 2 * alpha * std::sqrt(ratio * stiffness * m);
      const Vector3 d = p.position[j] - p.position[i], n = d / norm(d);
      const Vector3 ri = b.lever[k] * d, rj = ri - d;
      Vector3 v = p.velocity[j] - p.velocity[i];
      if (turning) v += cross((*p.angular_velocity)[j], rj) - cross((*p.angular_velocity)[i], ri);
      const double vn = dot(v, n);
      const Vector3 vs = v - vn * n, force = cn * vn * n + cs * vs;
      b.force[k] += force;
      work += 0.5 * dt * dot(force + (*b.dashpot_force)[k], v);
      (*b.dashpot_force)[k] = force;
      if (!turning) continue;
      const double inertia = (*p.inertia)[i] * (*p.inertia)[j] / ((*p.inertia)[i] + (*p.inertia)[j]);
      const double cb = 2 * alpha * std::sqrt(0.5 * half_square * stiffness * inertia);
      const double ct = 2 * alpha * std::sqrt(half_square * ratio * stiffness * inertia);
      const Vector3 w = (*p.angular_velocity)[j] - (*p.angular_velocity)[i];
      const double wn = dot(w, n);
      const Vector3 moment = cb * (w - wn * n) + ct * wn * n;
      (*b.torque_first)[k] += cross(ri, force) + moment;
      (*b.torque_second)[k] -= cross(rj, force) + moment;
      work += 0.5 * dt * dot(moment + (*b.dashpot_moment)[k], w);
      (*b.dashpot_moment)[k] = moment;
    }
    return work;
  });
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
