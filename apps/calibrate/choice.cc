#include "apps/calibrate/choice.h"

#include <fmt/format.h>

#include "apps/calibrate/calibrate_section.h"
#include "apps/scene/units.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

std::vector<double> scaled_limits(const Scene &scene, double factor) {
  std::vector<double> limits = scene.bond.list("compression_limits");
  for (double &limit : limits)
    limit *= factor;
  return limits;
}

} // namespace

const std::array<KnobFacts, knob_count> &knob_facts() {
  constexpr double degree = pi / 180;
  static const std::array<KnobFacts, knob_count> all{
      {{Knob::modulus, "bond_modulus_pa", "bond modulus", 1e9, " GPa", true},
       {Knob::stiffness_ratio, "stiffness_ratio", "stiffness ratio", 1, "", true},
       {Knob::radius_multiplier, "radius_multiplier", "radius multiplier", 1, "", true},
       {Knob::poisson_ratio, "bond_poisson_ratio", "bond Poisson's ratio", 1, "", true},
       {Knob::tensile_strength, "bond_tensile_strength_pa", "tensile strength", 1e6, " MPa", false},
       {Knob::shear_strength, "bond_shear_strength_pa", "shear strength", 1e6, " MPa", false},
       {Knob::moment_contribution, "moment_contribution", "moment contribution", 1, "", false},
       {Knob::friction_angle, "friction_angle_rad", "friction angle", degree, " degree", false},
       {Knob::compression_limits, "compression_limits_factor", "factor of compression limits", 1, "", false},
       {Knob::contact_friction, "contact_friction", "contact friction", 1, "", false}}};
  return all;
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
  return c;
}

Scene chosen(const Scene &scene, const Choice &c) {
  Scene s = scene;
  s.model.bond_layout.modulus = c[Knob::modulus];
  s.model.bond_layout.radius_multiplier = c[Knob::radius_multiplier];
  s.bond.set("stiffness_ratio", c[Knob::stiffness_ratio]);
  s.bond.set("poisson_ratio", c[Knob::poisson_ratio]);
  s.bond.set("tensile_strength", c[Knob::tensile_strength]);
  s.bond.set("shear_strength", c[Knob::shear_strength]);
  s.bond.set("moment_contribution", c[Knob::moment_contribution]);
  s.bond.set("friction_angle", c[Knob::friction_angle]);
  if (c[Knob::compression_limits] != 1)
    s.bond.set("compression_limits", scaled_limits(scene, c[Knob::compression_limits]));
  s.contact.friction = c[Knob::contact_friction];
  s.model.energy_ledger = s.model.crack_log = false;
  return s;
}

std::vector<std::string> overrides_of(const Scene &scene, const Choice &c) {
  std::vector<std::string> overrides;
  const Choice own = choice_of(scene);
  const auto add = [&](const char *entry, Knob knob, const char *unit, bool always = true) {
    if (always || c[knob] != own[knob])
      overrides.push_back(fmt::format("{} = {}{}", entry, shortest_text(c[knob]), unit));
  };
  add("Bond/Modulus", Knob::modulus, " Pa");
  add("Bond/Stiffness ratio", Knob::stiffness_ratio, "");
  add("Bond/Radius multiplier", Knob::radius_multiplier, "");
  // What is unbreakable, or nobody has asked for, stays so.
  add("Bond/Tensile strength", Knob::tensile_strength, " Pa", c[Knob::tensile_strength] > 0);
  add("Bond/Shear strength", Knob::shear_strength, " Pa", c[Knob::shear_strength] > 0);
  add("Bond/Moment contribution", Knob::moment_contribution, "");
  add("Bond/Friction angle", Knob::friction_angle, " rad", false);
  add("Contact/Friction", Knob::contact_friction, "", false);
  if (c[Knob::compression_limits] == 1) return overrides;
  std::string limits;
  for (const double limit : scaled_limits(scene, c[Knob::compression_limits]))
    limits += (limits.empty() ? "" : ", ") + shortest_text(limit) + " Pa";
  overrides.push_back("Bond/Compression limits = " + limits);
  return overrides;
}

std::string text_of(Knob knob, double value) {
  const KnobFacts &facts = facts_of(knob);
  return fmt::format("{} {:.4g}{}", facts.words, value / facts.unit, facts.unit_word);
}

} // namespace platen::apps
