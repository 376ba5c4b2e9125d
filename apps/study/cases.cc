#include "apps/study/cases.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "apps/programs.h"
#include "apps/run/needs.h"
#include "apps/run/shared_packing.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/values.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

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
    scene.parameters->refuse("Specimen/Packing",
                             "has one size: a study of it packs its own. Allowed: advancing front, "
                             "random close.");
  StudyPlan plan;
  plan.varied = {"sphere_radius_m", "height_m", "radius_m"};
  const bool nothing_given = study.sphere_radii.empty() && study.domains.empty();
  const std::vector<double> radii =
      nothing_given ? radii_in_proportion(s) : or_own(study.sphere_radii, s.sphere_radius);
  for (const double radius : radii)
    add(plan, {"sphere_radius_" + in_name(radius, "m"),
               {radius, s.height, s.radius},
               {set("Specimen/Sphere radius", radius, "m")}});
  for (const DomainSize &d : study.domains) {
    const bool own = d.height == s.height && d.radius == s.radius;
    const std::string name = "sphere_radius_" + in_name(s.sphere_radius, "m"),
                      size = "_height_" + in_name(d.height, "m") + "_radius_" + in_name(d.radius, "m");
    add(plan, {own ? name : name + size,
               {s.sphere_radius, d.height, d.radius},
               {set("Specimen/Sphere radius", s.sphere_radius, "m"), set("Specimen/Height", d.height, "m"),
                set("Specimen/Radius", d.radius, "m")}});
  }
  return plan;
}

StudyPlan plan_packing(const Scene &scene) {
  const Study &study = study_of(scene);
  const bool none = !scene.bond.bonded();
  const Parameters &p = *scene.parameters;
  if (study.gaps.empty() && study.radius_multipliers.empty() && study.radius_spreads.empty())
    p.refuse("Study/Gap list",
             "is not set, nor are Radius multiplier list and Radius spread list: nothing is varied. "
             "Allowed: at least one of them.");
  if (!study.gaps.empty() && (none || scene.bond.bonds_by_range()))
    p.refuse("Study/Gap list", "has no effect: Effects/Bond = " + p.at("Effects/Bond").text +
                                   ". Allowed: parallel bond, cohesive beam.");
  if (!study.radius_multipliers.empty() && none)
    p.refuse("Study/Radius multiplier list", "has no effect: Effects/Bond = none.");
  if (!study.radius_spreads.empty() && scene.specimen.packing == PackingKind::file)
    p.refuse("Study/Radius spread list", "has no effect: Specimen/Packing = file.");
  StudyPlan plan;
  plan.varied = {"gap_over_radius", "gap_m", "radius_multiplier", "radius_spread"};
  for (const double spread : or_own(study.radius_spreads, scene.specimen.radius_spread))
    for (const double multiplier :
         or_own(study.radius_multipliers, scene.model.bond_layout.radius_multiplier))
      for (const Gap &gap : or_own(study.gaps, scene.model.bond_layout.gap)) {
        StudyCase one;
        one.name = "gap_" + (gap.relative ? in_name(gap.value) : in_name(gap.value, "m")) + "_multiplier_" +
                   in_name(multiplier) + "_spread_" + in_name(spread);
        one.labels = {gap.relative ? gap.value : not_given, gap.relative ? not_given : gap.value, multiplier,
                      spread};
        // What is not varied stays as the scene says it, even where that has no effect.
        if (!study.gaps.empty()) one.overrides.push_back("Bond/Gap = " + text_of(gap));
        if (!study.radius_multipliers.empty())
          one.overrides.push_back(set("Bond/Radius multiplier", multiplier, ""));
        if (!study.radius_spreads.empty()) one.overrides.push_back(set("Specimen/Radius spread", spread, ""));
        add(plan, one);
      }
  return plan;
}

StudyPlan plan_rate(const Scene &scene) {
  if (study_of(scene).axial_rates.empty())
    scene.parameters->refuse("Study/Axial rate list",
                             "is not set: nothing is varied. Allowed: speeds with commas between them.");
  if (scene.loading.hydrostatic() || scene.loading.servo)
    scene.parameters->refuse("Study/Axial rate list", "needs platens that are driven by motion.");
  StudyPlan plan;
  plan.varied = {"axial_rate_m_s"};
  for (const double rate : study_of(scene).axial_rates)
    add(plan, {"rate_" + in_name(rate), {rate}, {set("Loading/Axial rate", rate, "m/s")}});
  return plan;
}

// "friction_static", "confining_pressure_pa": the key, with its SI unit.
std::string column_of(const std::string &path, const std::string &unit) {
  return as_name(path.substr(path.rfind('/') + 1)) + (unit.empty() || unit == "1" ? "" : "_" + as_name(unit));
}

double number_of(const std::string &text, const std::string &unit) {
  try {
    return to_si(text, unit);
  } catch (const ValueError &) { // a word
    return not_given;
  }
}

StudyPlan plan_vary(const Scene &scene) {
  StudyPlan plan;
  plan.cases = {StudyCase{}};
  for (const Varied &one : study_of(scene).vary) {
    if (one.path.empty()) continue;
    const std::string &unit = scene.parameters->at(one.path).unit;
    plan.varied.push_back(column_of(one.path, unit));
    std::vector<StudyCase> all;
    for (const StudyCase &before : plan.cases)
      for (const std::string &value : one.values) {
        all.push_back(before);
        const std::string name = as_name(one.path.substr(one.path.rfind('/') + 1) + " " + value);
        all.back().name += (before.name.empty() ? "" : "_") + name;
        if (one.path != "Loading/Confining pressure")
          all.back().envelope += (before.envelope.empty() ? "" : "_") + name;
        all.back().labels.push_back(number_of(value, unit));
        all.back().words.push_back(std::isnan(all.back().labels.back()) ? value : "");
        all.back().overrides.push_back(one.path + " = " + value);
      }
    plan.cases = std::move(all);
  }
  if (plan.varied.empty())
    scene.parameters->refuse("Study/Vary 1",
                             "is not set: nothing is varied. Allowed: \"Section/Key: value, value\".");
  return plan;
}

using Plan = StudyPlan (*)(const Scene &);

// As StudyKind; a target, the last, asks for more.
constexpr std::array<Plan, study_words.size() - 1> plans{
    plan_friction, plan_slenderness, plan_size, plan_packing, plan_rate, plan_accuracy, plan_vary};

} // namespace

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
    scene.parameters->refuse("Loading/Stop at residual",
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
  StudyPlan plan = kind == StudyKind::target ? plan_target(scene, overrides)
                                             : plans[static_cast<std::size_t>(kind)](scene);
  plan.kind = kind;
  const int seeds = kind == StudyKind::target ? study_of(scene).target.pilot_seeds : study_of(scene).seeds;
  for (int k = 0; k < seeds; ++k)
    plan.seeds.push_back(scene.general.seed + static_cast<unsigned long>(k));
  for (StudyCase &one : plan.cases) {
    const Scene led_to = scene_of(one, kind, scene, plan.seeds.back(), overrides);
    if (of_platens(kind)) label_platens(one, led_to);
    const double seconds = counted_costs(led_to).seconds;
    one.seconds = std::isfinite(seconds) ? seconds : 0;
    if (kind == StudyKind::accuracy) label_parameters(one, led_to);
    for (const unsigned long seed : plan.seeds) {
      const std::string recipe = packing_recipe(led_to, seed);
      one.packings.push_back(recipe.empty() ? "" : packing_name(recipe));
    }
  }
  return plan;
}

} // namespace platen::apps
