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

struct Sums : MotionSums {
  Sums() = default;
  Sums(const MotionSums &s) : MotionSums(s) {}
  Sums &operator+=(const Sums &b) {
    damping_work += b.damping_work, weight_work += b.weight_work;
    unbalanced += b.unbalanced, kinetic_energy += b.kinetic_energy;
    speed_squares += b.speed_squares;
    fastest_square = std::max(fastest_square, b.fastest_square);
    return *this;
  }
};

Sums pass(const Integrator &how, Halves halves, Particles &p, const Ghosts &ghosts, double finished,
          double next) {
  const kernels::MotionKernel kernel = kernel_of(how, halves);
  const kernels::MotionColumns columns = columns_of(p);
  const kernels::MotionStep step = step_of(how, finished, next);
  return ordered_sum<Sums>(p.size(), [&](std::size_t first, std::size_t last) {
    if (halves != Halves::begin) {
      if (ghosts.bonds != nullptr) return_ghosts(p, *ghosts.bonds, first / block_rows);
      if (ghosts.contacts != nullptr) return_ghosts(p, *ghosts.contacts, first / block_rows);
    }
    return Sums(kernel(columns, step, first, last));
  });
}

} // namespace

Motion Integrator::begin(Particles &p, double dt) const {
  const Sums s = pass(*this, Halves::begin, p, {}, 0, dt);
  return {std::sqrt(s.fastest_square), s.speed_squares};
}

KickSums Integrator::end(Particles &p, const Ghosts &ghosts, double dt) const {
  const Sums s = pass(*this, Halves::end, p, ghosts, dt, 0);
  return {s.damping_work, s.weight_work, s.kinetic_energy, s.unbalanced};
}

Motion Integrator::end_and_begin(Particles &p, const Ghosts &ghosts, double finished, double next,
                                 KickSums &sums) const {
  const Sums s = pass(*this, Halves::end_and_begin, p, ghosts, finished, next);
  sums = {s.damping_work, s.weight_work, 0, 0};
  return {std::sqrt(s.fastest_square), s.speed_squares};
}

void set_weight(Particles &p, const Vector3 &gravity) {
  for_each(p.size(), [&](std::size_t i) {
    p.force[i] = p.mass[i] * gravity;
    if (p.has_rotation()) (*p.torque)[i] = {};
  });
}

double kinetic_energy(const Particles &p) {
  return ordered_sum<double>(p.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) {
      sum += 0.5 * p.mass[i] * norm_squared(p.velocity[i]);
      if (p.has_rotation()) sum += 0.5 * (*p.inertia)[i] * norm_squared((*p.angular_velocity)[i]);
    }
    return sum;
  });
}

} // namespace platen::dem
