#include "apps/study/target_plan.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace platen::apps {
namespace {

constexpr std::size_t little = 4; // runs, of which no half is worth a new plan
// An interval that is looked at again and again ends where it happens to be narrow. For it to hold the truth
// as often as is said, of 100 studies that would miss at one look 70 may; see study_target_decision_test.
constexpr double misses_of_each_look = 0.7;

std::size_t sum_of(const Counts &counts) {
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

// The cheapest plan that is enough.
class Search {
public:
  Search(const TargetState &state, const TargetCosts &costs, const Aim &aim)
      : state_(state), costs_(costs), aim_(aim) {}

  // Packings at `few` from those that are there on, each time with the least at `many` that are enough. Cost
  // falls and then rises: the search ends where it has risen for a while.
  void vary(std::size_t many, std::size_t few);
  std::optional<TargetPlan> best;

private:
  // What is too wide with known variances is too wide with estimated ones.
  bool is_enough(const Counts &counts) const;
  std::size_t least(Counts counts, std::size_t speed, std::size_t guess) const;

  const TargetState &state_;
  const TargetCosts &costs_;
  const Aim &aim_;
};

bool Search::is_enough(const Counts &counts) const {
  const Design design = design_with(state_, counts);
  if (!tells_spread(design)) return false;
  for (const Freedom freedom : {Freedom::infinite, Freedom::counted}) {
    const auto precision = precision_of(design, state_.runs.transits, state_.errors, freedom);
    if (!precision || half_interval(*precision, aim_.confidence, aim_.others) > aim_.accuracy) return false;
  }
  return true;
}

// The least packings at a speed that are enough, from a guess on; most_packings + 1 where none are.
std::size_t Search::least(Counts counts, std::size_t speed, std::size_t guess) const {
  const auto enough = [&](std::size_t packings) {
    counts[speed] = packings;
    return is_enough(counts);
  };
  std::size_t low = state_.made[speed], high = std::clamp(guess, low, aim_.most_packings);
  for (std::size_t stride = 1; !enough(high); stride *= 2) {
    if (high == aim_.most_packings) return high + 1;
    low = high + 1, high = std::min(high + stride, aim_.most_packings);
  }
  for (std::size_t stride = 1;
       high > low;) { // down from what is enough, in strides that double while they are
    const std::size_t tried = high - std::min(stride, high - low);
    if (enough(tried))
      high = tried, stride *= 2;
    else
      low = tried + 1, stride = std::max<std::size_t>(1, (high - low) / 2);
  }
  return high;
}

void Search::vary(std::size_t many, std::size_t few) {
  constexpr int patience = 6;
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t guess = aim_.most_packings;
  Counts counts = state_.made;
  for (int risen = 0; counts[few] <= aim_.most_packings && risen < patience; ++counts[few]) {
    if (best && costs_.between(state_.made, counts) >= best->cost) return;
    const std::size_t packings = least(counts, many, guess);
    if (packings > aim_.most_packings) continue;
    guess = packings;
    Counts enough = counts;
    enough[many] = packings;
    const double now = costs_.between(state_.made, enough);
    risen = now < lowest ? 0 : risen + 1;
    lowest = std::min(lowest, now);
    if (!best || now < best->cost) best = TargetPlan{enough, {}, 0, now};
  }
}

// Of the speeds that are run: a run without the figure may have left too little.
Counts one_packing_more(Counts made, std::size_t most_packings) {
  for (std::size_t &packings : made)
    if (packings > 0 && packings < most_packings) ++packings;
  return made;
}

// That Student's variable, of so many degrees of freedom, is less.
double below(double value, double freedom) {
  return std::isinf(freedom) ? boost::math::cdf(boost::math::normal(), value)
                             : boost::math::cdf(boost::math::students_t(freedom), value);
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
  Search search(state, costs, aim);
  const std::size_t speeds = state.made.size();
  for (std::size_t many = 0; many < speeds; ++many)
    for (std::size_t few = 0; few < speeds; ++few)
      if (many != few) search.vary(many, few);
  std::optional<TargetPlan> &best = search.best;
  if (best) {
    best->precision = *precision_of(design_with(state, best->counts), state.runs.transits, state.errors);
    best->half = half_interval(best->precision, aim.confidence, aim.others);
  }
  return best;
}

Counts next_batch(const Counts &made, const Counts &plan) {
  if (sum_of(plan) - sum_of(made) <= little) return plan;
  Counts next = made;
  for (std::size_t k = 0; k < made.size(); ++k)
    next[k] += (plan[k] - made[k] + 1) / 2;
  return next;
}

Counts pilot_of(const TargetState &state, const TargetCosts &costs, const Aim &aim) {
  constexpr std::size_t least = 2; // tells_spread
  const std::size_t most = std::max(least, aim.pilot_packings);
  const std::optional<TargetPlan> plan = cheapest_plan(state, costs, aim);
  Counts pilot(state.made.size(), 0);
  if (!plan) pilot[0] = pilot[1] = most; // as much as is allowed, where it costs least
  for (std::size_t k = 0; plan && k < pilot.size(); ++k)
    if (plan->counts[k] > 0) pilot[k] = std::clamp((plan->counts[k] + 1) / 2, least, most);
  return pilot;
}

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

Decision decide(TargetState &state, const TargetCosts &costs, const Aim &asked, std::size_t most_runs,
                double curvature_at_least) {
  Aim aim = asked;
  aim.confidence = 1 - misses_of_each_look * (1 - asked.confidence);
  Decision decision;
  decision.next = state.made;
  decision.estimate = estimate(state.runs, state.errors.prior, curvature_at_least);
  if (!decision.estimate) {
    decision.next = within(one_packing_more(state.made, aim.pilot_packings), state.made, most_runs);
  } else {
    state.errors = decision.estimate->errors;
    decision.half = half_interval(decision.estimate->precision, aim.confidence, aim.others);
    decision.verdict = decision.half <= aim.accuracy ? Verdict::reached : Verdict::out_of_runs;
    if (decision.verdict == Verdict::reached) return decision;
    decision.plan = cheapest_plan(state, costs, aim);
    if (decision.plan)
      decision.next = within(next_batch(state.made, decision.plan->counts), state.made, most_runs);
  }
  if (decision.next != state.made) decision.verdict = Verdict::more;
  return decision;
}

OneSpeedKnown known_by_pilot(const TargetEstimate &pilot, std::size_t packings, double cost,
                             double confidence) {
  const double haste = std::abs(pilot.slope) +
                       quantile_of(pilot.precision.freedom, confidence) * std::sqrt(pilot.precision.slope);
  return {haste, pilot.errors.spread, packings, pilot.precision.freedom, cost};
}

OneSpeed one_slow_speed(const OneSpeedKnown &known, const LinearCost &cost, double fastest, const Aim &aim) {
  OneSpeed best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t packings = 2; packings <= aim.most_packings; ++packings) {
    const std::size_t further = packings - std::min(packings, known.packings);
    const double count = static_cast<double>(packings), more = static_cast<double>(further);
    if (known.cost + count * cost.at(fastest) > best.cost) break; // and so do more of them
    const double deviation = std::sqrt(known.spread.total() / count + aim.others);
    const auto within = [&](double bias) {
      return below((aim.accuracy - bias) / deviation, known.freedom + more) -
             below((-aim.accuracy - bias) / deviation, known.freedom + more);
    };
    if (within(0) < aim.confidence) continue;
    double low = 0, high = aim.accuracy; // bias that is allowed
    constexpr int halvings = 40;
    for (int k = 0; k < halvings; ++k)
      (within((low + high) / 2) < aim.confidence ? high : low) = (low + high) / 2;
    const double transits = std::max(fastest, known.haste / low),
                 total = known.cost + count * cost.at(transits) + more * cost.packing;
    if (total < best.cost) best = {transits, packings, total};
  }
  return best;
}

} // namespace platen::apps
