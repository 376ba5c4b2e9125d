#include "apps/calibrate/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

constexpr double any_step = 10;                    // in large changes, of scales whose effect is known
constexpr double at_bound = 1e-3, on_bound = 1e-9; // of the room between bounds
// Of the room: what a change is set beside where a number that may be zero is less than that.
constexpr double least_share = 0.1;

bool bends(const Scene &scene) {
  const std::optional<dem::BondParameters> bond = scene.bond.parameters();
  return scene.bond.has("moment_contribution") && scene.model.rotation && dem::bends(dem::bond_law(*bond));
}

std::vector<FreeParameter> needed_parameters(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  const bool curve = c.wants({TargetKind::curve}),
             both = c.wants({TargetKind::tension}) && (c.wants({TargetKind::strength}) || curve);
  std::vector<FreeParameter> free;
  const auto need = [&](FreeParameter parameter, bool where) {
    if (where) free.push_back(parameter);
  };
  need(FreeParameter::modulus, c.wants({TargetKind::young_modulus}) || curve);
  need(scene.bond.is<dem::CohesiveBeam>() ? FreeParameter::radius_multiplier : FreeParameter::stiffness_ratio,
       c.wants({TargetKind::poisson_ratio}));
  need(FreeParameter::tensile_strength, c.wants_strengths());
  need(FreeParameter::shear_strength, both);
  // A curve bends where bonds yield.
  need(FreeParameter::compression_limits, curve && has_parameter(scene, FreeParameter::compression_limits));
  // Elasto-damage-plastic bonds have neither; without moments there is nothing to count.
  need(FreeParameter::moment_contribution, both && bends(scene));
  need(FreeParameter::friction_angle, (both || c.wants({TargetKind::strength_at_pressure})) &&
                                          has_parameter(scene, FreeParameter::friction_angle));
  return free;
}

// Changes of the logarithm of a strength with each coordinate, as seen of a concrete of parallel bonds
// (scenes/calibrate_concrete.prm): with the logarithm of shear over tensile strength, the moment contribution
// and the friction angle (rad). Of a pressure's strength the part grows that is not the pressure's own.
// Yield, and friction of what has broken, hold what is confined.
struct StrengthSlopes {
  FreeParameter parameter;
  double tension, compression, pressure, ratio; // of one test over another
};
constexpr StrengthSlopes strength_slopes[] = {{FreeParameter::tensile_strength, 1, 1, 1, 0},
                                              {FreeParameter::shear_strength, 0, 0.25, 0.5, 0.5},
                                              {FreeParameter::moment_contribution, 0, -2.5, -2.5, 0},
                                              {FreeParameter::friction_angle, 0, 0.1, 0.5, 0.5},
                                              {FreeParameter::compression_limits, 0, 0, 0.2, 0.2},
                                              {FreeParameter::contact_friction, 0, 0, 0.2, 0.2}};
// Poisson's ratio of beams by the logarithm of their radius (docs/theory.md, the abacus of silica).
constexpr double poisson_by_radius = -0.2;
constexpr double modulus_by_radius = 2;
// Of the ready materials (bench/results/materials.md): the larger compressive over tensile strength, the more
// bonds have broken by 40 % of it. That ratio goes with shear over tensile strength of the bond as above.
constexpr double secant_by_ratio = 0.25;

// Voigt: E ~ (2 + 3 r)/(4 + r), nu = (1 - r)/(4 + r).
double elastic_slope(const Target &target, FreeParameter parameter, const Choice &at) {
  const bool young = target.kind == TargetKind::young_modulus;
  const double r = at[FreeParameter::stiffness_ratio];
  switch (parameter) {
    case FreeParameter::modulus:
      return young ? 1 : 0;
    case FreeParameter::stiffness_ratio:
      return young ? 3 * r / (2 + 3 * r) - r / (4 + r) : -5 * r / ((4 + r) * (4 + r)) / target.value;
    case FreeParameter::radius_multiplier:
      return young ? modulus_by_radius : poisson_by_radius / target.value;
    default:
      return 0;
  }
}

