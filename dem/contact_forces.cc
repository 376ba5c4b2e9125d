// The loop over contacts, block by block of particles, with the kernel of the chosen effects.
#include <algorithm>

#include "base/parallel.h"
#include "dem/contacts.h"
#include "dem/kernels/contact_kernel.h"
#include "dem/laws/normal_contact.h"

namespace platen::dem {
namespace {

template <class T>
auto *data(T *column) {
  return column != nullptr ? column->data() : nullptr;
}

} // namespace

kernels::ContactColumns Contacts::columns(const Particles &p) {
  kernels::ContactColumns c{};
  c.first = first.data(), c.second = second.data();
  c.rest_distance = rest_distance.data(), c.coefficient = coefficient.data();
  c.touching = touching.data(), c.overlap = overlap.data(), c.force = force.data();
  c.normal = data(normal), c.spring = data(spring);
  c.tangential_stiffness = data(tangential_stiffness), c.sliding = data(sliding);
  c.rolling = data(rolling), c.rolling_stiffness = data(rolling_stiffness);
  c.dashpot = data(dashpot);
  c.position = p.position.data(), c.velocity = p.velocity.data();
  if (p.has_rotation()) c.angular_velocity = p.angular_velocity->data();
  c.radius = p.radius.data(), c.mass = p.mass.data();
  return c;
}

kernels::ContactBlock Contacts::block_of(Particles &p, std::size_t block) {
  kernels::ContactBlock b{};
  const std::size_t first_row = block * block_rows, first_ghost = blocks_.first_ghost[block];
  b.own = static_cast<int>(std::min(block_rows, p.size() - first_row));
  b.first_pair = blocks_.first_pair[block], b.end_pair = blocks_.first_pair[block + 1];
  if (!added_.empty()) b.added = added_[block].data(), b.added_count = added_[block].size();
  b.ends = blocks_.ends.data();
  b.force = p.force.data();
  b.ghost_force = blocks_.ghost_force.data() + first_ghost;
  if (!p.has_rotation()) return b;
  b.torque = p.torque->data();
  b.ghost_torque = blocks_.ghost_torque.data() + first_ghost;
  return b;
}

void Contacts::compute(Particles &particles, double dt, const BlockList *listed, const Loop &before) {
  cut_blocks(particles);
  const kernels::ContactColumns c = columns(particles);
  kernels::ContactStep step;
  step.dt = dt, step.dashpot = dashpot_;
  step.friction = settings_.friction, step.rolling_friction = settings_.rolling_friction;
  step.tangential_ratio =
      NormalContacts::with(settings_.normal, [&](auto of) { return of.tangential_ratio(settings_); });
  std::vector<kernels::ContactLoss> lost(blocks_.blocks());
  for_listed_blocks(listed, particles.size(), [&](std::size_t, std::size_t, std::size_t block) {
    if (before.call != nullptr) before.call(before.body, block);
    const kernels::ContactBlock rows_of_block = block_of(particles, block);
    const std::size_t most = rows_of_block.end_pair - rows_of_block.first_pair + rows_of_block.added_count;
    if (most == 0) return;
    blocks_.clear_ghosts(block);
    thread_local std::vector<int> rows;
    thread_local std::vector<double> losses;
    if (rows.size() < most) rows.resize(most), losses.resize(3 * most);
    lost[block] = loop_(c, rows_of_block, step, rows.data(), losses.data());
  });
  for (const kernels::ContactLoss &l : lost) {
    friction_work += l.friction;
    damping_work += l.damping;
  }
}

kernels::ContactLoop Contacts::loop_for(bool rotation, bool ledger, InstructionSet set) const {
  const kernels::ContactKernels &kernels = for_set(
      set, kernels::contact_kernels_baseline, kernels::contact_kernels_avx2, kernels::contact_kernels_avx512);
  return kernels.loop({settings_.normal, settings_.tangential, rotation, ledger});
}

} // namespace platen::dem
