#include "apps/calibrate/goals.h"

#include <algorithm>
#include <cmath>
#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {
namespace {

// What a specimen that comes to no peak is taken for, over what is wanted.
constexpr double without_peak = 2;
constexpr double prism_slenderness = 2.4; // Hughes and Bahramian 1967
constexpr double short_slenderness = 1, slender = 2;

// Pressure, or friction of the platens, may hold a specimen so that it flows on.
bool may_flow(TargetKind kind) {
  return kind == TargetKind::strength_at_pressure || kind == TargetKind::gain_by_friction ||
         kind == TargetKind::cube_over_prism || kind == TargetKind::slenderness;
}

SpecimenTest test_of(const Scene &scene, const Target &target) {
  SpecimenTest test;
  switch (target.kind) {
    case TargetKind::young_modulus:
    case TargetKind::poisson_ratio:
      return test;
    case TargetKind::tension:
      test.kind = TestKind::tension;
      break;
    case TargetKind::splitting:
      test.kind = TestKind::splitting;
      test.friction = target.friction;
      break;
    default:
      test.kind = TestKind::compression;
      test.friction = target.friction;
      test.box = target.box && scene.specimen.shape != SpecimenShape::box;
      test.slenderness = target.slenderness;
  }
  test.rate = target.rate, test.strain = target.strain;
  if (target.kind == TargetKind::strength_at_pressure) {
    test.pressure = target.pressure;
    test.sleeve = target.sleeve;
  }
  if (target.kind == TargetKind::cube_over_prism) {
    test.box = scene.specimen.shape != SpecimenShape::box;
    test.slenderness = 1;
  }
  if (target.kind == TargetKind::slenderness && std::isnan(target.slenderness))
    test.slenderness = short_slenderness;
  return test;
}

// Of the specimen that a short one is compared with; as the scene has it where that is what it has.
double slender_of(const Scene &scene, const SpecimenTest &test) {
  const SpecimenSection &own = scene.specimen;
  const bool same = std::abs(own.height - slender * own.width()) < 1e-9 * own.height;
  return same && !test.box ? not_given : slender;
}

int order_of(const Goal &goal) { // the longest first
  if (goal.elastic()) return 2;
  return goal.target.kind == TargetKind::strength_at_pressure ? 0 : 1;
}

} // namespace

Goals::Goals(const Scene &scene) : tolerance_(calibrate_of(scene).tolerance) {
  for (const Target &target : calibrate_of(scene).targets)
    add(target);
  for (const TargetKind kind : {TargetKind::young_modulus, TargetKind::poisson_ratio})
    if (std::none_of(goals_.begin(), goals_.end(), [&](const Goal &g) { return g.target.kind == kind; })) {
      Target watched;
      watched.kind = kind;
      add(watched);
    }
  std::vector<Goal *> order;
  for (Goal &goal : goals_)
    order.push_back(&goal);
  std::stable_sort(order.begin(), order.end(),
                   [](const Goal *a, const Goal *b) { return order_of(*a) < order_of(*b); });
  for (Goal *goal : order) {
    SpecimenTest test = test_of(scene, goal->target);
    if (goal->curve)
      test.curve_strain = goal->curve->last_strain(), test.curve_of_gauge = goal->curve->of_gauge;
    goal->test = goal->other = place_of(test);
    if (goal->target.kind == TargetKind::gain_by_friction) {
      test.friction = goal->target.other_friction;
      goal->other = place_of(test);
    }
    if (goal->target.kind == TargetKind::slenderness) {
      test.slenderness = slender_of(scene, test);
      goal->other = place_of(test);
    }
    if (goal->target.kind == TargetKind::cube_over_prism) {
      test.slenderness = given(goal->target.slenderness) ? goal->target.slenderness : prism_slenderness;
      goal->other = place_of(test);
    }
  }
}

void Goals::add(const Target &target) {
  Goal goal;
  goal.target = target;
  if (target.kind == TargetKind::curve) goal.curve = read_target_curve(target.file);
  goal.words = words_of(target);
  goal.unit = unit_on_screen(target.kind);
  goal.key = key_of(target.kind);
  const auto taken = [&] {
    return std::any_of(goals_.begin(), goals_.end(), [&](const Goal &g) { return g.key == goal.key; });
  };
  for (int count = 2; taken(); ++count)
    goal.key = key_of(target.kind) + "_" + std::to_string(count);
  goals_.push_back(std::move(goal));
}

