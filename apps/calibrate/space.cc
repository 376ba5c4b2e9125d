#include "apps/calibrate/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {
namespace {

// Large changes of coordinates, and how much of one is tried at once.
constexpr double factor_unit = 2.5, moments_unit = 0.6, friction_unit = 1, one_step = 0.35, long_step = 0.5;
// Of moduli and strengths: factors to what they begin with that no scene asks for.
constexpr double any_factor = 1e4, scale_step = 10;
constexpr double largest_friction = 1.0471975511965976; // rad; of an angle that a search may turn
constexpr double at_bound = 1e-3, on_bound = 1e-9;      // of the room between bounds
// Of the room: what a change is set beside where a number that may be zero is less than that.
constexpr double least_share = 0.1;

struct Wants {
  bool young = false, poisson = false, compressive = false, tensile = false, pressure = false, curve = false,
       any = false;
  explicit Wants(const Calibrate &c) {
    for (const Target &t : c.targets) {
      const TargetKind kind = t.kind;
      young = young || kind == TargetKind::young_modulus || kind == TargetKind::curve;
      poisson = poisson || kind == TargetKind::poisson_ratio;
      compressive = compressive || kind == TargetKind::strength || kind == TargetKind::curve;
      tensile = tensile || kind == TargetKind::tension;
      pressure = pressure || kind == TargetKind::strength_at_pressure;
      curve = curve || kind == TargetKind::curve;
      any = any || !t.is_elastic();
    }
  }
};

bool bends(const Scene &scene) {
  const std::optional<dem::BondParameters> bond = scene.bond.parameters();
  return scene.bond.has("moment_contribution") && scene.model.rotation && dem::bends(dem::bond_law(*bond));
}

std::vector<FreeParameter> needed_parameters(const Scene &scene) {
  const Wants wants(calibrate_of(scene));
  const bool both = wants.compressive && wants.tensile;
  std::vector<FreeParameter> free;
  if (wants.young) free.push_back(FreeParameter::modulus);
  if (wants.poisson)
    free.push_back(scene.bond.is<dem::CohesiveBeam>() ? FreeParameter::radius_multiplier
                                                      : FreeParameter::stiffness_ratio);
  if (wants.any) free.push_back(FreeParameter::tensile_strength);
  if (both) free.push_back(FreeParameter::shear_strength);
  // A curve bends where bonds yield.
  if (wants.curve && !scene.bond.list("compression_limits").empty())
    free.push_back(FreeParameter::compression_limits);
  // Elasto-damage-plastic bonds have neither; without moments there is nothing to count.
  if (both && bends(scene)) free.push_back(FreeParameter::moment_contribution);
  if (scene.bond.has("friction_angle") && (both || wants.pressure))
    free.push_back(FreeParameter::friction_angle);
  return free;
}

} // namespace

std::vector<FreeParameter> parameters_of(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  std::vector<FreeParameter> all = c.free.empty() && c.freed.empty() ? needed_parameters(scene) : c.free;
  for (std::size_t k = 0; k < c.freed.size(); ++k)
    all.push_back(static_cast<FreeParameter>(parameter_count + k));
  return Space(scene, choice_of(scene), all).free();
}

Space::Space(const Scene &scene, const Choice &start, const std::vector<FreeParameter> &free)
    : asked_(calibrate_of(scene)), start_(start) {
  for (const FreeParameter parameter : free) {
    const Axis axis = axis_of(scene, parameter);
    if (axis.low >= axis.high) continue;
    free_.push_back(parameter), axes_.push_back(axis);
  }
}

Space::Axis Space::axis_of(const Scene &scene, FreeParameter parameter) const {
  const Calibrate &c = calibrate_of(scene);
  const double own = start_[parameter];
  if (const auto place = static_cast<std::size_t>(parameter); place >= parameter_count) {
    const FreedEntry &freed = c.freed[place - parameter_count];
    if (freed.low > 0) return {true, factor_unit, freed.low, freed.high, one_step};
    return {false, freed.high - freed.low, freed.low, freed.high, one_step};
  }
  const auto or_else = [](double bound, double otherwise) { return given(bound) ? bound : otherwise; };
  switch (parameter) {
    case FreeParameter::stiffness_ratio:
      return {true, factor_unit, c.ratio_low, c.ratio_high, long_step};
    case FreeParameter::radius_multiplier:
      return {true, 1, c.multiplier_low, c.multiplier_high, long_step};
    case FreeParameter::shear_strength:
      return {true, factor_unit, c.strengths_low, c.strengths_high, one_step};
    case FreeParameter::moment_contribution:
      return {false, moments_unit, c.moments_low, or_else(c.moments_high, own), one_step};
    case FreeParameter::friction_angle: {
      const bool turned = Wants(c).pressure || !c.free.empty();
      return {false, friction_unit, or_else(c.friction_low, turned ? 0 : own),
              or_else(c.friction_high, turned ? largest_friction : own), one_step};
    }
    case FreeParameter::compression_limits:
      return {true, factor_unit, c.limits_low, c.limits_high, one_step};
    case FreeParameter::contact_friction:
      return {false, friction_unit, c.contact_friction_low, c.contact_friction_high, one_step};
    default:
      return {true, factor_unit, own / any_factor, own * any_factor, scale_step};
  }
}

