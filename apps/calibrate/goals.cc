#include "apps/calibrate/goals.h"

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

// What a specimen that comes to no peak is taken for, over what is wanted.
constexpr double without_peak = 2;

// Pressure, or friction of the platens, may hold a specimen so that it flows on.
bool may_flow(TargetKind kind) {
  return kind == TargetKind::strength_at_pressure || kind == TargetKind::ratio || kind == TargetKind::other;
}

int order_of(const Goal &goal) { // the longest first
  if (goal.is_elastic()) return 2;
  return goal.kind == TargetKind::strength_at_pressure ? 0 : 1;
}

// NaN where a run of it came to no end.
double number(const Goal &goal, const TrialResult &own, const TrialResult &other) {
  if (goal.curve) return own.curve.empty() ? not_given : root_mean_square(goal.curve->misses(own.curve));
  const double value = own.number(goal.figure);
  return goal.kind == TargetKind::ratio ? value / other.number(goal.figure) : value;
}

} // namespace

Goals::Goals(const Scene &scene) : asked_(calibrate_of(scene)) {
  for (const Target &target : asked_.targets)
    add(target);
  for (const char *watched : {"young modulus", "poisson ratio"})
    if (const Target target = target_of(watched); !asked_.wants({target.kind})) add(target);
  std::vector<Goal *> order;
  for (Goal &goal : goals_)
    order.push_back(&goal);
  std::stable_sort(order.begin(), order.end(),
                   [](const Goal *a, const Goal *b) { return order_of(*a) < order_of(*b); });
  for (Goal *goal : order) {
    goal->test = goal->other = place_of(*goal, goal->entries, goal->key);
    if (goal->kind == TargetKind::ratio) goal->other = place_of(*goal, goal->over, goal->key + "_over");
  }
}

void Goals::add(const Target &target) {
  Goal goal{target, 0, 0, {}};
  if (target.kind == TargetKind::curve) goal.curve = read_curve(target.file);
  const auto taken = [&] {
    return std::any_of(goals_.begin(), goals_.end(), [&](const Goal &g) { return g.key == goal.key; });
  };
  for (int count = 2; taken(); ++count)
    goal.key = target.key + "_" + std::to_string(count);
  goals_.push_back(std::move(goal));
}

// One run serves all that its entries are the same for; one that keeps a curve also those that keep none.
std::size_t Goals::place_of(const Goal &goal, const std::vector<std::string> &entries,
                            const std::string &name) {
  const double strain = goal.curve ? goal.curve->last_strain() : 0;
  const bool of_gauge = goal.curve && goal.curve->of_gauge;
  const auto serves = [&](const SpecimenTest &there) {
    return there.program == goal.program && there.entries == entries &&
           (strain == 0 || there.curve_strain == 0 ||
            (there.curve_strain == strain && there.curve_of_gauge == of_gauge));
  };
  auto test = std::find_if(tests_.begin(), tests_.end(), serves);
  if (test == tests_.end()) {
    test = tests_.insert(test, SpecimenTest());
    test->program = goal.program, test->entries = entries;
    if (test->loads()) test->name = name;
  }
  if (strain > 0) test->curve_strain = strain, test->curve_of_gauge = of_gauge;
  if (!goal.figure.empty() && !holds(test->figures, goal.figure)) test->figures.push_back(goal.figure);
  return static_cast<std::size_t>(test - tests_.begin());
}

std::vector<std::size_t> Goals::wanted(bool elastic_alone) const {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < goals_.size(); ++k)
    if (goals_[k].wanted() && (goals_[k].is_elastic() || !elastic_alone)) places.push_back(k);
  return places;
}

Measured corrected(Measured m, const Correction &by) {
  for (std::size_t k = 0; k < by.factors.size() && k < m.numbers.size(); ++k) {
    m.numbers[k] = m.numbers[k].scaled(by.factors[k]);
    for (std::size_t point = 0; point < m.curves[k].size(); ++point)
      m.curves[k][point] += by.added[k][point];
  }
  return m;
}

