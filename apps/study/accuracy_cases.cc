// Cases of the study of accuracy.
#include <algorithm>
#include <cmath>
#include <functional>

#include "apps/scene/parameters.h"
#include "apps/scene/values.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

const StudyCase base{"base"};

enum class Finer { smaller, larger };

// An entry that is a number, and the list that varies it.
struct NumberParameter {
  const char *name, *entry, *list, *unit, *column; // column: of study.csv
  Finer finer;
  std::vector<double> Study::*values;
  const char *(*refused)(const Scene &); // why the scene leaves nothing to vary; "" where it does
};

const char *needs_motion(const Scene &s) {
  return s.loading.servo ? "needs platens that are driven by motion." : "";
}

const char *needs_sleeve(const Scene &s) {
  return s.loading.sleeved() ? "" : "needs Loading/Confinement = sleeve.";
}

const char *needs_plates(const Scene &s) {
  if (!s.platens.deformable) return "needs Platens/Kind = deformable.";
  return s.platens.any_of([&](coupling::Side side) { return s.platens.face(side).mesh_file.empty(); })
             ? ""
             : "has no effect: all platens have a Mesh file.";
}

const NumberParameter number_parameters[] = {
    {"safety", "Integration/Safety", "Study/Safety list", "", "safety", Finer::smaller, &Study::safeties,
     [](const Scene &s) {
       return s.time_step.fixed_step > 0
                  ? "has no effect: Integration/Time step is set. Allowed: Time step = 0."
                  : "";
     }},
    {"axial rate", "Loading/Axial rate", "Study/Axial rate list", "m/s", "axial_rate_m_s", Finer::smaller,
     &Study::axial_rates, needs_motion},
    {"wave crossings", "Loading/Wave crossings", "Study/Wave crossings list", "", "wave_crossings",
     Finer::larger, &Study::wave_transits,
     [](const Scene &s) {
       return std::isnan(s.loading.rate) ? "" : "has no effect: Loading/Axial rate is set.";
     }},
    {"hurry", "Loading/Hurry", "Study/Hurry list", "", "hurry", Finer::smaller, &Study::rate_multipliers,
     needs_motion},
    // Heavier specimens carry slower waves, for which the platens would wait.
    {"mass scaling", "Integration/Mass scaling", "Study/Mass scaling list", "", "mass_scaling",
     Finer::smaller, &Study::mass_scalings,
     [](const Scene &s) {
       return std::isnan(s.loading.rate)
                  ? "gains nothing where Loading/Wave crossings sets the speed. Allowed: an Axial rate."
                  : "";
     }},
    {"sphere radius", "Specimen/Sphere radius", "Study/Sphere radius list", "m", "sphere_radius_m",
     Finer::smaller, &Study::sphere_radii,
     [](const Scene &s) {
       return s.specimen.packing == PackingKind::file
                  ? "has no effect: Specimen/Packing = file. Allowed: advancing front, random close."
                  : "";
     }},
    {"platen mesh", "Platens/Elements across", "Study/Platen mesh list", "", "elements_across", Finer::larger,
     &Study::platen_elements, needs_plates},
    {"steps per solve", "Platens/Steps per solve", "Study/Steps per solve list", "", "steps_per_solve",
     Finer::smaller, &Study::steps_per_solve,
     [](const Scene &s) {
       return s.platens.deformable && s.platens.elastic->motion == fem::ElasticMotion::quasi_static
                  ? ""
                  : "needs Platens/Kind = deformable and Motion = quasi-static.";
     }},
    {"sleeve mesh", "Sleeve/Elements around", "Study/Sleeve mesh list", "", "sleeve_elements_around",
     Finer::larger, &Study::sleeve_elements, needs_sleeve},
    {"sleeve mass scaling", "Sleeve/Mass scaling", "Study/Sleeve mass scaling list", "",
     "sleeve_mass_scaling", Finer::smaller, &Study::sleeve_mass_scalings, needs_sleeve}};

void check_list(const Scene &scene, const NumberParameter &parameter, const std::vector<double> &values) {
  if (const char *why = parameter.refused(scene); *why != '\0') refuse(scene, parameter.list, why);
  if (values.size() < 2)
    refuse(scene, parameter.list,
           "has nothing to compare: the last value is the reference of the others. Allowed: two or more.");
  const bool falls = parameter.finer == Finer::smaller;
  if (!std::is_sorted(values.begin(), values.end(),
                      [&](double a, double b) { return falls ? a > b : a < b; }))
    refuse(scene, parameter.list,
           std::string("does not go from coarse to fine. Allowed: ") + (falls ? "falling" : "rising") +
               " values; the last is the reference.");
}

