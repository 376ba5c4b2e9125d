#include "apps/study/cases.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "apps/programs.h"
#include "apps/run/shared_packing.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/values.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

StudyCase of_radius(double radius) {
  return {"sphere_radius_" + in_name(radius, "m"), {set("Specimen/Sphere radius", radius, "m")}};
}

// Table 14 of Tannu 2017: spheres of 0.5 to 1.25 mm in a cylinder of the radius 25 mm, in proportion for
// another specimen.
std::vector<double> radii_in_proportion(const SpecimenSection &s) { // m
  const double half = s.shape == SpecimenShape::box ? 0.5 * std::min(s.width_x, s.width_y) : s.radius;
  std::vector<double> radii;
  for (const double share : {0.02, 0.03, 0.04, 0.05})
    radii.push_back(to_twelve_digits(share * half));
  return radii;
}

StudyPlan plan_size(const Scene &scene) {
  const SpecimenSection &s = scene.specimen;
  const Study &study = study_of(scene);
  if (s.packing == PackingKind::file)
    refuse(scene, "Specimen/Packing",
           "has one size: a study of it packs its own. Allowed: advancing front, "
           "random close.");
  const bool nothing_given = study.sphere_radii.empty() && study.domains.empty();
  const std::vector<double> radii =
      nothing_given ? radii_in_proportion(s) : or_own(study.sphere_radii, s.sphere_radius);
  StudyPlan plan{StudyKind::size, {"sphere_radius_m", "height_m", "radius_m"}, {}};
  for (const double radius : radii)
    add(plan, of_radius(radius));
  for (const DomainSize &d : study.domains) {
    StudyCase one = of_radius(s.sphere_radius);
    if (d.height != s.height || d.radius != s.radius)
      one.name += "_height_" + in_name(d.height, "m") + "_radius_" + in_name(d.radius, "m");
    one.overrides.push_back(set("Specimen/Height", d.height, "m"));
    one.overrides.push_back(set("Specimen/Radius", d.radius, "m"));
    add(plan, one);
  }
  return plan;
}

StudyPlan plan_packing(const Scene &scene) {
  const Study &study = study_of(scene);
  const bool none = !scene.bond.bonded();
  if (study.gaps.empty() && study.radius_multipliers.empty() && study.radius_spreads.empty())
    refuse(scene, "Study/Gap list",
           "is not set, nor are Radius multiplier list and Radius spread list: nothing is varied. "
           "Allowed: at least one of them.");
  if (!study.gaps.empty() && (none || scene.bond.bonds_by_range()))
    refuse(scene, "Study/Gap list",
           "has no effect: Effects/Bond = " + scene.parameters->at("Effects/Bond").text +
               ". Allowed: parallel bond, cohesive beam.");
  if (!study.radius_multipliers.empty() && none)
    refuse(scene, "Study/Radius multiplier list", "has no effect: Effects/Bond = none.");
  if (!study.radius_spreads.empty() && scene.specimen.packing == PackingKind::file)
    refuse(scene, "Study/Radius spread list", "has no effect: Specimen/Packing = file.");
  // What is not varied stays as the scene says it, even where that has no effect.
  const auto named = [](const std::string &name, bool varied, const std::string &entry) {
    return StudyCase{name, varied ? std::vector{entry} : std::vector<std::string>{}};
  };
  const dem::BondLayout &layout = scene.model.bond_layout;
  const auto gaps = cases_of(or_own(study.gaps, layout.gap), [&](const Gap &gap) {
    return named("gap_" + (gap.relative ? in_name(gap.value) : in_name(gap.value, "m")), !study.gaps.empty(),
                 "Bond/Gap = " + text_of(gap));
  });
  const auto multipliers =
      cases_of(or_own(study.radius_multipliers, layout.radius_multiplier), [&](double multiplier) {
        return named("multiplier_" + in_name(multiplier), !study.radius_multipliers.empty(),
                     set("Bond/Radius multiplier", multiplier, ""));
      });
  const auto spreads =
      cases_of(or_own(study.radius_spreads, scene.specimen.radius_spread), [&](double spread) {
        return named("spread_" + in_name(spread), !study.radius_spreads.empty(),
                     set("Specimen/Radius spread", spread, ""));
      });
  return {StudyKind::packing,
          {"gap_over_radius", "gap_m", "radius_multiplier", "radius_spread"},
          times(times(gaps, multipliers), spreads)};
}

StudyPlan plan_rate(const Scene &scene) {
  const std::vector<double> &rates = study_of(scene).axial_rates;
  if (rates.empty())
    refuse(scene, "Study/Axial rate list",
           "is not set: nothing is varied. Allowed: speeds with commas between them.");
  if (scene.loading.hydrostatic() || scene.loading.servo)
    refuse(scene, "Study/Axial rate list", "needs platens that are driven by motion.");
  return {StudyKind::rate, {"axial_rate_m_s"}, cases_of(rates, [](double rate) {
            return StudyCase{"rate_" + in_name(rate), {set("Loading/Axial rate", rate, "m/s")}};
          })};
}