bool Space::free(FreeParameter parameter) const {
  return std::find(free_.begin(), free_.end(), parameter) != free_.end();
}

std::size_t Space::place(FreeParameter parameter) const {
  return static_cast<std::size_t>(std::find(free_.begin(), free_.end(), parameter) - free_.begin());
}

Eigen::VectorXd Space::scaled(Eigen::VectorXd x, FreeParameter parameter, double factor) const {
  const std::size_t k = place(parameter);
  x[static_cast<Eigen::Index>(k)] += std::log(factor) / axes_[k].unit;
  return x;
}

double Space::number(FreeParameter parameter, const Choice &of) const {
  return parameter == FreeParameter::shear_strength ? of[parameter] / of[FreeParameter::tensile_strength]
                                                    : of[parameter];
}

Choice Space::choice(const Eigen::VectorXd &x) const {
  Choice to = start_;
  double ratio = start_[FreeParameter::shear_strength] / start_[FreeParameter::tensile_strength];
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const double coordinate = axes_[k].unit * x[static_cast<Eigen::Index>(k)];
    const double value = on_its_bound(axes_[k], axes_[k].logarithm ? std::exp(coordinate) : coordinate);
    (free_[k] == FreeParameter::shear_strength ? ratio : to[free_[k]]) = value;
  }
  if (free(FreeParameter::tensile_strength) || free(FreeParameter::shear_strength))
    to[FreeParameter::shear_strength] = ratio * to[FreeParameter::tensile_strength];
  return to;
}

// A search that rests on a bound misses it by round-off: an angle of zero stays zero.
double Space::on_its_bound(const Axis &axis, double value) {
  for (const double bound : {axis.low, axis.high})
    if (std::abs(value - bound) < on_bound * (axis.high - axis.low)) return bound;
  return value;
}

double Space::place(const Axis &axis, double value) {
  return (axis.logarithm ? std::log(value) : value) / axis.unit;
}

std::vector<SearchParameter> Space::parameters(bool exact) const {
  std::vector<SearchParameter> all;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Axis &axis = axes_[k];
    const bool scale = axis.step == scale_step, known = scale && exact;
    all.push_back({place(axis, number(free_[k], start_)), place(axis, axis.low), place(axis, axis.high),
                   scale && !known ? long_step : axis.step, known});
  }
  return all;
}

Eigen::MatrixXd Space::by_logarithms(const Eigen::MatrixXd &slopes, const Choice &at) const {
  Eigen::MatrixXd by = slopes;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Axis &axis = axes_[k];
    const double own = std::max(number(free_[k], at), least_share * (axis.high - axis.low));
    const double rate = (axis.logarithm ? 1 : own) / axis.unit;
    by.col(static_cast<Eigen::Index>(k)) *= rate;
  }
  // Both strengths grow along the first; alone it grows against the second.
  if (free(FreeParameter::tensile_strength) && free(FreeParameter::shear_strength))
    by.col(static_cast<Eigen::Index>(place(FreeParameter::tensile_strength))) -=
        by.col(static_cast<Eigen::Index>(place(FreeParameter::shear_strength)));
  return by;
}

std::vector<std::string> Space::at_bounds(const Choice &at) const {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < free_.size(); ++k) {
    const Axis &axis = axes_[k];
    const double value = number(free_[k], at), low = place(axis, axis.low), high = place(axis, axis.high),
                 here = place(axis, value), room = at_bound * (high - low);
    if (here > low + room && here < high - room) continue;
    const ParameterFacts facts = facts_of(asked_, free_[k]);
    const bool ratio = free_[k] == FreeParameter::shear_strength;
    const double unit = ratio ? 1 : facts.unit;
    all.push_back(fmt::format("{} {:.4g}{} (searched from {:.4g} to {:.4g})",
                              ratio ? "shear over tensile strength" : facts.words, value / unit,
                              ratio ? "" : facts.unit_word, axis.low / unit, axis.high / unit));
  }
  return all;
}

} // namespace platen::apps
