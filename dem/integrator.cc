#include "dem/integrator.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "dem/kernels/motion_kernel.h"

namespace platen::dem {

using kernels::Halves;
using kernels::MotionSums;

namespace {

kernels::MotionKernel kernel_of(const Integrator &how, Halves halves) {
  const kernels::MotionEffects effects{how.rotation, how.dissipation > 1};
  return for_set(how.instruction_set, kernels::motion_kernel_baseline, kernels::motion_kernel_avx2,
                 kernels::motion_kernel_avx512)(halves, effects);
}

kernels::MotionStep step_of(const Integrator &how, double finished, double next) {
  using kernels::LocalDamping;
  kernels::MotionStep step;
  step.finished = finished;
  step.next = next;
  if (how.local_damping > 0)
    step.damping = how.damping_form == DampingForm::vector ? LocalDamping::vector : LocalDamping::component;
  step.local_damping = how.local_damping;
  step.energy_sums = how.energy_ledger;
  step.weight_sum = how.energy_ledger && norm_squared(how.gravity) > 0;
  step.gravity = how.gravity;
  step.excess = how.dissipation - 1;
  return step;
}

kernels::MotionColumns columns_of(Particles &p) {
  kernels::MotionColumns c{};
  c.position = p.position.data();
  c.velocity = p.velocity.data();
  c.force = p.force.data();
  c.mass = p.mass.data();
  if (p.excess_velocity != nullptr) c.excess_velocity = p.excess_velocity->data();
  if (p.excess_spin != nullptr) c.excess_spin = p.excess_spin->data();
  if (!p.has_rotation()) return c;
  c.orientation = p.orientation->data();
  c.angular_velocity = p.angular_velocity->data();
  c.torque = p.torque->data();
  c.inertia = p.inertia->data();
  return c;
}

// Returns the sums of each block, 0 for blocks that are not listed.
std::vector<MotionSums> pass(const Integrator &how, Halves halves, Particles &p, const Ghosts &ghosts,
                             double finished, double next, const BlockList *listed) {
  const kernels::MotionKernel kernel = kernel_of(how, halves);
  const kernels::MotionColumns columns = columns_of(p);
  const kernels::MotionStep step = step_of(how, finished, next);
  std::vector<MotionSums> sums(number_of_blocks(p.size()));
  for_listed_blocks(listed, p.size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    if (halves != Halves::begin) {
      if (ghosts.bonds != nullptr) return_ghosts(p, *ghosts.bonds, block);
      if (ghosts.contacts != nullptr) return_ghosts(p, *ghosts.contacts, block);
    }
    sums[block] = kernel(columns, step, first, last);
  });
  return sums;
}

Motion motion_of(const std::vector<MotionSums> &blocks) {
  Motion motion;
  double fastest_square = 0;
  for (const MotionSums &b : blocks) {
    fastest_square = std::max(fastest_square, b.fastest_square);
    motion.speed_squares += b.speed_squares;
  }
  motion.fastest = std::sqrt(fastest_square);
  return motion;
}

void add_works(const std::vector<MotionSums> &blocks, KickSums &sums) {
  for (const MotionSums &b : blocks)
    sums.damping_work += b.damping_work, sums.weight_work += b.weight_work;
}

} // namespace

Motion Integrator::begin(Particles &p, double dt, const BlockList *listed) const {
  return motion_of(pass(*this, Halves::begin, p, {}, 0, dt, listed));
}

KickSums Integrator::end(Particles &p, const Ghosts &ghosts, double dt, const BlockList *listed) const {
  const std::vector<MotionSums> blocks = pass(*this, Halves::end, p, ghosts, dt, 0, listed);
  KickSums sums;
  add_works(blocks, sums);
  for (const MotionSums &b : blocks)
    sums.kinetic_energy += b.kinetic_energy, sums.unbalanced += b.unbalanced;
  return sums;
}

Motion Integrator::end_and_begin(Particles &p, const Ghosts &ghosts, double finished, double next,
                                 KickSums &sums, const BlockList *listed) const {
  const std::vector<MotionSums> blocks =
      pass(*this, Halves::end_and_begin, p, ghosts, finished, next, listed);
  sums = {};
  add_works(blocks, sums);
  return motion_of(blocks);
}

void set_weight(Particles &p, const Vector3 &gravity, const BlockList *listed) {
  for_listed_blocks(listed, p.size(), [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t i = first; i < last; ++i) {
      p.force[i] = p.mass[i] * gravity;
      if (p.has_rotation()) (*p.torque)[i] = {};
    }
  });
}

std::vector<double> kinetic_energy_of_blocks(const Particles &p, const BlockList *listed) {
  std::vector<double> energy(number_of_blocks(p.size()));
  for_listed_blocks(listed, p.size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) {
      sum += 0.5 * p.mass[i] * norm_squared(p.velocity[i]);
      if (p.has_rotation()) sum += 0.5 * (*p.inertia)[i] * norm_squared((*p.angular_velocity)[i]);
    }
    energy[block] = sum;
  });
  return energy;
}

double kinetic_energy(const Particles &p) {
  double sum = 0;
  for (const double of_block : kinetic_energy_of_blocks(p))
    sum += of_block;
  return sum;
}

} // namespace platen::dem