// Of the strength at a pressure, that without one; 1 where none is wanted.
double share_of(const Goals &goals, const Target &target) {
  if (target.kind != TargetKind::strength_at_pressure) return 1;
  for (const Goal &goal : goals.all())
    if (goal.kind == TargetKind::strength) return std::min(1.0, goal.value / target.value);
  return 1;
}

double strength_slope(const Goals &goals, const Target &target, FreeParameter parameter) {
  if (parameter == FreeParameter::modulus) return target.kind == TargetKind::strain_at_peak ? -1 : 0;
  for (const StrengthSlopes &slopes : strength_slopes) {
    if (slopes.parameter != parameter) continue;
    const double slope = target.kind == TargetKind::tension                ? slopes.tension
                         : target.kind == TargetKind::ratio                ? slopes.ratio
                         : target.kind == TargetKind::strength_at_pressure ? slopes.pressure
                                                                           : slopes.compression;
    return parameter == FreeParameter::tensile_strength ? slope * share_of(goals, target) : slope;
  }
  return 0;
}

// s(e) = S F(e G/S): stresses in proportion to the strengths S and strains to S over the modulus G.
double curve_slope(const Curve &curve, FreeParameter parameter, double strain) {
  const double step = 0.5 * curve.last_strain() / curve_points, from = strain - step,
               to = std::min(strain + step, curve.last_strain());
  const double steep = strain * (curve.stress_at(to) - curve.stress_at(from)) / (to - from);
  if (parameter == FreeParameter::modulus) return steep / curve.largest_stress();
  if (parameter == FreeParameter::tensile_strength)
    return (curve.stress_at(strain) - steep) / curve.largest_stress();
  return 0;
}

// A number for each row of the goal.
std::vector<double> slopes_of(const Goals &goals, const Goal &goal, FreeParameter parameter,
                              const Choice &at) {
  if (goal.curve) {
    std::vector<double> slopes;
    for (std::size_t step = 1; step <= curve_points; ++step)
      slopes.push_back(
          curve_slope(*goal.curve, parameter, Curve::strain_of(step, goal.curve->last_strain())));
    return slopes;
  }
  if (goal.kind == TargetKind::other) return {0};
  if (goal.kind == TargetKind::secant_ratio && parameter == FreeParameter::shear_strength)
    return {secant_by_ratio};
  if (goal.is_elastic() || goal.kind == TargetKind::secant_ratio) return {elastic_slope(goal, parameter, at)};
  return {strength_slope(goals, goal, parameter)};
}

} // namespace

std::vector<ParameterFacts> parameters_of(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  const std::vector<ParameterFacts> facts = parameter_facts(c);
  std::vector<ParameterFacts> all;
  for (const FreeParameter one : c.free.empty() && c.freed.empty() ? needed_parameters(scene) : c.free)
    all.push_back(facts[static_cast<std::size_t>(one)]);
  all.insert(all.end(), facts.begin() + parameter_count, facts.end());
  return Space(scene, choice_of(scene), all).free();
}

Space::Space(const Scene &scene, const Choice &start, const std::vector<ParameterFacts> &free)
    : start_(start) {
  for (const ParameterFacts &facts : free) {
    const Axis axis{facts, bounds_of(scene, facts.parameter, start[facts.parameter])};
    if (!(axis.room() <= 0)) axes_.push_back(axis);
  }
}

std::vector<ParameterFacts> Space::free() const {
  std::vector<ParameterFacts> all;
  for (const Axis &axis : axes_)
    all.push_back(axis.facts);
  return all;
}

double Space::Axis::number(const Choice &of) const {
  const double own = of[facts.parameter];
  return facts.parameter == FreeParameter::shear_strength ? own / of[FreeParameter::tensile_strength] : own;
}

double Space::Axis::place_of(double number) const {
  return (facts.logarithm ? std::log(number) : number) / facts.change;
}

// A search that rests on a bound misses it by round-off: an angle of zero stays zero.
double Space::Axis::number_at(double coordinate) const {
  const double value = facts.logarithm ? std::exp(facts.change * coordinate) : facts.change * coordinate;
  for (const double bound : {bounds.low, bounds.high})
    if (std::abs(value - bound) < on_bound * room()) return bound;
  return value;
}

