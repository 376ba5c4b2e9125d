// The cheapest runs that make an interval narrow enough: so many packings at each speed; and what is decided
// after each batch of runs.
//
// Packings are numbered, and speed k has the first counts[k] of them: a packing that a slow run needs has
// been run fast before, so that the difference of both is free of the packing (common random numbers), and
// most packings are run fast alone, as multilevel Monte Carlo has it (Heinrich 2001, Giles 2008).
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "apps/study/target_model.h"

namespace platen::apps {

using Counts = std::vector<std::size_t>; // by speed

// What runs cost, in steps times spheres, which no machine changes.
struct TargetCosts {
  std::vector<double> runs; // by speed
  double packing = 0;       // of each packing, once
  double of(const Counts &counts) const;
  double between(const Counts &from, const Counts &to) const { return of(to) - of(from); }
};

struct Aim {
  double accuracy = 0; // half of the interval, of the logarithm
  double confidence = 0;
  double others = 0; // variance of what errs beside the runs
  std::size_t most_packings = 0;
  std::size_t pilot_packings = 0; // of the first batch, at each of its two speeds, at most
};

// What is known when runs are planned.
struct TargetState {
  TargetRuns runs;  // that are there; of a new packing nothing
  Counts made;      // asked for so far, whether or not they gave the figure
  RunErrors errors; // before there are runs, as they are expected
};

// Packings by their speeds once `counts` are there too.
Design design_with(const TargetState &state, const Counts &counts);

struct TargetPlan {
  Counts counts;
  Precision precision; // predicted
  double half = 0;     // of the interval
  double cost = 0;     // of what is still to be run
};

// Two speeds at most get more packings; which, and how many, is searched through. Nothing where no plan of
// `most_packings` is enough.
std::optional<TargetPlan> cheapest_plan(const TargetState &state, const TargetCosts &costs, const Aim &aim);

// What is run next: a half of what the plan asks for, for the variances are then known better; all of it
// where that is little.
Counts next_batch(const Counts &made, const Counts &plan);

// The first batch: half of the plan by what is expected, two packings at each of its two speeds at least.
Counts pilot_of(const TargetState &state, const TargetCosts &costs, const Aim &aim);

// No more runs than are allowed: packings are taken off where most are asked for.
Counts within(Counts next, const Counts &made, std::size_t most_runs);

enum class Verdict {
  unknown,    // too few runs gave the figure for an interval
  reached,    // the interval is narrow enough
  more,       // runs are missing
  out_of_runs // no more runs are allowed, or no plan is enough
};

struct Decision {
  Verdict verdict = Verdict::unknown;
  std::optional<TargetEstimate> estimate;
  double half = 0; // of the interval; without an estimate 0
  // All that is still to be run, where the interval is too wide and a plan of that many packings is enough.
  std::optional<TargetPlan> plan;
  Counts next; // asked for with the next batch; as made where nothing is
};

// `curvature_at_least` as in estimate(); `most_runs` of all speeds together. Where the runs tell too
// little, one packing more of the pilot. Fills the errors of the state.
Decision decide(TargetState &state, const TargetCosts &costs, const Aim &aim, std::size_t most_runs,
                double curvature_at_least = 0);

// Runs at one speed, no haste taken off: what is fast enough for its error b / N and the scatter of so many
// packings together to stay within the accuracy. Cost of a run at N crossings: linear in N.
struct OneSpeed {
  double transits = 0;
  std::size_t packings = 0;
  double cost = 0;
};
struct LinearCost {
  double fixed = 0, per_transit = 0, packing = 0;
  double at(double transits) const { return fixed + per_transit * transits; }
};
// What is known when one slow speed is chosen: by an oracle, or by a pilot.
struct OneSpeedKnown {
  double haste = 0; // the largest |b| that is allowed for
  Spread spread;
  std::size_t packings = 0;                                 // of the pilot, which are paid for
  double freedom = std::numeric_limits<double>::infinity(); // of the spread; each further packing adds one
  double cost = 0;                                          // of the pilot
};
// Haste is allowed for up to what the pilot's error leaves possible with this confidence.
OneSpeedKnown known_by_pilot(const TargetEstimate &pilot, std::size_t packings, double cost,
                             double confidence);
// `fastest`: below which no speed is asked for.
OneSpeed one_slow_speed(const OneSpeedKnown &known, const LinearCost &cost, double fastest, const Aim &aim);

} // namespace platen::apps