void add_numbers(StudyPlan &plan, const Scene &scene, const NumberParameter &from) {
  const std::vector<double> &values = study_of(scene).*from.values;
  if (values.empty()) return;
  check_list(scene, from, values);
  const double own = case_column(from.column)->of(scene);
  const std::string unit = from.unit;
  StudiedParameter parameter{from.name, from.entry, unit, true, {}};
  for (const double value : values) {
    const std::string number = unit == "m" ? in_name(value, unit) : in_name(value);
    const StudyCase one{as_name(from.name) + "_" + number, {set(from.entry, value, unit)}};
    parameter.values.push_back({in_name(value), value, add(plan, value == own ? base : one)});
  }
  plan.parameters.push_back(std::move(parameter));
}

void add_qualities(StudyPlan &plan, const Scene &scene) {
  const std::vector<Quality> &words = study_of(scene).qualities;
  if (words.empty()) return;
  const bool rising = std::adjacent_find(words.begin(), words.end(), std::greater_equal<>()) == words.end();
  if (words.size() < 2 || !rising || words.front() == Quality::custom)
    refuse(scene, "Study/Quality list",
           "does not go from coarse to fine. Allowed: two or three of fast, standard, reference, in this "
           "order; the last is the reference.");
  for (const char *path : {"Integration/Safety", "Loading/Wave crossings"})
    if (overrules_quality(*scene.parameters, path))
      refuse(scene, "Study/Quality list",
             std::string("would not be heard: the scene says itself what ") + path +
                 " decides. Allowed: scenes that leave Integration/Safety, Loading/Axial rate and Wave "
                 "crossings open.");
  StudiedParameter parameter{"quality", "Scene/Quality", "", true, {}};
  for (const Quality kind : words) {
    const std::string word = quality(kind).word;
    const StudyCase one{"quality_" + word, {"Scene/Quality = " + word}};
    parameter.values.push_back({word, not_given, add(plan, kind == scene.general.quality ? base : one)});
  }
  plan.parameters.push_back(std::move(parameter));
}

void add_changes(StudyPlan &plan, const Scene &scene) {
  if (study_of(scene).changes.empty()) return;
  StudiedParameter parameter{"effects", "", "", false, {}};
  for (const std::string &change : study_of(scene).changes) {
    const std::string between = " = ", path = change.substr(0, change.find(between)),
                      value = change.substr(path.size() + between.size());
    if (path.rfind("Study/", 0) == 0 || path == "Scene/Seed")
      refuse(scene, "Study/Effects list", "changes " + path + ", which the study sets.");
    const Entry *entry = scene.parameters->find(path);
    if (entry != nullptr && entry->text == value)
      refuse(scene, "Study/Effects list",
             "changes nothing by " + path + " = " + value + ": the scene has it so.");
    parameter.values.push_back({change, not_given, add(plan, {as_name(change), {change}})});
  }
  parameter.values.push_back({"the scene as it is", not_given, add(plan, base)});
  plan.parameters.push_back(std::move(parameter));
}

} // namespace

StudyPlan plan_accuracy(const Scene &scene) {
  if (scene.loading.hydrostatic())
    refuse(scene, "Loading/Test", "has no strength to be accurate. Allowed: any other.");
  require_fall(scene);
  StudyPlan plan{StudyKind::accuracy, {}, {}};
  std::string lists;
  for (const NumberParameter &parameter : number_parameters) {
    plan.varied.emplace_back(parameter.column);
    add_numbers(plan, scene, parameter);
    lists += parameter.list + std::string("Study/").size() + std::string(", ");
  }
  add_qualities(plan, scene);
  add_changes(plan, scene);
  if (plan.parameters.empty())
    refuse(scene, "Study/Safety list",
           "is not set, nor is any other list of a study of accuracy: nothing is varied. "
           "Allowed: at least one of " +
               lists + "Quality list, Effects list.");
  return plan;
}

bool decides(const std::string &column, const Scene &scene) {
  return std::any_of(
      std::begin(number_parameters), std::end(number_parameters),
      [&](const NumberParameter &one) { return one.column == column && *one.refused(scene) == '\0'; });
}

} // namespace platen::apps
