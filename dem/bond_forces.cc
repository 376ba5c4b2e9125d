#include <algorithm>

#include "base/aligned_vector.h"
#include "base/parallel.h"
#include "dem/bonds.h"
#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/cohesive_kernel.h"

namespace platen::dem {
namespace {

const kernels::BondKernels &kernels_of(InstructionSet set, const BondLaw &law) {
  if (const auto *outside = std::get_if<OutsideLaw>(&law))
    return *outside->parameters.calls->kernels[static_cast<std::size_t>(set)];
  return for_set(set, kernels::bond_kernels_baseline, kernels::bond_kernels_avx2,
                 kernels::bond_kernels_avx512);
}

const kernels::CohesiveKernel &cohesive_kernel_of(InstructionSet set) {
  return for_set(set, kernels::cohesive_kernel_baseline, kernels::cohesive_kernel_avx2,
                 kernels::cohesive_kernel_avx512);
}

kernels::BondColumns columns_of(const Particles &p, const Bonds &b) {
  kernels::BondColumns c{};
  c.first = b.first.data();
  c.second = b.second.data();
  c.ends = b.blocks.ends.data();
  c.reference = b.reference.data();
  c.rest_length = b.rest_length.data();
  c.lever = b.lever.data();
  c.normal_stiffness = b.normal_stiffness.data();
  c.bond_radius = b.bond_radius.data();
  if (b.strength_factor != nullptr) c.strength_factor = b.strength_factor->data();
  c.position = p.position.data();
  c.orientation = p.has_rotation() ? p.orientation->data() : nullptr;
  c.motion = b.rows_move();
  c.velocity = p.velocity.data();
  if (p.has_rotation()) c.angular_velocity = p.angular_velocity->data();
  if (b.dashpot == nullptr) return c;
  c.dashpot = b.dashpot->data();
  c.dashpot_force = b.dashpot_force->data();
  c.dashpot_shear_ratio = b.dashpot_shear_ratio;
  c.dashpot_twist_ratio = b.dashpot_twist_ratio;
  if (b.dashpot_bending == nullptr) return c;
  c.dashpot_bending = b.dashpot_bending->data();
  c.dashpot_moment = b.dashpot_moment->data();
  return c;
}

kernels::CohesiveColumns cohesive_columns_of(const Particles &p, const Bonds &b) {
  kernels::CohesiveColumns columns{columns_of(p, b), {}};
  for (std::size_t k = 0; k < b.memory_scalars.size(); ++k)
    columns.memory.scalar[k] = b.memory_scalars[k]->data();
  for (std::size_t k = 0; k < b.memory_vectors.size(); ++k)
    columns.memory.vector[k] = b.memory_vectors[k]->data();
  return columns;
}

// Calls body(sum, first, last) for portions of the rows whose first particle lies in a block of particles.
template <class Body>
std::vector<BondTotals> totals_by_blocks(const Particles &p, const Bonds &b, const BlockList *listed,
                                         const Body &body) {
  std::vector<BondTotals> totals(number_of_blocks(p.size()));
  for_listed_blocks(listed, p.size(),
                    [&](std::size_t first_particle, std::size_t end_particle, std::size_t block) {
                      // Blocks may not be cut yet: rows of one block stand together, but in any order.
                      const auto row_of = [&](std::size_t particle) {
                        const auto before = [&](int row) { return static_cast<std::size_t>(row) < particle; };
                        const auto at = std::partition_point(b.first.begin(), b.first.end(), before);
                        return static_cast<std::size_t>(at - b.first.begin());
                      };
                      const std::size_t end = row_of(end_particle);
                      for (std::size_t row = row_of(first_particle); row < end; row += block_rows)
                        body(totals[block], row, std::min(end, row + block_rows));
                    });
  return totals;
}

std::vector<BondTotals> cohesive_totals(const Particles &p, const Bonds &b, InstructionSet set,
                                        const BlockList *listed) {
  const kernels::CohesiveColumns columns = cohesive_columns_of(p, b);
  return totals_by_blocks(p, b, listed, [&](BondTotals &sum, std::size_t first, std::size_t last) {
    double energy[block_rows], force[block_rows], dissipated[block_rows], damage[block_rows],
        plastic[block_rows];
    cohesive_kernel_of(set).measure(columns, b.law, {energy, force, dissipated, damage, plastic}, first,
                                    last);
    for (std::size_t k = 0; k < last - first; ++k) {
      const bool failed = damage[k] >= 1;
      sum += {energy[k], force[k], failed ? 0 : dissipated[k], failed ? dissipated[k] : 0, plastic[k]};
    }
  });
}

// One block of particles; its rows are in memory of this thread.
kernels::BlockColumns block_of(Particles &p, Bonds &b, std::size_t block) {
  PairBlocks &blocks = b.blocks;
  kernels::BlockColumns c{};
  const std::size_t first = block * block_rows, first_ghost = blocks.first_ghost[block];
  c.first_row = static_cast<int>(first);
  c.own = static_cast<int>(std::min(p.size(), first + block_rows) - first);
  c.ghosts = static_cast<int>(blocks.first_ghost[block + 1] - first_ghost);
  c.ghost_particle = blocks.ghost_particle.data() + first_ghost;
  c.force = p.force.data() + first;
  c.ghost_force = blocks.ghost_force.data() + first_ghost;
  if (p.has_rotation()) {
    c.torque = p.torque->data() + first;
    c.ghost_torque = blocks.ghost_torque.data() + first_ghost;
  }
  thread_local AlignedVector<double> memory;
  const std::size_t rows = static_cast<std::size_t>(c.own + c.ghosts + kernels::spare_rows);
  const std::size_t used =
      rows * static_cast<std::size_t>(kernels::row_stride(p.has_rotation(), b.rows_move()));
  if (memory.size() < used) memory.resize(used);
  c.rows = memory.data();
  return c;
}

void add_weight(const Particles &p, const kernels::BlockColumns &rows, const Vector3 &gravity) {
  if (norm_squared(gravity) > 0)
    for (int k = 0; k < rows.own; ++k)
      rows.force[k] += p.mass[rows.first_row + k] * gravity;
}

kernels::BlockFindings compute_block(Particles &p, Bonds &b, const kernels::BondKernels &kernels,
                                     const kernels::BondColumns &columns, const Vector3 &gravity,
                                     std::size_t block) {
  const kernels::BlockColumns rows = block_of(p, b, block);
  const kernels::BlockFindings found = kernels.compute_forces(
      columns, rows, b.law, b.blocks.first_pair[block], b.blocks.first_pair[block + 1]);
  add_weight(p, rows, gravity);
  return found;
}

ExactSum work_of_dashpots(const std::vector<kernels::BlockFindings> &found, double dt) {
  ExactSum work;
  for (const kernels::BlockFindings &of_block : found)
    work += 0.5 * dt * of_block.dashpot_power;
  return work;
}

// W, power of the last dashpot force of a row at the present velocities.
double dashpot_power(const Particles &p, const Bonds &b, int row) {
  const int i = b.first[row], j = b.second[row];
  Vector3 v = p.velocity[j] - p.velocity[i];
  double power = 0;
  if (p.has_rotation()) {
    const Vector3 wi = (*p.angular_velocity)[i], wj = (*p.angular_velocity)[j];
    v += cross(p.position[j] - p.position[i], b.lever[row] * wi + (1 - b.lever[row]) * wj);
    if (b.dashpot_moment != nullptr) power = dot((*b.dashpot_moment)[row], wj - wi);
  }
  return power + dot((*b.dashpot_force)[row], v);
}

} // namespace

ExactSum compute_bond_forces(Particles &p, Bonds &b, InstructionSet set, const Vector3 &gravity, double dt,
                             std::vector<BondBreak> &breaks, const Loop &parallel_loop,
                             const BlockList *listed) {
  const kernels::BondKernels &kernels = kernels_of(set, b.law);
  const kernels::BondColumns columns = columns_of(p, b);
  std::vector<kernels::BlockFindings> found(b.blocks.blocks());
  for_listed_blocks(
      listed, p.size(),
      [&](std::size_t, std::size_t, std::size_t block) {
        found[block] = compute_block(p, b, kernels, columns, gravity, block);
      },
      parallel_loop);
  // Rarely reached: the strength ratios decide.
  std::vector<double> tension, shear;
  for (std::size_t block = 0; block < found.size(); ++block) {
    if (!found[block].reached) continue;
    const std::size_t first = found[block].first_reached, last = found[block].end_reached;
    tension.resize(last - first);
    shear.resize(last - first);
    kernels.measure(columns, b.law, {tension.data(), shear.data(), nullptr, nullptr}, first, last);
    for (std::size_t k = first; k < last; ++k) {
      const double t = tension[k - first], s = shear[k - first];
      if (!(t >= 1.0 || s >= 1.0) || b.normal_stiffness[k] == 0.0) continue;
      breaks.push_back(
          {static_cast<int>(k), t >= s ? BondState::broken_in_tension : BondState::broken_in_shear});
    }
  }
  return work_of_dashpots(found, dt);
}

void compute_bond_forces_again(Particles &p, Bonds &b, InstructionSet set, const Vector3 &gravity,
                               std::size_t block) {
  compute_block(p, b, kernels_of(set, b.law), columns_of(p, b), gravity, block);
}

ExactSum undone_work_of_dashpots(const Particles &p, const Bonds &b, double dt,
                                 const std::vector<BondBreak> &breaks) {
  ExactSum work;
  if (b.dashpot != nullptr)
    for (const BondBreak &broken : breaks)
      work += -0.5 * dt * dashpot_power(p, b, broken.row);
  return work;
}

ExactSum compute_cohesive_forces(Particles &p, Bonds &b, InstructionSet set, const Vector3 &gravity,
                                 double dt, std::vector<BondBreak> &breaks, const Loop &parallel_loop,
                                 const BlockList *listed) {
  const kernels::CohesiveKernel &kernel = cohesive_kernel_of(set);
  const kernels::CohesiveColumns columns = cohesive_columns_of(p, b);
  std::vector<kernels::BlockFindings> found(b.blocks.blocks());
  for_listed_blocks(
      listed, p.size(),
      [&](std::size_t, std::size_t, std::size_t block) {
        const kernels::BlockColumns rows = block_of(p, b, block);
        found[block] = kernel.compute_forces(columns, rows, b.law, dt, b.blocks.first_pair[block],
                                             b.blocks.first_pair[block + 1]);
        add_weight(p, rows, gravity);
      },
      parallel_loop);
  for (std::size_t block = 0; block < found.size(); ++block) {
    if (!found[block].reached) continue;
    b.look_at_order(block);
    const auto before = static_cast<std::ptrdiff_t>(breaks.size());
    for (std::size_t k = found[block].first_reached; k < found[block].end_reached; ++k)
      if (b.has_failed(k) && b.state[b.record[k]] < static_cast<int>(BondState::broken_in_tension))
        breaks.push_back({static_cast<int>(k), b.failed_in_tension(k) ? BondState::broken_in_tension
                                                                      : BondState::broken_in_shear});
    std::sort(breaks.begin() + before, breaks.end(), [&](const BondBreak &one, const BondBreak &other) {
      return b.record[one.row] < b.record[other.row];
    });
  }
  return work_of_dashpots(found, dt);
}

std::vector<BondTotals> bond_totals_of_blocks(const Particles &p, const Bonds &b, InstructionSet set,
                                              const BlockList *listed) {
  if (has_history(b.law)) return cohesive_totals(p, b, set, listed);
  const kernels::BondColumns columns = columns_of(p, b);
  return totals_by_blocks(p, b, listed, [&](BondTotals &sum, std::size_t first, std::size_t last) {
    double energy[block_rows], force[block_rows];
    kernels_of(set, b.law).measure(columns, b.law, {nullptr, nullptr, energy, force}, first, last);
    for (std::size_t k = 0; k < last - first; ++k)
      sum += {energy[k], force[k], 0, 0, 0};
  });
}

BondTotals bond_totals(const Particles &p, const Bonds &b, InstructionSet set) {
  BondTotals sum;
  for (const BondTotals &of_block : bond_totals_of_blocks(p, b, set))
    sum += of_block;
  return sum;
}

} // namespace platen::dem
