// How a figure is brought to an accuracy that was ordered: what is known after each batch of runs, and what
// is run next.
#pragma once

#include <optional>

#include "apps/study/target_plan.h"

namespace platen::apps {

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

// What an interval that is looked at again and again needs to hold the truth as often as is said: it ends
// where it happens to be narrow. Of 100 studies that would miss at one look 70 may; see
// study_target_decision_test.
double confidence_of_each_look(double confidence);

// No more runs than are allowed: packings are taken off where most are asked for.
Counts within(Counts next, const Counts &made, std::size_t most_runs);

// `curvature_at_least` as in estimate(); `most_runs` of all speeds together. Where the runs tell too
// little, one packing more of the pilot. Fills the errors of the state.
Decision decide(TargetState &state, const TargetCosts &costs, const Aim &aim, std::size_t most_runs,
                double curvature_at_least = 0);

} // namespace platen::apps