// "friction_static", "confining_pressure_pa": the key, with its SI unit.
std::string column_of(const std::string &path, const std::string &unit) {
  return as_name(last_name(path)) + (unit.empty() || unit == "1" ? "" : "_" + as_name(unit));
}

double number_of(const std::string &text, const std::string &unit) {
  try {
    return to_si(text, unit);
  } catch (const ValueError &) { // a word
    return not_given;
  }
}

StudyPlan plan_vary(const Scene &scene) {
  StudyPlan plan{StudyKind::vary, {}, {StudyCase{}}};
  const auto case_of = [&](const std::string &path, const std::string &value) {
    const std::string name = as_name(last_name(path) + " " + value);
    const double number = number_of(value, scene.parameters->at(path).unit);
    StudyCase with{name, {path + " = " + value}, {number}, {std::isnan(number) ? value : ""}};
    if (path != "Loading/Confining pressure") with.envelope = name;
    return with;
  };
  for (const Varied &one : study_of(scene).vary) {
    if (one.paths.empty()) continue;
    for (const std::string &path : one.paths)
      plan.varied.push_back(column_of(path, scene.parameters->at(path).unit));
    std::vector<StudyCase> all;
    for (const StudyCase &before : plan.cases)
      for (const std::vector<std::string> &values : one.values) {
        all.push_back(before);
        for (std::size_t k = 0; k < values.size(); ++k)
          all.back() = joined(std::move(all.back()), case_of(one.paths[k], values[k]));
      }
    plan.cases = std::move(all);
  }
  if (plan.varied.empty())
    refuse(scene, "Study/Vary 1", "is not set: nothing is varied. Allowed: \"Section/Key: value, value\".");
  return plan;
}

using Plan = StudyPlan (*)(const Scene &);

// As StudyKind; a target, the last, asks for more.
constexpr std::array<Plan, study_words.size() - 1> plans{
    plan_friction, plan_slenderness, plan_size, plan_packing, plan_rate, plan_accuracy, plan_vary};

double slenderness(const Scene &s) {
  return to_twelve_digits(s.specimen.height / s.specimen.width());
}

const CaseColumn columns[] = {
    {"friction_static",
     [](const Scene &s) { return common_friction(s) ? common_friction(s)->friction_static : not_given; },
     "friction"},
    {"friction_dynamic",
     [](const Scene &s) { return common_friction(s) ? common_friction(s)->friction_dynamic : not_given; }},
    {"slenderness", slenderness, "height/width"},
    {"confining_pressure_pa",
     [](const Scene &s) { return s.loading.confined() ? s.loading.cell->pressure : 0.0; }, "cell, MPa", 1e6},
    {"sphere_radius_m", [](const Scene &s) { return s.specimen.sphere_radius; }, "sphere, mm", 1e-3},
    {"height_m", [](const Scene &s) { return s.specimen.height; }, "height, mm", 1e-3},
    {"radius_m", [](const Scene &s) { return s.specimen.radius; }, "radius, mm", 1e-3},
    {"gap_over_radius",
     [](const Scene &s) {
       const Gap &gap = s.model.bond_layout.gap;
       return gap.relative ? gap.value : not_given;
     },
     "gap/R"},
    {"gap_m",
     [](const Scene &s) {
       const Gap &gap = s.model.bond_layout.gap;
       return gap.relative ? not_given : gap.value;
     },
     "gap, mm", 1e-3},
    {"radius_multiplier", [](const Scene &s) { return s.model.bond_layout.radius_multiplier; }, "multiplier"},
    {"radius_spread", [](const Scene &s) { return s.specimen.radius_spread; }, "spread"},
    {"axial_rate_m_s", [](const Scene &s) { return s.loading.rate; }, "rate, m/s"},
    {"safety", [](const Scene &s) { return s.time_step.safety; }},
    {"wave_crossings", [](const Scene &s) { return s.loading.wave_transits; }},
    {"hurry", [](const Scene &s) { return s.loading.rate_multiplier; }},
    {"mass_scaling", [](const Scene &s) { return s.model.mass_scaling; }},
    {"elements_across", [](const Scene &s) { return static_cast<double>(s.platens.elements_across); }},
    {"steps_per_solve",
     [](const Scene &s) { return static_cast<double>(s.platens.elastic->steps_per_solve); }},
    {"sleeve_elements_around",
     [](const Scene &s) { return static_cast<double>(s.loading.cell->sleeve->elements_around); }},
    {"sleeve_mass_scaling", [](const Scene &s) { return s.loading.cell->sleeve->mass_scaling; }}};

