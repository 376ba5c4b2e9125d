#include "apps/calibrate/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/units.h"
#include "base/pi.h"

namespace platen::apps {

std::vector<ParameterFacts> parameter_facts(const Calibrate &calibrate) {
  constexpr double degree = pi / 180;
  std::vector<ParameterFacts> all{
      {FreeParameter::modulus, "Bond/Modulus", "bond_modulus_pa", "bond modulus", 1e9, " GPa", " Pa", true},
      {FreeParameter::stiffness_ratio, "Bond/Stiffness ratio", "stiffness_ratio", "stiffness ratio", 1, "",
       "", true},
      {FreeParameter::radius_multiplier, "Bond/Radius multiplier", "radius_multiplier", "radius multiplier",
       1, "", "", true},
      {FreeParameter::poisson_ratio, "Bond/Poisson ratio", "bond_poisson_ratio", "bond Poisson's ratio", 1,
       "", "", true},
      {FreeParameter::tensile_strength, "Bond/Tensile strength", "bond_tensile_strength_pa",
       "tensile strength", 1e6, " MPa", " Pa", false},
      {FreeParameter::shear_strength, "Bond/Shear strength", "bond_shear_strength_pa", "shear strength", 1e6,
       " MPa", " Pa", false},
      {FreeParameter::moment_contribution, "Bond/Moment contribution", "moment_contribution",
       "moment contribution", 1, "", "", false},
      {FreeParameter::friction_angle, "Bond/Friction angle", "friction_angle_rad", "friction angle", degree,
       " degree", " rad", false},
      {FreeParameter::compression_limits, "Bond/Compression limits", "compression_limits_factor",
       "factor of compression limits", 1, "", "", false},
      {FreeParameter::contact_friction, "Contact/Friction", "contact_friction", "contact friction", 1, "", "",
       false}};
  for (const FreedEntry &freed : calibrate.freed) {
    const std::string unit = freed.unit == "1" ? "" : " " + freed.unit;
    std::string column = freed.path;
    std::replace_if(
        column.begin(), column.end(), [](char c) { return c == '/' || c == ' '; }, '_');
    all.push_back(
        {static_cast<FreeParameter>(all.size()), freed.path, column, freed.path, 1, unit, unit, false});
  }
  return all;
}

ParameterFacts facts_of(const Calibrate &calibrate, FreeParameter parameter) {
  return parameter_facts(calibrate)[static_cast<std::size_t>(parameter)];
}

Choice choice_of(const Scene &scene) {
  const Bond &b = scene.bond;
  const dem::BondLayout &layout = scene.model.bond_layout;
  Choice c;
  c[FreeParameter::modulus] = layout.modulus;
  c[FreeParameter::stiffness_ratio] = b.number("stiffness_ratio");
  c[FreeParameter::radius_multiplier] = layout.radius_multiplier;
  c[FreeParameter::poisson_ratio] = b.number("poisson_ratio");
  c[FreeParameter::tensile_strength] = b.number("tensile_strength");
  c[FreeParameter::shear_strength] = b.number("shear_strength");
  c[FreeParameter::moment_contribution] = b.number("moment_contribution");
  c[FreeParameter::friction_angle] = b.number("friction_angle");
  c[FreeParameter::compression_limits] = 1;
  c[FreeParameter::contact_friction] = scene.contact.friction;
  for (const FreedEntry &freed : calibrate_of(scene).freed)
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
    std::string text = shortest_text(value) + facts.si;
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
  return fmt::format("{} {:.4g}{}", facts.words, value / facts.unit, facts.unit_word);
}

} // namespace platen::apps
