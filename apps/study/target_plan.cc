#include "apps/study/target_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::apps {
namespace {

constexpr std::size_t little = 4; // runs, of which no half is worth a new plan

// A plan, where it is enough.
class Search {
public:
  Search(const TargetState &state, const TargetCosts &costs, const Aim &aim)
      : state_(state), costs_(costs), aim_(aim) {}

  std::optional<TargetPlan> best();

private:
  void vary(std::size_t many, std::size_t few);
  bool is_enough(const Counts &counts);
  std::size_t least(Counts counts, std::size_t speed, std::size_t guess);
  double cost(const Counts &counts) const { return costs_.between(state_.made, counts); }

  const TargetState &state_;
  const TargetCosts &costs_;
  const Aim &aim_;
  std::optional<TargetPlan> best_;
};

TargetPlan predicted(const TargetState &state, const TargetCosts &costs, const Aim &aim,
                     const Counts &counts) {
  TargetPlan plan{counts, {}, std::numeric_limits<double>::infinity(), costs.between(state.made, counts)};
  const auto precision = precision_of(design_with(state, counts), state.runs.transits, state.errors);
  if (!precision) return plan;
  plan.precision = *precision;
  plan.half = half_interval(*precision, aim.confidence, aim.others);
  return plan;
}

// What is too wide with known variances is too wide with estimated ones.
bool Search::is_enough(const Counts &counts) {
  const Design design = design_with(state_, counts);
  if (!tells_spread(design)) return false;
  for (const Freedom freedom : {Freedom::infinite, Freedom::counted}) {
    const auto precision = precision_of(design, state_.runs.transits, state_.errors, freedom);
    if (!precision || half_interval(*precision, aim_.confidence, aim_.others) > aim_.accuracy) return false;
  }
  return true;
}

// The least packings at a speed that are enough, from a guess on; most_packings + 1 where none are.
std::size_t Search::least(Counts counts, std::size_t speed, std::size_t guess) {
  const auto enough = [&](std::size_t packings) {
    counts[speed] = packings;
    return is_enough(counts);
  };
  std::size_t low = state_.made[speed], high = std::clamp(guess, low, aim_.most_packings);
  for (std::size_t stride = 1; !enough(high); stride *= 2) {
    if (high == aim_.most_packings) return high + 1;
    low = high + 1, high = std::min(high + stride, aim_.most_packings);
  }
  for (std::size_t stride = 1; high > low && stride > 0;) { // down from what is enough
    const std::size_t tried = high > low + stride ? high - stride : low;
    if (enough(tried))
      high = tried, stride *= 2;
    else
      low = tried + 1, stride = std::max<std::size_t>(1, (high - low) / 2);
    if (high == low) break;
  }
  return high;
}

// Packings at `few` from those that are there on, each time with the least at `many` that are enough. Cost
// falls and then rises: the search ends where it has risen for a while.
void Search::vary(std::size_t many, std::size_t few) {
  constexpr int patience = 6;
  int risen = 0;
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t guess = aim_.most_packings;
  Counts counts = state_.made;
  for (; counts[few] <= aim_.most_packings && risen < patience; ++counts[few]) {
    if (best_ && cost(counts) >= best_->cost) return;
    const std::size_t packings = least(counts, many, guess);
    if (packings > aim_.most_packings) continue;
    guess = packings;
    Counts enough = counts;
    enough[many] = packings;
    const double now = cost(enough);
    risen = now < lowest ? 0 : risen + 1;
    lowest = std::min(lowest, now);
    if (!best_ || now < best_->cost) best_ = TargetPlan{enough, {}, 0, now};
  }
}

std::optional<TargetPlan> Search::best() {
  const std::size_t speeds = state_.made.size();
  for (std::size_t many = 0; many < speeds; ++many)
    for (std::size_t few = 0; few < speeds; ++few)
      if (many != few) vary(many, few);
  if (best_) best_ = predicted(state_, costs_, aim_, best_->counts);
  return best_;
}

} // namespace

double TargetCosts::of(const Counts &counts) const {
  double sum = 0;
  for (std::size_t k = 0; k < counts.size(); ++k)
    sum += runs[k] * static_cast<double>(counts[k]);
  return sum + packing * static_cast<double>(*std::max_element(counts.begin(), counts.end()));
}

Design design_with(const TargetState &state, const Counts &counts) {
  Design all;
  const std::size_t packings =
      std::max(state.runs.logs.size(), *std::max_element(counts.begin(), counts.end()));
  for (std::size_t s = 0; s < packings; ++s) {
    SpeedSet set = s < state.runs.logs.size() ? state.runs.speeds_of(s) : 0;
    for (std::size_t k = 0; k < counts.size(); ++k)
      if (s >= state.made[k] && s < counts[k]) set |= 1U << k;
    if (set != 0) ++all[set];
  }
  return all;
}

std::optional<TargetPlan> cheapest_plan(const TargetState &state, const TargetCosts &costs, const Aim &aim) {
  return Search(state, costs, aim).best();
}

Counts next_batch(const Counts &made, const Counts &plan) {
  std::size_t open = 0;
  for (std::size_t k = 0; k < made.size(); ++k)
    open += plan[k] - made[k];
  if (open <= little) return plan;
  Counts next = made;
  for (std::size_t k = 0; k < made.size(); ++k)
    next[k] += (plan[k] - made[k] + 1) / 2;
  return next;
}

Counts pilot_of(const TargetState &state, const TargetCosts &costs, const Aim &aim) {
  constexpr std::size_t least = 2; // tells_spread
  const std::optional<TargetPlan> plan = cheapest_plan(state, costs, aim);
  Counts pilot(state.made.size(), 0);
  if (!plan) { // as much as is allowed, where it costs least
    pilot[0] = pilot[1] = std::max(least, aim.pilot_packings);
    return pilot;
  }
  for (std::size_t k = 0; k < pilot.size(); ++k)
    if (plan->counts[k] > 0)
      pilot[k] = std::clamp((plan->counts[k] + 1) / 2, least, std::max(least, aim.pilot_packings));
  return pilot;
}

} // namespace platen::apps
