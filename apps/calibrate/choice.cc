#include "apps/calibrate/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/units.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

// Large changes of what is taken by its logarithm, and how much of one is tried at once.
constexpr double factor = 2.5, one_step = 0.35, long_step = 0.5;
// Of moduli and strengths: factors to what they begin with that no scene asks for.
constexpr double any_factor = 1e4;
constexpr double largest_friction = 1.0471975511965976; // rad; of an angle that a search may turn

std::vector<ParameterFacts> known_facts() {
  using Parameter = FreeParameter;
  const ScreenUnit plain, gigapascal{1e9, " GPa", " Pa"}, megapascal{1e6, " MPa", " Pa"},
      degrees{degree, " degree", " rad"};
  return {{Parameter::modulus, "modulus", "", "Bond/Modulus", "bond_modulus_pa", "bond modulus", gigapascal,
           true, true, factor, long_step, true},
          {Parameter::stiffness_ratio, "stiffness ratio", "stiffness_ratio", "Bond/Stiffness ratio",
           "stiffness_ratio", "stiffness ratio", plain, true, true, factor, long_step},
          {Parameter::radius_multiplier, "radius multiplier", "", "Bond/Radius multiplier",
           "radius_multiplier", "radius multiplier", plain, true, true, 1, long_step},
          {Parameter::poisson_ratio, "", "poisson_ratio", "Bond/Poisson ratio", "bond_poisson_ratio",
           "bond Poisson's ratio", plain, true, true, factor, long_step, true},
          {Parameter::tensile_strength, "tensile strength", "tensile_strength", "Bond/Tensile strength",
           "bond_tensile_strength_pa", "tensile strength", megapascal, false, true, factor, long_step, true},
          {Parameter::shear_strength, "shear strength", "shear_strength", "Bond/Shear strength",
           "bond_shear_strength_pa", "shear strength", megapascal, false, true, factor, one_step},
          {Parameter::moment_contribution, "moment contribution", "moment_contribution",
           "Bond/Moment contribution", "moment_contribution", "moment contribution", plain, false, false, 0.6,
           one_step},
          {Parameter::friction_angle, "friction angle", "friction_angle", "Bond/Friction angle",
           "friction_angle_rad", "friction angle", degrees, false, false, 1, one_step},
          {Parameter::compression_limits, "compression limits", "", "Bond/Compression limits",
           "compression_limits_factor", "factor of compression limits", plain, false, true, factor, one_step},
          {Parameter::contact_friction, "contact friction", "", "Contact/Friction", "contact_friction",
           "contact friction", plain, false, false, 1, one_step}};
}

} // namespace

std::vector<ParameterFacts> parameter_facts(const Calibrate &calibrate) {
  std::vector<ParameterFacts> all = known_facts();
  for (const FreedEntry &freed : calibrate.freed) {
    const std::string unit = freed.unit == "1" ? "" : " " + freed.unit;
    std::string column = freed.path;
    std::replace_if(
        column.begin(), column.end(), [](char c) { return c == '/' || c == ' '; }, '_');
    const bool logarithm = freed.bounds.low > 0;
    const double change = logarithm ? factor : freed.bounds.high - freed.bounds.low;
    all.push_back({static_cast<FreeParameter>(all.size()),
                   "",
                   "",
                   freed.path,
                   column,
                   freed.path,
                   {1, unit, unit},
                   false,
                   logarithm,
                   change,
                   one_step});
  }
  return all;
}

ParameterFacts facts_of(const Calibrate &calibrate, FreeParameter parameter) {
  return parameter_facts(calibrate)[static_cast<std::size_t>(parameter)];
}

Words<FreeParameter> free_words() {
  Words<FreeParameter> words;
  for (const ParameterFacts &one : known_facts())
    if (!one.word.empty()) words.emplace_back(one.word, one.parameter);
  return words;
}

bool has_parameter(const Scene &scene, FreeParameter parameter) {
  if (parameter == FreeParameter::compression_limits) return !scene.bond.list("compression_limits").empty();
  if (parameter == FreeParameter::contact_friction)
    return scene.contact.tangential != dem::TangentialContact::none;
  const std::string member = facts_of(calibrate_of(scene), parameter).member;
  return member.empty() || scene.bond.has(member);
}

Bounds bounds_of(const Scene &scene, FreeParameter parameter, double from) {
  const Calibrate &c = calibrate_of(scene);
  const auto place = static_cast<std::size_t>(parameter);
  if (place >= parameter_count) return c.freed[place - parameter_count].bounds;
  Bounds otherwise{from, from};
  if (facts_of(c, parameter).scale) otherwise = {from / any_factor, from * any_factor};
  const bool turned = c.wants({TargetKind::strength_at_pressure}) || !c.free.empty();
  if (parameter == FreeParameter::friction_angle && turned) otherwise = {0, largest_friction};
  const auto found = c.bounds.find(parameter);
  const Bounds asked = found == c.bounds.end() ? Bounds() : found->second;
  return {given(asked.low) ? asked.low : otherwise.low, given(asked.high) ? asked.high : otherwise.high};
}

Choice choice_of(const Scene &scene) {
  const Calibrate &calibrate = calibrate_of(scene);
  Choice c;
  for (const ParameterFacts &one : known_facts())
    if (!one.member.empty()) c[one.parameter] = scene.bond.number(one.member);
  c[FreeParameter::modulus] = scene.model.bond_layout.modulus;
  c[FreeParameter::radius_multiplier] = scene.model.bond_layout.radius_multiplier;
  c[FreeParameter::compression_limits] = 1;
  c[FreeParameter::contact_friction] = scene.contact.friction;
  for (const FreedEntry &freed : calibrate.freed)
    c.numbers.push_back(freed.own);
  return c;
}

std::vector<std::string> overrides_of(const Scene &scene, const Choice &c) {
  std::vector<std::string> overrides;
  const Choice own = choice_of(scene);
  for (const ParameterFacts &facts : parameter_facts(calibrate_of(scene))) {
    const double value = c[facts.parameter];
    // What is unbreakable, or nobody has asked for, stays so.
    if (value == own[facts.parameter] || std::isnan(value)) continue;
    std::string text = shortest_text(value) + facts.unit.si;
    if (facts.parameter == FreeParameter::compression_limits) {
      text.clear();
      for (const double limit : scene.bond.list("compression_limits"))
        text += (text.empty() ? "" : ", ") + shortest_text(value * limit) + " Pa";
    }
    overrides.push_back(facts.entry + " = " + text);
  }
  return overrides;
}

std::string text_of(const ParameterFacts &facts, double value) {
  return fmt::format("{} {:.4g}{}", facts.words, value / facts.unit.factor, facts.unit.word);
}

} // namespace platen::apps
