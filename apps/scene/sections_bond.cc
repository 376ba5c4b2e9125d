// What holds grains together, and the phases that tell bonds apart.
#include "apps/scene/sections.h"

namespace platen::apps {
namespace {

// Of Effects/Bond = elasto damage plastic alone.
void declare_interface(Section &section, Bond &bond) {
  section.number("Interaction range", bond.interaction_range, between(0, 1),
                 "Pairs whose distance differs from the sum of their radii by at most this share of it are "
                 "bonded (elasto damage plastic, instead of Gap).");
  section.number(
      "Area factor", bond.area_factor, between(0, 10),
      "Alpha, on the area of the bond; 0: 40 times porosity over mean number of bonds of a sphere.");
  section.number("Friction static", bond.friction_static, between(0, 5),
                 "Shear strength grows by this times the compression, while the bond holds (mu_1).");
  section.number("Friction dynamic", bond.friction_dynamic, between(0, 5),
                 "Coefficient of friction of a bond that has failed (mu_2).");
  section.number("Softening tension", bond.softening_tension, {1e-3, 1000, true, true},
                 "Opening from the strength to nothing, over that at the strength (delta_n).");
  section.number("Softening shear", bond.softening_shear, {1e-3, 1000, true, true},
                 "The same in shear (delta_s).");
  section.quantity("Fracture energy tension", bond.fracture_energy_tension, "J/m2", at_least(0),
                   "Area under the softening branch, for any size of spheres; 0: by Softening tension.");
  section.quantity("Fracture energy shear", bond.fracture_energy_shear, "J/m2", at_least(0),
                   "The same in shear.");
  section.list("Compression limits", bond.compression_limits, "Pa", above(0),
               "Up to three stresses, ascending, where the branches of compression begin (LCS); empty: "
               "elastic without limit.");
  section.list("Compression slopes", bond.compression_slopes, "1", at_least(1),
               "Modulus over that of each branch, not descending (YRC); as many as limits.");
  section.word<FailureLine>(
      "Failure line", bond.failure_line,
      {{"uncoupled", FailureLine::uncoupled}, {"coupled", FailureLine::coupled}},
      "Coupled: tension takes from the shear strength, and shear from the tensile strength.");
}

} // namespace

void declare_bond(Parameters &parameters, Bond &bond) {
  Section section(parameters, "Bond");
  section.quantity("Modulus", bond.modulus, "Pa", above(0), "Young modulus of the bond.");
  section.number("Stiffness ratio", bond.stiffness_ratio, between(0, 5),
                 "Shear over normal stiffness, k_s / k_n (parallel bond).");
  section.number(
      "Poisson ratio", bond.poisson_ratio, between_open(-1, 0.5),
      "Of the bond: its shear modulus is Modulus / (2 (1 + nu)) (cohesive beam, elasto damage plastic).");
  section.quantity("Tensile strength", bond.tensile_strength, "Pa", at_least(0),
                   "0: never breaks in tension.");
  section.quantity("Shear strength", bond.shear_strength, "Pa", at_least(0),
                   "Cohesion of the bond; 0: never breaks in shear.");
  section.quantity("Friction angle", bond.friction_angle, "rad", {0, right_angle, true, false},
                   "Shear strength grows by its tangent times the compression of the bond.");
  section.number("Moment contribution", bond.moment_contribution, between(0, 1),
                 "Share of bending and twisting moment that counts towards failure.");
  section.number("Radius multiplier", bond.radius_multiplier, above_up_to(0, 10),
                 "Bond radius over the radius that the rule gives.");
  section.word<RadiusRule>("Radius rule", bond.radius_rule,
                           {{"minimum", RadiusRule::minimum},
                            {"mean", RadiusRule::mean},
                            {"harmonic", RadiusRule::harmonic},
                            {"given", RadiusRule::given}},
                           "Bond radius from the radii of the pair; given: from Radius.");
  section.quantity("Radius", bond.radius, "m", above(0), "Bond radius (Radius rule = given).");
  section.gap(
      "Gap", bond.gap,
      "Pairs with at most this distance between their surfaces are bonded; R_min is the smaller radius.");
  section.number("Damping", bond.damping, between(0, 1),
                 "Dashpot of the bond, fraction of critical damping.");
  section.word<StrengthScatter>("Strength scatter", bond.strength_scatter,
                                {{"none", StrengthScatter::none}, {"weibull", StrengthScatter::weibull}},
                                "Weibull: a random factor of mean 1 multiplies both strengths of each bond.");
  section.number("Weibull modulus", bond.weibull_modulus, between(0.5, 1000),
                 "Of the factors (Strength scatter = weibull): the larger, the less scatter.");
  declare_interface(section, bond);
}

void declare_phases(Parameters &parameters, PhasesSection &phases) {
  Section section(parameters, "Phases");
  section.word<PhasesBy>("By", phases.by,
                         {{"none", PhasesBy::none}, {"radius", PhasesBy::radius}, {"file", PhasesBy::file}},
                         "What tells the spheres of the aggregate from those of the matrix.");
  section.quantity("Radius above", phases.radius_above, "m", above(0),
                   "Larger spheres are aggregate (By = radius).");
  section.file("File", phases.file, "Ids of the spheres that are aggregate, one a line (By = file).");
  const auto factor = [&](const char *key, double &value, const char *meaning) {
    section.number(key, value, {0, 1e3, false, true}, meaning);
  };
  factor("Aggregate modulus factor", phases.aggregate_modulus,
         "Modulus of bonds between two spheres of the aggregate, over Bond/Modulus.");
  factor("Aggregate strength factor", phases.aggregate_strength,
         "Both strengths of bonds between two spheres of the aggregate, over those of Bond.");
  factor("Interface modulus factor", phases.interface_modulus,
         "Modulus of bonds between a sphere of the aggregate and one of the matrix, over Bond/Modulus.");
  factor("Interface strength factor", phases.interface_strength,
         "Both strengths of bonds between aggregate and matrix, over those of Bond.");
}

} // namespace platen::apps
