#include "apps/bar/bar_oscillations.h"

#include <algorithm>
#include <cmath>

#include "apps/bar/bar_section.h"
#include "apps/scene/units.h"
#include "base/parallel.h"
#include "dem/measure/spectrum.h"
#include "dem/stable_step.h"

namespace platen::apps {
namespace {

using dem::Model;
using dem::Particles;

// Of the clamped spheres: what pulls at them moves them by less than round-off.
constexpr double clamp_mass = 1e15;
// How long pulses are smoothed, in passages of the wave: at the far end, which no other wave meets before
// three passages, and on the way, where the reflected wave follows after one.
constexpr double smoothing_at_end = 1.2, smoothing_on_the_way = 0.8;

double mean_along_z(const Column<Vector3> &column, const std::vector<std::size_t> &rows) {
  double sum = 0;
  for (const std::size_t row : rows)
    sum += column[row].z;
  return sum / static_cast<double>(rows.size());
}

// Steps a model from a state that is set. Calls after_step() at the start and after each step, and then gives
// the samples away that are due.
template <class AfterStep>
void step_through(Model &model, const BarGeometry &bar, const Clocking &clocking, const TakeSample &take,
                  Motion &result, const AfterStep &after_step) {
  const Particles &p = model.particles;
  model.compute_forces(0);
  model.end_step(0);
  const double initial = kinetic_energy(p) + bond_energies(p, *model.bonds).total();
  const auto give = [&] {
    BarSample s;
    s.time = model.time;
    s.end = motion_of(p, bar.high);
    s.struck_velocity = mean_along_z(p.velocity, bar.high.rows);
    s.far_velocity = mean_along_z(p.velocity, bar.low.rows);
    s.quarter = mean_along_z(p.position, bar.quarter.rows) - bar.quarter.z;
    s.half = mean_along_z(p.position, bar.half.rows) - bar.half.z;
    s.kinetic = kinetic_energy(p);
    s.energy = bond_energies(p, *model.bonds);
    s.residual = s.kinetic + s.energy.total() - initial;
    s.broken_tension = model.broken_tension;
    s.broken_shear = model.broken_shear;
    if (initial != 0) result.energy_residual.add(std::abs(s.residual) / initial);
    return take(s);
  };
  for (;; ++result.steps) {
    after_step();
    if (result.steps % clocking.every == 0) result.stopped = !give();
    if (result.stopped || result.steps == clocking.steps) return;
    model.begin_step(clocking.step);
    model.compute_forces(clocking.step);
    model.end_step(clocking.step);
  }
}

void clamp(Particles &p, const BarEnd &end) {
  for (const std::size_t row : end.rows) {
    p.mass[row] *= clamp_mass;
    if (p.has_rotation()) (*p.inertia)[row] *= clamp_mass;
  }
}

} // namespace

BarTime bar_time_step(const Scene &scene, const Model &model) {
  dem::DashpotFractions dashpots;
  dashpots.bonds = scene.model.bond_dashpot;
  const dem::StableStep limit =
      dem::stable_step(model.particles, model.bonds.get(), model.contacts.get(), {}, dashpots);
  const double wanted = scene.time_step.fixed_step;
  const double step = scene.time_step.safety * limit.limit;
  if (wanted == 0) return {step, step / 3, limit.reason};
  if (wanted > limit.limit)
    refuse(scene, "Integration/Time step",
           "is above the limit of this bar. Allowed: 0 ... " + shortest_text(limit.limit) + " s.");
  return {wanted, wanted, "as the scene sets it"};
}

Oscillation release(Model &model, const BarGeometry &bar, BarLoad load, const dem::StaticState &from,
                    double expected, const Clocking &clocking, const TakeSample &take) {
  Particles &p = model.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.position[i] = p.reference_position[i] + from.displacement[i];
    if (p.has_rotation()) (*p.orientation)[i] = rotation_quaternion(from.turn[i]);
  }
  clamp(p, bar.low);
  Oscillation result;
  std::vector<double> oscillation;
  const auto keep = [&](const BarSample &sample) {
    oscillation.push_back(along(load, sample.end, bar.along_x));
    return take(sample);
  };
  step_through(model, bar, clocking, keep, result, [] {});
  result.frequency = dem::main_frequency(oscillation, clocking.step * static_cast<double>(clocking.every),
                                         0.5 * expected, 2 * expected);
  return result;
}

Impact strike(Model &model, const BarGeometry &bar, double velocity, double speed, const Clocking &clocking,
              const TakeSample &take) {
  Particles &p = model.particles;
  for (const std::size_t row : bar.high.rows)
    p.velocity[row] = {0, 0, -velocity};
  std::vector<double> quarter{0}, half{0}, away{0};
  Impact result;
  step_through(model, bar, clocking, take, result, [&] {
    if (result.steps == 0) return; // at rest
    quarter.push_back(mean_along_z(p.velocity, bar.quarter.rows));
    half.push_back(mean_along_z(p.velocity, bar.half.rows));
    away.push_back(mean_along_z(p.velocity, bar.low.rows));
  });
  const double passage = bar.length() / speed;
  const auto time = [&](const std::vector<double> &velocities, double smoothing, double distance) {
    return dem::passing_time(velocities, clocking.step, smoothing * passage, distance / speed);
  };
  result.quarter_time = time(quarter, smoothing_on_the_way, bar.top - bar.quarter.z);
  result.half_time = time(half, smoothing_on_the_way, bar.top - bar.half.z);
  result.far_time = time(away, smoothing_at_end, bar.length());
  result.speed_quarter_to_half = (bar.quarter.z - bar.half.z) / (result.half_time - result.quarter_time);
  result.speed_end_to_end = bar.length() / result.far_time;
  return result;
}

} // namespace platen::apps
