// Cases of the study of accuracy.
#include <cmath>
#include <functional>

#include "apps/scene/parameters.h"
#include "apps/scene/values.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

constexpr const char *base = "base";

enum class Finer { smaller, larger };

// An entry that is a number, and the list that varies it.
struct NumberParameter {
  const char *name, *entry, *list, *unit, *column; // column: of study.csv
  Finer finer;
  std::vector<double> Study::*values;
  double (*own)(const Scene &);          // what the scene has
  std::string (*refused)(const Scene &); // why the scene leaves nothing to vary; "" where it does
};

bool deformable(const Scene &s) {
  return s.platens.deformable;
}

std::string needs_limit(const Scene &s) {
  return s.time_step.fixed_step > 0 ? "has no effect: Integration/Time step is set. Allowed: Time step = 0."
                                    : "";
}

std::string needs_motion(const Scene &s) {
  return s.loading.servo ? "needs platens that are driven by motion." : "";
}

std::string needs_no_rate(const Scene &s) {
  return std::isnan(s.loading.rate) ? "" : "has no effect: Loading/Axial rate is set.";
}

// Heavier specimens carry slower waves, for which the platens would wait.
std::string needs_rate(const Scene &s) {
  return std::isnan(s.loading.rate) ? "gains nothing where Loading/Wave crossings sets the speed. Allowed: "
                                      "an Axial rate."
                                    : "";
}

std::string needs_packing(const Scene &s) {
  return s.specimen.packing == PackingKind::file
             ? "has no effect: Specimen/Packing = file. Allowed: advancing front, random close."
             : "";
}

std::string needs_plates(const Scene &s) {
  if (!deformable(s)) return "needs Platens/Kind = deformable.";
  return s.platens.any_of([&](coupling::Side side) { return s.platens.face(side).mesh_file.empty(); })
             ? ""
             : "has no effect: all platens have a Mesh file.";
}

std::string needs_solves(const Scene &s) {
  return deformable(s) && s.platens.elastic->motion == fem::ElasticMotion::quasi_static
             ? ""
             : "needs Platens/Kind = deformable and Motion = quasi-static.";
}

std::string needs_sleeve(const Scene &s) {
  return s.loading.sleeved() ? "" : "needs Loading/Confinement = sleeve.";
}

const NumberParameter number_parameters[] = {
    {"safety", "Integration/Safety", "Study/Safety list", "", "safety", Finer::smaller, &Study::safeties,
     [](const Scene &s) { return s.time_step.safety; }, needs_limit},
    {"axial rate", "Loading/Axial rate", "Study/Axial rate list", "m/s", "axial_rate_m_s", Finer::smaller,
     &Study::axial_rates, [](const Scene &s) { return s.loading.rate; }, needs_motion},
    {"wave crossings", "Loading/Wave crossings", "Study/Wave crossings list", "", "wave_crossings",
     Finer::larger, &Study::wave_transits, [](const Scene &s) { return s.loading.wave_transits; },
     needs_no_rate},
    {"hurry", "Loading/Hurry", "Study/Hurry list", "", "hurry", Finer::smaller, &Study::rate_multipliers,
     [](const Scene &s) { return s.loading.rate_multiplier; }, needs_motion},
    {"mass scaling", "Integration/Mass scaling", "Study/Mass scaling list", "", "mass_scaling",
     Finer::smaller, &Study::mass_scalings, [](const Scene &s) { return s.model.mass_scaling; }, needs_rate},
    {"sphere radius", "Specimen/Sphere radius", "Study/Sphere radius list", "m", "sphere_radius_m",
     Finer::smaller, &Study::sphere_radii, [](const Scene &s) { return s.specimen.sphere_radius; },
     needs_packing},
    {"platen mesh", "Platens/Elements across", "Study/Platen mesh list", "", "elements_across", Finer::larger,
     &Study::platen_elements, [](const Scene &s) { return static_cast<double>(s.platens.elements_across); },
     needs_plates},
    {"steps per solve", "Platens/Steps per solve", "Study/Steps per solve list", "", "steps_per_solve",
     Finer::smaller, &Study::steps_per_solve,
     [](const Scene &s) { return static_cast<double>(s.platens.elastic->steps_per_solve); }, needs_solves},
    {"sleeve mesh", "Sleeve/Elements around", "Study/Sleeve mesh list", "", "sleeve_elements_around",
     Finer::larger, &Study::sleeve_elements,
     [](const Scene &s) { return static_cast<double>(s.loading.cell->sleeve->elements_around); },
     needs_sleeve},
    {"sleeve mass scaling", "Sleeve/Mass scaling", "Study/Sleeve mass scaling list", "",
     "sleeve_mass_scaling", Finer::smaller, &Study::sleeve_mass_scalings,
     [](const Scene &s) { return s.loading.cell->sleeve->mass_scaling; }, needs_sleeve}};

