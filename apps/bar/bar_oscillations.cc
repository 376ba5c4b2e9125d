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
// Half the thickness of the slice whose mean motion a station tells, in mean radii.
constexpr double station = 2;
// How long pulses are smoothed, in passages of the wave: at the far end, which no other wave meets before
// three passages, and on the way, where the reflected wave follows after one.
constexpr double smoothing_at_end = 1.2, smoothing_on_the_way = 0.8;

double mean_along_z(const Column<Vector3> &column, const std::vector<std::size_t> &rows) {
  double sum = 0;
  for (const std::size_t row : rows)
    sum += column[row].z;
  return sum / static_cast<double>(rows.size());
}

struct Station {
  std::vector<std::size_t> rows;
  double z = 0; // m, mean of the centres
  Station(const Particles &p, const BarGeometry &bar, double at) {
    const double reach = station * bar.mean_radius;
    for (std::size_t i = 0; i < p.size(); ++i)
      if (bar.in_piece[i] && std::abs(p.reference_position[i].z - at) <= reach) {
        rows.push_back(i);
        z += p.reference_position[i].z;
      }
    z /= static_cast<double>(rows.size());
  }
  double moved(const Particles &p) const { return mean_along_z(p.position, rows) - z; }
  double velocity(const Particles &p) const { return mean_along_z(p.velocity, rows); }
};

// Steps a model from a state that is set, and reads it.
class Run {
public:
  Run(Model &model, const BarGeometry &bar)
      : model_(model),
        bar_(bar),
        quarter(model.particles, bar, bar.top - 0.25 * bar.length()),
        half(model.particles, bar, bar.top - 0.5 * bar.length()) {
    model.compute_forces(0);
    model.end_step(0);
    initial_ = kinetic_energy(model.particles) + energy_shares(model.particles, *model.bonds).total();
  }
  EndMotion end() const { return motion_of(model_.particles, bar_.high); }
  // Calls after_step(whether a sample is due) at the start and after each step, and gives the samples away.
  template <class AfterStep>
  void go(const Clocking &clocking, const TakeSample &take, const AfterStep &after_step, Motion &result) {
    for (;; ++result.steps) {
      const bool due = result.steps % clocking.every == 0;
      after_step(due);
      if (due) result.stopped = !give(take, result);
      if (result.stopped || result.steps == clocking.steps) return;
      model_.begin_step(clocking.step);
      model_.compute_forces(clocking.step);
      model_.end_step(clocking.step);
    }
  }

private:
  bool give(const TakeSample &take, Motion &result) const {
    const BarSample s = sample();
    const double change = std::abs(s.kinetic + s.energy.total() - initial_);
    if (initial_ != 0) result.energy_residual.add(change / initial_);
    return take(s);
  }
  BarSample sample() const {
    const Particles &p = model_.particles;
    BarSample s;
    s.time = model_.time;
    s.end = end();
    s.struck_velocity = mean_along_z(p.velocity, bar_.high.rows);
    s.far_velocity = mean_along_z(p.velocity, bar_.low.rows);
    s.quarter = quarter.moved(p);
    s.half = half.moved(p);
    s.kinetic = kinetic_energy(p);
    s.initial_energy = initial_;
    s.energy = energy_shares(p, *model_.bonds);
    s.broken_tension = model_.broken_tension;
    s.broken_shear = model_.broken_shear;
    return s;
  }

  Model &model_;
  const BarGeometry &bar_;
  double initial_ = 0;

public:
  const Station quarter, half;
};

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
  Run run(model, bar);
  Oscillation result;
  std::vector<double> oscillation;
  const auto keep = [&](bool due) {
    if (due) oscillation.push_back(along(load, run.end(), bar.along_x));
  };
  run.go(clocking, take, keep, result);
  result.frequency = dem::main_frequency(oscillation, clocking.step * static_cast<double>(clocking.every),
                                         0.5 * expected, 2 * expected);
  return result;
}

Impact strike(Model &model, const BarGeometry &bar, double velocity, double speed, const Clocking &clocking,
              const TakeSample &take) {
  Particles &p = model.particles;
  for (const std::size_t row : bar.high.rows)
    p.velocity[row] = {0, 0, -velocity};
  Run run(model, bar);
  std::vector<double> quarter{0}, half{0}, away{0};
  Impact result;
  const auto keep = [&](bool) {
    if (result.steps == 0) return; // at rest
    quarter.push_back(run.quarter.velocity(p));
    half.push_back(run.half.velocity(p));
    away.push_back(mean_along_z(p.velocity, bar.low.rows));
  };
  run.go(clocking, take, keep, result);
  const double passage = bar.length() / speed;
  const auto time = [&](const std::vector<double> &velocities, double smoothing, double distance) {
    return dem::passing_time(velocities, clocking.step, smoothing * passage, distance / speed);
  };
  result.quarter_time = time(quarter, smoothing_on_the_way, bar.top - run.quarter.z);
  result.half_time = time(half, smoothing_on_the_way, bar.top - run.half.z);
  result.far_time = time(away, smoothing_at_end, bar.length());
  result.speed_quarter_to_half = (run.quarter.z - run.half.z) / (result.half_time - result.quarter_time);
  result.speed_end_to_end = bar.length() / result.far_time;
  return result;
}

} // namespace platen::apps