Eigen::Index Space::place(FreeParameter parameter) const {
  return std::find_if(axes_.begin(), axes_.end(),
                      [&](const Axis &axis) { return axis.facts.parameter == parameter; }) -
         axes_.begin();
}

Eigen::VectorXd Space::scaled(Eigen::VectorXd x, FreeParameter parameter, double factor) const {
  const Eigen::Index k = place(parameter);
  x[k] += std::log(factor) / axes_[static_cast<std::size_t>(k)].facts.change;
  return x;
}

Choice Space::choice(const Eigen::VectorXd &x) const {
  Choice to = start_;
  double ratio = start_[FreeParameter::shear_strength] / start_[FreeParameter::tensile_strength];
  for (Eigen::Index k = 0; k < count(); ++k) {
    const Axis &axis = axes_[static_cast<std::size_t>(k)];
    const bool of_ratio = axis.facts.parameter == FreeParameter::shear_strength;
    (of_ratio ? ratio : to[axis.facts.parameter]) = axis.number_at(x[k]);
  }
  if (free(FreeParameter::tensile_strength) || free(FreeParameter::shear_strength))
    to[FreeParameter::shear_strength] = ratio * to[FreeParameter::tensile_strength];
  return to;
}

std::vector<SearchParameter> Space::parameters(bool exact) const {
  std::vector<SearchParameter> all;
  for (const Axis &axis : axes_) {
    const bool known = axis.facts.scale && exact;
    all.push_back({axis.place_of(axis.number(start_)), axis.place_of(axis.bounds.low),
                   axis.place_of(axis.bounds.high), known ? any_step : axis.facts.step, known});
  }
  return all;
}

Eigen::MatrixXd Space::guess(const Goals &goals, const std::vector<std::size_t> &of) const {
  Eigen::Index rows = 0;
  for (const std::size_t k : of)
    rows += goals.all()[k].rows();
  Eigen::MatrixXd slopes(rows, count());
  for (Eigen::Index column = 0; column < count(); ++column) {
    const ParameterFacts &facts = axes_[static_cast<std::size_t>(column)].facts;
    Eigen::Index row = 0;
    for (const std::size_t k : of)
      for (const double slope : slopes_of(goals, goals.all()[k], facts.parameter, start_))
        slopes(row++, column) = facts.change * (goals.scale(k) * slope);
  }
  return slopes;
}

Eigen::MatrixXd Space::by_logarithms(const Eigen::MatrixXd &slopes, const Choice &at) const {
  Eigen::MatrixXd by = slopes;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const Axis &axis = axes_[k];
    const double own = std::max(axis.number(at), least_share * axis.room());
    const double rate = (axis.facts.logarithm ? 1 : own) / axis.facts.change;
    by.col(static_cast<Eigen::Index>(k)) *= rate;
  }
  // Both strengths grow along the first; alone it grows against the second.
  if (free(FreeParameter::tensile_strength) && free(FreeParameter::shear_strength))
    by.col(place(FreeParameter::tensile_strength)) -= by.col(place(FreeParameter::shear_strength));
  return by;
}

std::vector<std::string> Space::at_bounds(const Choice &at) const {
  std::vector<std::string> all;
  for (const Axis &axis : axes_) {
    const double low = axis.place_of(axis.bounds.low), high = axis.place_of(axis.bounds.high),
                 here = axis.place_of(axis.number(at)), room = at_bound * (high - low);
    if (here > low + room && here < high - room) continue;
    const bool ratio = axis.facts.parameter == FreeParameter::shear_strength;
    const ScreenUnit unit = ratio ? ScreenUnit() : axis.facts.unit;
    all.push_back(fmt::format("{} {:.4g}{} (searched from {:.4g} to {:.4g})", axis.facts.bounded(),
                              axis.number(at) / unit.factor, unit.word, axis.bounds.low / unit.factor,
                              axis.bounds.high / unit.factor));
  }
  return all;
}

} // namespace platen::apps