Measured Goals::measured(const std::vector<TrialResult> &results, bool elastic_alone) const {
  Measured m(goals_.size());
  const std::size_t stride = elastic_alone ? 1 : tests_.size();
  for (std::size_t first = 0; first < results.size(); first += stride) {
    const auto of = [&](std::size_t test) -> const TrialResult & {
      return results[elastic_alone ? first : first + test];
    };
    m.platen_modulus.add(of(elastic_test()).number("youngs_modulus_platen_pa"));
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      const Goal &goal = goals_[k];
      if (elastic_alone && !goal.is_elastic()) continue;
      m.numbers[k].add(number(goal, of(goal.test), of(goal.other)));
      const std::vector<double> &curve = of(goal.test).curve;
      if (!goal.curve || curve.empty()) continue;
      m.curves[k].resize(curve_points);
      const auto count = static_cast<double>(m.numbers[k].count()); // this packing among them
      for (std::size_t point = 0; point < curve_points; ++point)
        m.curves[k][point] += (curve[point] - m.curves[k][point]) / count;
    }
  }
  for (const TrialResult &result : results) {
    m.failed += result.good() ? 0 : 1;
    if (result.too_fast() && m.too_fast.empty()) m.too_fast = result.status;
  }
  return m;
}

double Goals::miss(std::size_t k, const Measured &m) const {
  const Goal &goal = goals_[k];
  if (!goal.curve) return m.numbers[k].mean() / goal.value - 1;
  return m.curves[k].empty() ? not_given : root_mean_square(goal.curve->misses(m.curves[k]));
}

bool Goals::met(std::size_t k, const Measured &m) const {
  return std::abs(miss(k, m)) <= goals_[k].tolerance;
}

bool Goals::surely_met(std::size_t k, const Measured &m) const {
  constexpr double errors = 2, least = 0.25; // standard errors; of the tolerance
  const Goal &goal = goals_[k];
  const double error = goal.curve ? 0 : std::abs(m.numbers[k].error_of_mean() / goal.value),
               margin = std::isnan(error) ? 0 : errors * error;
  return std::abs(miss(k, m)) <= std::max(goal.tolerance - margin, least * goal.tolerance);
}

// Packings that are stronger than others are so with other bonds too: what the further ones differ by at one
// choice is what they differ by near it.
Correction Goals::correction(const std::vector<Measured> &training,
                             const std::vector<Measured> &further) const {
  Correction to;
  for (std::size_t k = 0; k < goals_.size(); ++k) {
    double factor = 0, count = 0;
    std::vector<double> added(curve_points, 0);
    const auto take = [&](double weight, double ratio) { factor += weight * ratio, count += weight; };
    for (std::size_t round = 0; round < further.size(); ++round) {
      const Measured &own = training[round], &other = further[round];
      if (round == 0) take(static_cast<double>(own.numbers[k].count()), 1);
      const double ratio = other.numbers[k].mean() / own.numbers[k].mean(),
                   weight = static_cast<double>(other.numbers[k].count());
      if (!std::isfinite(ratio)) continue;
      take(weight, ratio);
      if (goals_[k].curve && !own.curves[k].empty() && !other.curves[k].empty())
        for (std::size_t point = 0; point < curve_points; ++point)
          added[point] += weight * (other.curves[k][point] - own.curves[k][point]);
    }
    for (double &one : added)
      one = count > 0 ? one / count : 0;
    to.factors.push_back(count > 0 ? factor / count : 1);
    to.added.push_back(added);
  }
  return to;
}

double Goals::scale(std::size_t k) const {
  return std::sqrt(1 / static_cast<double>(goals_[k].rows())) * asked_.tolerance / goals_[k].tolerance;
}

Eigen::VectorXd Goals::responses(const std::vector<std::size_t> &goals, const Measured &m) const {
  std::vector<double> all;
  for (const std::size_t k : goals) {
    const Goal &goal = goals_[k];
    double off = miss(k, m);
    if (std::isnan(off) && !may_flow(goal.kind)) return {};
    if (std::isnan(off)) off = without_peak - 1;
    std::vector<double> rows{goal.has_logarithm() ? std::log1p(off) : off};
    if (goal.curve) rows = goal.curve->misses(m.curves[k]);
    for (const double one : rows)
      all.push_back(scale(k) * one);
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

} // namespace platen::apps
