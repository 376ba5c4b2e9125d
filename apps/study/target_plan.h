// The cheapest runs that make an interval narrow enough: so many packings at each speed.
//
// Packings are numbered, and speed k has the first counts[k] of them: a packing that a slow run needs has
// been run fast before, so that the difference of both is free of the packing (common random numbers), and
// most packings are run fast alone, as multilevel Monte Carlo has it (Heinrich 2001, Giles 2008).
#pragma once

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
};

// What is known when runs are planned.
struct TargetState {
  TargetRuns runs; // that are there; of a new packing nothing
  Counts made;     // asked for so far, whether or not they gave the figure
  Spread spread;
  double curvature = 0;
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
// `fastest`: below which no speed is asked for.
OneSpeed one_slow_speed(double slope, const Spread &spread, const LinearCost &cost, double fastest,
                        const Aim &aim);

} // namespace platen::apps