// A run that keeps a curve serves those that do not, but no two curves.
std::size_t Goals::place_of(const SpecimenTest &test) {
  for (std::size_t k = 0; k < tests_.size(); ++k) {
    SpecimenTest &there = tests_[k];
    const bool clash = there.curve_strain > 0 && test.curve_strain > 0 && there.name() != test.name();
    if (!same_test(there, test) || clash) continue;
    if (test.curve_strain > 0) there = test;
    return k;
  }
  tests_.push_back(test);
  return tests_.size() - 1;
}

std::vector<std::size_t> Goals::wanted() const {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < goals_.size(); ++k)
    if (goals_[k].wanted()) places.push_back(k);
  return places;
}

std::vector<std::size_t> Goals::wanted_elastic() const {
  std::vector<std::size_t> places = wanted();
  places.erase(
      std::remove_if(places.begin(), places.end(), [&](std::size_t k) { return !goals_[k].elastic(); }),
      places.end());
  return places;
}

// NaN where a run of it came to no end.
double Goals::number(const Goal &goal, const TrialResult &r, const TrialResult &other) {
  switch (goal.target.kind) {
    case TargetKind::young_modulus:
      return r.young_modulus;
    case TargetKind::poisson_ratio:
      return r.poisson_ratio;
    case TargetKind::strain_at_peak:
      return r.strain_at_peak;
    case TargetKind::secant_ratio: // add_moduli took it off the curve
      return r.poisson_ratio;
    case TargetKind::gain_by_friction:
    case TargetKind::cube_over_prism:
    case TargetKind::slenderness:
      return r.strength / other.strength;
    case TargetKind::curve:
      return r.curve.empty() ? not_given : root_mean_square(misses_of_curve(*goal.curve, r.curve));
    default:
      return r.strength;
  }
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
  Measured m;
  m.numbers.resize(goals_.size()), m.curves.resize(goals_.size());
  const std::size_t stride = elastic_alone ? 1 : tests_.size();
  for (std::size_t first = 0; first < results.size(); first += stride) {
    const auto of = [&](std::size_t test) -> const TrialResult & {
      return results[elastic_alone ? first : first + test];
    };
    m.platen_modulus.add(of(elastic_test()).platen_modulus);
    for (std::size_t k = 0; k < goals_.size(); ++k) {
      const Goal &goal = goals_[k];
      if (elastic_alone && !goal.elastic()) continue;
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
  if (!goal.curve) return m.numbers[k].mean() / goal.target.value - 1;
  return m.curves[k].empty() ? not_given : root_mean_square(misses_of_curve(*goal.curve, m.curves[k]));
}

bool Goals::met(std::size_t k, const Measured &m) const {
  return std::abs(miss(k, m)) <= goals_[k].target.tolerance;
}

bool Goals::surely_met(std::size_t k, const Measured &m) const {
  constexpr double errors = 2, least = 0.25; // standard errors; of the tolerance
  const double tolerance = goals_[k].target.tolerance,
               error = goals_[k].curve ? 0 : std::abs(m.numbers[k].error_of_mean() / goals_[k].target.value);
  const double margin = std::isnan(error) ? 0 : errors * error;
  return std::abs(miss(k, m)) <= std::max(tolerance - margin, least * tolerance);
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
  const Goal &goal = goals_[k];
  const double points = goal.curve ? curve_points : 1;
  return std::sqrt(goal.target.weight / points) * tolerance_ / goal.target.tolerance;
}

Eigen::VectorXd Goals::responses(const std::vector<std::size_t> &goals, const Measured &m) const {
  std::vector<double> all;
  for (const std::size_t k : goals) {
    const Goal &goal = goals_[k];
    double miss = this->miss(k, m);
    if (std::isnan(miss) && !may_flow(goal.target.kind)) return {};
    if (std::isnan(miss)) miss = without_peak - 1;
    if (goal.curve)
      for (const double one : misses_of_curve(*goal.curve, m.curves[k]))
        all.push_back(scale(k) * one);
    else
      all.push_back(scale(k) * (goal.is_poisson() ? miss : std::log1p(miss)));
  }
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

} // namespace platen::apps
