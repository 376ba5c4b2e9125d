// The bar in motion: released from a load, or struck.
#pragma once

#include <functional>
#include <vector>

#include "apps/bar/bar.h"
#include "apps/bar/bar_at_rest.h"
#include "apps/bar/bar_section.h"
#include "base/largest.h"
#include "dem/measure/bond_network.h"

namespace platen::apps {

// What is read of the bar in motion.
struct BarSample {
  double time = 0;                              // s, since it was released or struck
  EndMotion end;                                // of the free (struck) end
  double struck_velocity = 0, far_velocity = 0; // m/s along z, means of the two ends
  double quarter = 0, half = 0; // m along z, means at a quarter and half of the length from the struck end
  double kinetic = 0;           // J
  double residual = 0;          // J, change of kinetic and stored energy since it was released or struck
  dem::BondEnergies energy;     // J
  long broken_tension = 0, broken_shear = 0;
};
// Takes each sample that is written; returns false to stop the run.
using TakeSample = std::function<bool(const BarSample &)>;

struct BarTime {
  double step = 0;        // s, of the oscillating bar
  double impact_step = 0; // s, of the struck bar
  std::string reason;
  double of(BarLoad load) const { return load == BarLoad::impact ? impact_step : step; }
};
// Safety times the limit, or Integration/Time step, which must not exceed the limit (throws InputError).
// Steps that follow from the limit are cut in three for the impact: it begins in one layer of spheres, so the
// highest modes oscillate, whose energy a step near the limit does not tell (by 3 % at 0.8 of it; as the
// square of the step).
BarTime bar_time_step(const Scene &scene, const dem::Model &model);

struct Clocking {
  double step = 0; // s
  long steps = 0;  // to make
  long every = 1;  // steps from one sample to the next
};

struct Motion {
  Largest energy_residual; // change of kinetic and stored energy, over what was there at first
  long steps = 0;          // made
  bool stopped = false;
};
struct Oscillation : Motion {
  double frequency = 0; // 1/s
};
// Oscillates freely from the state at rest under a load, which is taken away at time 0; the clamped end is so
// heavy that it stays. Its main frequency is looked for between half and twice `expected` (1/s). Leaves the
// model in motion.
Oscillation release(dem::Model &model, const BarGeometry &bar, BarLoad load, const dem::StaticState &from,
                    double expected, const Clocking &clocking, const TakeSample &take);

struct Impact : Motion {
  double quarter_time = 0, half_time = 0, far_time = 0; // s, of passage; NaN where there was none
  double speed_quarter_to_half = 0;                     // m/s
  double speed_end_to_end = 0;                          // m/s
};
// How long the bar has to be followed to tell its speed, in passages of the wave.
constexpr double followed_passages = 2.4;
// The free bar, its upper end struck: the spheres there move down at `velocity` (m/s) at time 0. Mean
// velocities of the far end, and at a quarter and half of the length, tell when the pulse passes
// (dem/measure/spectrum.h); those on its path are smoothed over a shorter time, for the reflected wave meets
// them. With its reflection at the struck end the pulse starts at the end plane at time 0. `speed` (m/s) is a
// first guess.
Impact strike(dem::Model &model, const BarGeometry &bar, double velocity, double speed,
              const Clocking &clocking, const TakeSample &take);

} // namespace platen::apps