void set_labels(const StudyPlan &plan, const Scene &led_to, StudyCase &of) {
  if (of_platens(plan.kind)) of.surface = surface_of(led_to);
  for (const std::string &column : plan.varied)
    of.labels.push_back(plan.kind != StudyKind::accuracy || decides(column, led_to)
                            ? case_column(column)->of(led_to)
                            : not_given);
}

} // namespace

const CaseColumn *case_column(const std::string &name) {
  const auto *const found = std::find_if(std::begin(columns), std::end(columns),
                                         [&](const CaseColumn &one) { return one.name == name; });
  return found == std::end(columns) ? nullptr : found;
}

std::size_t StudyPlan::place_of(const std::string &column) const {
  return static_cast<std::size_t>(std::find(varied.begin(), varied.end(), column) - varied.begin());
}

const char *word(StudyKind kind) {
  return study_words[static_cast<std::size_t>(kind)];
}

StudyKind study_kind(const std::string &word) {
  return static_cast<StudyKind>(read_word(word, {study_words.begin(), study_words.end()}));
}

std::string as_name(const std::string &words) {
  std::string name;
  for (const char c : words)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-')
      name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!name.empty() && name.back() != '_')
      name += '_';
  return name;
}

StudyCase joined(StudyCase a, const StudyCase &b) {
  const auto append = [](auto &to, const auto &from) { to.insert(to.end(), from.begin(), from.end()); };
  const auto append_name = [](std::string &to, const std::string &from) {
    to += (to.empty() || from.empty() ? "" : "_") + from;
  };
  append_name(a.name, b.name);
  append_name(a.envelope, b.envelope);
  append(a.overrides, b.overrides);
  append(a.labels, b.labels);
  append(a.words, b.words);
  return a;
}

std::vector<StudyCase> times(const std::vector<StudyCase> &first, const std::vector<StudyCase> &second) {
  std::vector<StudyCase> all;
  for (const StudyCase &slow : second)
    for (const StudyCase &fast : first)
      all.push_back(joined(fast, slow));
  return all;
}

std::size_t add(StudyPlan &plan, StudyCase one) {
  const auto found = std::find_if(plan.cases.begin(), plan.cases.end(),
                                  [&](const StudyCase &other) { return other.name == one.name; });
  const auto place = static_cast<std::size_t>(found - plan.cases.begin());
  if (found == plan.cases.end()) plan.cases.push_back(std::move(one));
  return place;
}

void require_fall(const Scene &scene) {
  constexpr double peak_fall = 0.8; // of the peak: where damage is measured (middle_damage)
  if (scene.loading.stop_at_residual >= peak_fall)
    refuse(scene, "Loading/Stop at residual",
           "ends a run before it is known to have peaked. Allowed: below 0.8.");
}

std::vector<std::string> overrides_of(const StudyCase &of, unsigned long seed,
                                      const std::vector<std::string> &overrides) {
  std::vector<std::string> all = overrides;
  all.insert(all.end(), of.overrides.begin(), of.overrides.end());
  all.push_back("Scene/Seed = " + std::to_string(seed));
  return all;
}

Scene scene_of(const StudyCase &of, StudyKind kind, const Scene &scene, unsigned long seed,
               const std::vector<std::string> &overrides) {
  try {
    return read_scene(of.scene.empty() ? scene.path : of.scene, overrides_of(of, seed, overrides),
                      program("compress"));
  } catch (const InputError &error) {
    throw InputError(scene.path + ": error: the study of " + word(kind) + " leads to " + of.name +
                     ", which cannot be run:\n" + error.what());
  }
}

StudyPlan plan_study(StudyKind kind, const Scene &scene, const std::vector<std::string> &overrides) {
  const bool target = kind == StudyKind::target;
  StudyPlan plan = target ? plan_target(scene, overrides) : plans[static_cast<std::size_t>(kind)](scene);
  plan.kind = kind;
  const int seeds = target ? study_of(scene).target.pilot_seeds : study_of(scene).seeds;
  for (int k = 0; k < seeds; ++k)
    plan.seeds.push_back(scene.general.seed + static_cast<unsigned long>(k));
  for (StudyCase &one : plan.cases) {
    const Scene led_to = scene_of(one, kind, scene, plan.seeds.back(), overrides);
    if (kind != StudyKind::vary) set_labels(plan, led_to, one);
    one.costs = counted_costs(led_to);
    for (const unsigned long seed : plan.seeds) {
      const std::string recipe = packing_recipe(led_to, seed);
      one.packings.push_back(recipe.empty() ? "" : packing_name(recipe));
    }
  }
  return plan;
}

} // namespace platen::apps
