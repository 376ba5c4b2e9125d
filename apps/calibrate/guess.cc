// Where the slopes of a search begin.
#include <algorithm>
#include <cmath>

#include "apps/calibrate/calibrate_section.h"
#include "apps/calibrate/space.h"

namespace platen::apps {
namespace {

// Changes of the logarithm of a number with each coordinate, as seen of a concrete of parallel bonds
// (scenes/calibrate_concrete.prm): with the logarithm of shear over tensile strength, the moment contribution
// and the friction angle (rad). Of a pressure's strength the part grows that is not the pressure's own.
constexpr double compressive_by_ratio = 0.25, compressive_by_moments = -2.5, compressive_by_friction = 0.1;
constexpr double confined_by_ratio = 0.5, confined_by_friction = 0.5;
// Yield, and friction of what has broken, hold what is confined.
constexpr double confined_by_limits = 0.2, confined_by_contacts = 0.2;
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

double secant_slope(const Target &target, FreeParameter parameter, const Choice &at) {
  return parameter == FreeParameter::shear_strength ? secant_by_ratio : elastic_slope(target, parameter, at);
}

double strength_slope(const Target &target, FreeParameter parameter, double share) {
  const bool ratio = target.kind == TargetKind::ratio, tension = target.kind == TargetKind::tension,
             confined = target.kind == TargetKind::strength_at_pressure || ratio;
  switch (parameter) {
    case FreeParameter::modulus:
      return target.kind == TargetKind::strain_at_peak ? -1 : 0;
    case FreeParameter::tensile_strength:
      return ratio ? 0 : share;
    case FreeParameter::shear_strength:
      return tension ? 0 : (confined ? confined_by_ratio : compressive_by_ratio);
    case FreeParameter::moment_contribution:
      return tension || ratio ? 0 : compressive_by_moments;
    case FreeParameter::friction_angle:
      return tension ? 0 : (confined ? confined_by_friction : compressive_by_friction);
    case FreeParameter::compression_limits:
      return confined ? confined_by_limits : 0;
    case FreeParameter::contact_friction:
      return confined ? confined_by_contacts : 0;
    default:
      return 0;
  }
}

// s(e) = S F(e G/S): stresses in proportion to the strengths S and strains to S over the modulus G.
double curve_slope(const TargetCurve &curve, FreeParameter parameter, double strain) {
  const double step = 0.5 * curve.last_strain() / curve_points, from = strain - step,
               to = std::min(strain + step, curve.last_strain());
  const double steep = strain * (curve.stress_at(to) - curve.stress_at(from)) / (to - from);
  if (parameter == FreeParameter::modulus) return steep / curve.largest_stress();
  if (parameter == FreeParameter::tensile_strength)
    return (curve.stress_at(strain) - steep) / curve.largest_stress();
  return 0;
}

// Of the strength at a pressure, that without one; 1 where none is wanted.
double share_of(const Goals &goals, const Target &target) {
  if (target.kind != TargetKind::strength_at_pressure) return 1;
  for (const Goal &goal : goals.all())
    if (goal.target.kind == TargetKind::strength) return std::min(1.0, goal.target.value / target.value);
  return 1;
}

} // namespace

Eigen::MatrixXd Space::guess(const Goals &goals, const std::vector<std::size_t> &of) const {
  Eigen::Index rows = 0;
  for (const std::size_t k : of)
    rows += goals.rows(k);
  Eigen::MatrixXd slopes(rows, static_cast<Eigen::Index>(free_.size()));
  for (std::size_t column = 0; column < free_.size(); ++column) {
    const FreeParameter parameter = free_[column];
    Eigen::Index row = 0;
    const auto put = [&](double slope) {
      slopes(row++, static_cast<Eigen::Index>(column)) = axes_[column].unit * slope;
    };
    for (const std::size_t k : of) {
      const Goal &goal = goals.all()[k];
      const double scale = goals.scale(k);
      if (goal.elastic())
        put(scale * elastic_slope(goal.target, parameter, start_));
      else if (goal.target.kind == TargetKind::other)
        put(0);
      else if (goal.target.kind == TargetKind::secant_ratio)
        put(scale * secant_slope(goal.target, parameter, start_));
      else if (!goal.curve)
        put(scale * strength_slope(goal.target, parameter, share_of(goals, goal.target)));
      else
        for (std::size_t point = 1; point <= curve_points; ++point)
          put(scale * curve_slope(*goal.curve, parameter,
                                  goal.curve->last_strain() * static_cast<double>(point) / curve_points));
    }
  }
  return slopes;
}

} // namespace platen::apps
