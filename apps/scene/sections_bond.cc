// What holds grains together, and the phases by which bonds differ. Keys stand in the order of scenes as they
// are written.
#include <algorithm>

#include "apps/scene/members.h"
#include "apps/scene/sections.h"

namespace platen::apps {
namespace {

// Bonds that never break are meant, not forgotten.
std::string needed_by_bonds(const Situation &s, const char *path) {
  const bool needed = s.scene.bond.bonded() && s.program.bonds && !s.given_by_program(path);
  return needed ? std::string("Effects/Bond is ") + s.scene.bond.word() + "." : "";
}

// "elastic, tension": words of calibrated_figures, each once; "" is none.
std::vector<CalibratedFigure> read_calibrated_figures(const std::string &text) {
  std::vector<std::string> words;
  for (const auto &one : calibrated_figures)
    words.push_back(one.first);
  std::vector<CalibratedFigure> so_far;
  return read_items<CalibratedFigure>(text, [&](const std::string &item) {
    const CalibratedFigure figure = calibrated_figures[read_word(item, words)].second;
    if (std::find(so_far.begin(), so_far.end(), figure) != so_far.end())
      throw ValueError("stands there twice");
    so_far.push_back(figure);
    return figure;
  });
}

void declare_calibrated(Section &section, CalibratedFor &calibrated) {
  section.entry<std::optional<PackingKind>>(
      "Calibrated packing", calibrated.packing,
      {{"any", std::nullopt},
       {"advancing front", PackingKind::advancing_front},
       {"random close", PackingKind::random_close}},
      "Specimen/Packing that the bonds are calibrated for; with another the same bonds are another material, "
      "which is refused. Any: nothing is said.");
  std::vector<std::string> words;
  for (const auto &one : calibrated_figures)
    words.push_back(one.first);
  section.value(
      "Calibrated figures", calibrated.figures, "", "with commas between them, any of " + joined(words),
      read_calibrated_figures,
      "What the bonds are calibrated on: strengths, damage and moduli of other tests are null in "
      "summary.json, with this reason; without friction or slenderness so are the ratios of studies "
      "that need it, without secant ratio Poisson's ratio. Empty: nothing is said.");
}

} // namespace

void declare_bond(Parameters &parameters, Bond &bond, dem::ModelSettings &model) {
  Section section(parameters, "Bond");
  Members layout(section, model.bond_layout);
  LawMembers law(section, bond.laws);
  layout("modulus").needed_if([](const Situation &s) { return needed_by_bonds(s, "Bond/Modulus"); });
  for (const char *member : {"stiffness_ratio", "poisson_ratio"})
    law(member);
  law("tensile_strength").documented("Stress at which it breaks in tension.");
  law("shear_strength").documented("Its cohesion: shear stress at which it breaks without compression.");
  for (const char *key : {"Tensile strength", "Shear strength"})
    section.at(key)
        .needed_if([](const Situation &s) { return needed_by_bonds(s, "Bond/Tensile strength"); })
        .or_word("unbreakable", between(1e-3, 1e12));
  for (const char *member : {"friction_angle", "moment_contribution"})
    law(member);
  section.at("Friction angle")
      .only_if([](const Scene &s) { return s.bond.number("shear_strength") > 0; },
               "Bond/Shear strength = unbreakable");
  section.at("Moment contribution")
      .only_if(
          [](const Scene &s) {
            return !s.bond.is<dem::ElastoDamagePlastic>() ||
                   std::get<dem::ElastoDamagePlastic::Parameters>(s.bond.laws).moments;
          },
          "Effects/Interface moments is off");
  layout("radius_multiplier");
  layout("radius_rule");
  layout("radius").only_if("Bond/Radius rule", {"given"}).needed_if("Bond/Radius rule", {"given"});
  const auto by_range = dem::BondLaws::words_where([](auto *of) { return of->bonds_by_range; });
  layout("gap").unless("Effects/Bond", by_range);
  Members(section, model)("bond_dashpot", "Damping");
  section
      .entry<bool>("Strength scatter", bond.scattered, {{"none", false}, {"weibull", true}},
                   "Weibull: a random factor of mean 1 multiplies both strengths of each bond.")
      .only_if(
          [](const Scene &s) {
            return s.bond.number("tensile_strength") > 0 || s.bond.number("shear_strength") > 0;
          },
          "both strengths are unbreakable");
  Members(section, bond.scatter)("weibull_modulus")
      .only_if("Bond/Strength scatter", {"weibull"})
      .needed_if("Bond/Strength scatter", {"weibull"});
  Members size(section, bond.size);
  size("calibrated_radius");
  Members(
      section.only_if([](const Scene &s) { return s.bond.size.reference > 0; }, "Bond/Calibrated radius = 0"),
      bond.size)
      .rest();
  declare_calibrated(section, bond.calibrated);
  layout("interaction_range").only_if("Effects/Bond", by_range).remark(joined(by_range));
  layout("area_factor");
  layout.rest();
  law.rest();
  section.at("Fracture energy")
      .needed_if([](const Situation &s) {
        return s.scene.bond.is<dem::FacetBond>() ? needed_by_bonds(s, "Bond/Fracture energy") : "";
      })
      .or_word("brittle", between(1e-9, 1e9));
  section.at("Softening tension")
      .only_if([](const Scene &s) { return !(s.bond.number("fracture_energy_tension") > 0); },
               "Bond/Fracture energy tension takes its place");
  section.at("Softening shear")
      .only_if([](const Scene &s) { return !(s.bond.number("fracture_energy_shear") > 0); },
               "Bond/Fracture energy shear takes its place");
}

void declare_phases(Parameters &parameters, PhasesSection &phases) {
  Section section(parameters, "Phases");
  section.entry<PhasesBy>("By", phases.by,
                          {{"none", PhasesBy::none}, {"radius", PhasesBy::radius}, {"file", PhasesBy::file}},
                          "What tells the spheres of the aggregate from those of the matrix.");
  Members(section, phases.phases)("radius_above")
      .only_if("Phases/By", {"radius"})
      .needed_if("Phases/By", {"radius"});
  section.file("File", phases.file, "Ids of the spheres that are aggregate, one a line.")
      .only_if("Phases/By", {"file"});
  Members(section.unless("Phases/By", {"none"}), phases.phases).rest();
}

} // namespace platen::apps
