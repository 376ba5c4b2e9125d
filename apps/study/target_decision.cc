#include "apps/study/target_decision.h"

#include <algorithm>
#include <numeric>

namespace platen::apps {
namespace {

constexpr double misses_of_each_look = 0.7;

std::size_t sum_of(const Counts &counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

// Of the speeds that are run: a run without the figure may have left too little.
Counts one_packing_more(Counts made, std::size_t most_packings) {
  for (std::size_t &packings : made)
    if (packings > 0 && packings < most_packings) ++packings;
  return made;
}

} // namespace

Counts within(Counts next, const Counts &made, std::size_t most_runs) {
  const auto open = [&](std::size_t k) { return next[k] - made[k]; };
  for (std::size_t sum = sum_of(next); sum > most_runs && sum > sum_of(made); --sum) {
    std::size_t most = 0;
    for (std::size_t k = 1; k < next.size(); ++k)
      if (open(k) > open(most)) most = k;
    --next[most];
  }
  return next;
}

double confidence_of_each_look(double confidence) {
  return 1 - misses_of_each_look * (1 - confidence);
}

Decision decide(TargetState &state, const TargetCosts &costs, const Aim &asked, std::size_t most_runs,
                double curvature_at_least) {
  Aim aim = asked;
  aim.confidence = confidence_of_each_look(asked.confidence);
  Decision decision;
  decision.next = state.made;
  decision.estimate = estimate(state.runs, state.errors.prior, curvature_at_least);
  if (!decision.estimate) {
    decision.next = within(one_packing_more(state.made, aim.pilot_packings), state.made, most_runs);
    if (decision.next != state.made) decision.verdict = Verdict::more;
    return decision;
  }
  state.errors = decision.estimate->errors;
  decision.half = half_interval(decision.estimate->precision, aim.confidence, aim.others);
  if (decision.half <= aim.accuracy) {
    decision.verdict = Verdict::reached;
    return decision;
  }
  decision.verdict = Verdict::out_of_runs;
  decision.plan = cheapest_plan(state, costs, aim);
  if (!decision.plan) return decision;
  decision.next = within(next_batch(state.made, decision.plan->counts), state.made, most_runs);
  if (decision.next != state.made) decision.verdict = Verdict::more;
  return decision;
}

} // namespace platen::apps
