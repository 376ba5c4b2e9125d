#include "apps/calibrate/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/scene/units.h"
#include "base/pi.h"

namespace platen::apps {

std::vector<KnobFacts> knob_facts(const Calibrate &calibrate) {
  constexpr double degree = pi / 180;
  std::vector<KnobFacts> all{
      {Knob::modulus, "Bond/Modulus", "bond_modulus_pa", "bond modulus", 1e9, " GPa", " Pa", true},
      {Knob::stiffness_ratio, "Bond/Stiffness ratio", "stiffness_ratio", "stiffness ratio", 1, "", "", true},
      {Knob::radius_multiplier, "Bond/Radius multiplier", "radius_multiplier", "radius multiplier", 1, "", "",
       true},
      {Knob::poisson_ratio, "Bond/Poisson ratio", "bond_poisson_ratio", "bond Poisson's ratio", 1, "", "",
       true},
      {Knob::tensile_strength, "Bond/Tensile strength", "bond_tensile_strength_pa", "tensile strength", 1e6,
       " MPa", " Pa", false},
      {Knob::shear_strength, "Bond/Shear strength", "bond_shear_strength_pa", "shear strength", 1e6, " MPa",
       " Pa", false},
      {Knob::moment_contribution, "Bond/Moment contribution", "moment_contribution", "moment contribution", 1,
       "", "", false},
      {Knob::friction_angle, "Bond/Friction angle", "friction_angle_rad", "friction angle", degree, " degree",
       " rad", false},
      {Knob::compression_limits, "Bond/Compression limits", "compression_limits_factor",
       "factor of compression limits", 1, "", "", false},
      {Knob::contact_friction, "Contact/Friction", "contact_friction", "contact friction", 1, "", "", false}};
  for (const FreedEntry &freed : calibrate.freed) {
    const std::string unit = freed.unit == "1" ? "" : " " + freed.unit;
    std::string column = freed.path;
    std::replace_if(
        column.begin(), column.end(), [](char c) { return c == '/' || c == ' '; }, '_');
    all.push_back({static_cast<Knob>(all.size()), freed.path, column, freed.path, 1, unit, unit, false});
  }
  return all;
}

KnobFacts facts_of(const Calibrate &calibrate, Knob knob) {
  return knob_facts(calibrate)[static_cast<std::size_t>(knob)];
}

Choice choice_of(const Scene &scene) {
  const Bond &b = scene.bond;
  const dem::BondLayout &layout = scene.model.bond_layout;
  Choice c;
  c[Knob::modulus] = layout.modulus;
  c[Knob::stiffness_ratio] = b.number("stiffness_ratio");
  c[Knob::radius_multiplier] = layout.radius_multiplier;
  c[Knob::poisson_ratio] = b.number("poisson_ratio");
  c[Knob::tensile_strength] = b.number("tensile_strength");
  c[Knob::shear_strength] = b.number("shear_strength");
  c[Knob::moment_contribution] = b.number("moment_contribution");
  c[Knob::friction_angle] = b.number("friction_angle");
  c[Knob::compression_limits] = 1;
  c[Knob::contact_friction] = scene.contact.friction;
  for (const FreedEntry &freed : calibrate_of(scene).freed)
    c.numbers.push_back(freed.own);
  return c;
}

std::vector<std::string> overrides_of(const Scene &scene, const Choice &c) {
  std::vector<std::string> overrides;
  const Choice own = choice_of(scene);
  for (const KnobFacts &facts : knob_facts(calibrate_of(scene))) {
    const double value = c[facts.knob];
    // What is unbreakable, or nobody has asked for, stays so.
    if (value == own[facts.knob] || std::isnan(value)) continue;
    std::string text = shortest_text(value) + facts.si;
    if (facts.knob == Knob::compression_limits) {
      text.clear();
      for (const double limit : scene.bond.list("compression_limits"))
        text += (text.empty() ? "" : ", ") + shortest_text(value * limit) + " Pa";
    }
    overrides.push_back(facts.entry + " = " + text);
  }
  return overrides;
}

std::string text_of(const KnobFacts &facts, double value) {
  return fmt::format("{} {:.4g}{}", facts.words, value / facts.unit, facts.unit_word);
}

} // namespace platen::apps