void check_list(const Scene &scene, const NumberParameter &parameter, const std::vector<double> &values) {
  const auto refuse = [&](const std::string &why) { scene.parameters->refuse(parameter.list, why); };
  if (const std::string why = parameter.refused(scene); !why.empty()) refuse(why);
  if (values.size() < 2)
    refuse("has nothing to compare: the last value is the reference of the others. Allowed: two or more.");
  const bool falls = parameter.finer == Finer::smaller;
  if (!std::is_sorted(values.begin(), values.end(),
                      [&](double a, double b) { return falls ? a > b : a < b; }))
    refuse(std::string("does not go from coarse to fine. Allowed: ") + (falls ? "falling" : "rising") +
           " values; the last is the reference.");
}

void add_numbers(StudyPlan &plan, const Scene &scene, const NumberParameter &from) {
  const std::vector<double> &values = study_of(scene).*from.values;
  if (values.empty()) return;
  check_list(scene, from, values);
  StudiedParameter parameter{from.name, from.entry, from.unit, true, {}};
  for (const double value : values) {
    StudyCase one{base, {}, {}};
    if (value != from.own(scene))
      one = {
          as_name(from.name) + "_" + (from.unit == std::string("m") ? in_name(value, "m") : in_name(value)),
          {},
          {set(from.entry, value, from.unit)}};
    parameter.values.push_back({in_name(value), value, add(plan, one)});
  }
  plan.parameters.push_back(std::move(parameter));
}

void check_qualities(const Scene &scene) {
  const auto refuse = [&](const std::string &why) { scene.parameters->refuse("Study/Quality list", why); };
  const std::vector<Quality> &words = study_of(scene).qualities;
  const bool rising = std::adjacent_find(words.begin(), words.end(), std::greater_equal<>()) == words.end();
  if (words.size() < 2 || !rising || words.front() == Quality::custom)
    refuse(
        "does not go from coarse to fine. Allowed: two or three of fast, standard, reference, in this "
        "order; the last is the reference.");
  for (const char *path : {"Integration/Safety", "Loading/Wave crossings"})
    if (overrules_quality(*scene.parameters, path))
      refuse(std::string("would not be heard: the scene says itself what ") + path +
             " decides. Allowed: scenes that leave Integration/Safety, Loading/Axial rate and Wave crossings "
             "open.");
}

void add_qualities(StudyPlan &plan, const Scene &scene) {
  if (study_of(scene).qualities.empty()) return;
  check_qualities(scene);
  StudiedParameter parameter{"quality", "Scene/Quality", "", true, {}};
  for (const Quality kind : study_of(scene).qualities) {
    const std::string word = quality(kind).word;
    StudyCase one{base, {}, {}};
    if (kind != scene.general.quality) one = {"quality_" + word, {}, {"Scene/Quality = " + word}};
    parameter.values.push_back({word, not_given, add(plan, one)});
  }
  plan.parameters.push_back(std::move(parameter));
}

void check_change(const Scene &scene, const std::string &path, const std::string &value) {
  const auto refuse = [&](const std::string &why) { scene.parameters->refuse("Study/Effects list", why); };
  if (path.rfind("Study/", 0) == 0 || path == "Scene/Seed")
    refuse("changes " + path + ", which the study sets.");
  const Entry *entry = scene.parameters->find(path);
  if (entry != nullptr && entry->text == value)
    refuse("changes nothing by " + path + " = " + value + ": the scene has it so.");
}

void add_changes(StudyPlan &plan, const Scene &scene) {
  if (study_of(scene).changes.empty()) return;
  StudiedParameter parameter{"effects", "", "", false, {}};
  for (const std::string &change : study_of(scene).changes) {
    const std::string between = " = ";
    const std::size_t sign = change.find(between);
    check_change(scene, change.substr(0, sign), change.substr(sign + between.size()));
    parameter.values.push_back({change, not_given, add(plan, {as_name(change), {}, {change}})});
  }
  parameter.values.push_back({"the scene as it is", not_given, add(plan, {base, {}, {}})});
  plan.parameters.push_back(std::move(parameter));
}

} // namespace

StudyPlan plan_accuracy(const Scene &scene) {
  if (scene.loading.hydrostatic())
    scene.parameters->refuse("Loading/Test", "has no strength to be accurate. Allowed: any other.");
  require_fall(scene);
  StudyPlan plan;
  for (const NumberParameter &parameter : number_parameters) {
    plan.varied.emplace_back(parameter.column);
    add_numbers(plan, scene, parameter);
  }
  add_qualities(plan, scene);
  add_changes(plan, scene);
  if (!plan.parameters.empty()) return plan;
  std::string others;
  for (const NumberParameter &parameter : number_parameters)
    others += std::string(others.empty() ? "" : ", ") + (parameter.list + std::string("Study/").size());
  scene.parameters->refuse("Study/Safety list",
                           "is not set, nor is any other list of a study of accuracy: nothing is varied. "
                           "Allowed: at least one of " +
                               others + ", Quality list, Effects list.");
}

void label_parameters(StudyCase &of, const Scene &led_to) {
  of.labels.clear();
  for (const NumberParameter &parameter : number_parameters)
    of.labels.push_back(parameter.refused(led_to).empty() ? parameter.own(led_to) : not_given);
}

} // namespace platen::apps
