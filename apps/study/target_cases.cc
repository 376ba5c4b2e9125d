// Cases of a study of a target.
#include <algorithm>
#include <cmath>

#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"
#include "apps/study/target_figures.h"

namespace platen::apps {
namespace {

const std::vector<double> usual_transits{15, 30, 60, 120};
constexpr double coarser = 1.25; // times the mean radius: half of the spheres

const std::string section = "Study/Target/";

void check_transits(const Scene &scene) {
  const std::vector<double> transits = target_transits(scene);
  if (transits.size() < 2 || transits.size() > most_speeds ||
      !std::is_sorted(transits.begin(), transits.end()))
    refuse(scene, "Study/Wave crossings list",
           fmt::format("gives a target no speeds to choose from. Allowed: 2 to {} rising numbers.",
                       most_speeds));
}

void check_gain(const Scene &scene) {
  const StudyTarget &target = study_of(scene).target;
  const bool gain = target.figure == TargetFigure::gain, over_scene = !target.over_scene.empty(),
             over = !target.over.empty();
  if (!gain && (over_scene || over))
    refuse(scene, section + (over ? "Over" : "Over scene"),
           "has no effect: Study/Target/Figure is no gain. Allowed: Figure = gain.");
  if (gain && over_scene == over)
    refuse(scene, section + "Figure",
           "needs one scene that it is over. Allowed: either Study/Target/Over scene or Over.");
  for (const std::string &entry : target.over)
    if (entry.rfind("Study/", 0) == 0 || entry.rfind("Scene/Seed", 0) == 0)
      refuse(scene, section + "Over", "changes " + entry + ", which the study sets.");
}

// Of each scene of a gain.
void check_test(const Scene &scene, TargetFigure figure) {
  if (scene.loading.hydrostatic())
    refuse(scene, "Loading/Test", "has no strength to be known. Allowed: any other.");
  if (scene.loading.servo)
    refuse(scene, "Study/Wave crossings list", "needs platens that are driven by motion.");
  if (figure != TargetFigure::modulus) require_fall(scene);
}

void check(const Scene &scene) {
  const StudyTarget &target = study_of(scene).target;
  check_test(scene, target.figure);
  if (scene.specimen.packing == PackingKind::file && !scene.bond.scattered)
    refuse(
        scene, "Specimen/Packing",
        "has one packing, and with Bond/Strength scatter = none nothing is drawn. Allowed: advancing front, "
        "random close.");
  if (target.coarser_seeds > 0 && scene.specimen.packing == PackingKind::file)
    refuse(scene, section + "Coarser seeds", "has no effect: Specimen/Packing = file. Allowed: 0.");
  if (target.step_seeds > 0 && scene.time_step.fixed_step > 0)
    refuse(scene, section + "Step seeds", "has no effect: Integration/Time step is set. Allowed: 0.");
  check_transits(scene);
  check_gain(scene);
  // The least that tells an interval: two packings at two speeds.
  const int pilot =
      (4 + target.step_seeds + target.coarser_seeds) * static_cast<int>(target_cases(scene).scenes);
  if (target.most_runs < pilot)
    refuse(scene, section + "Most runs", fmt::format("is less than the pilot takes. Allowed: >= {}.", pilot));
}

// What a gain is over, as it is run.
void check_other(const Scene &other, const StudyTarget &target) {
  check_test(other, target.figure);
  if (target.coarser_seeds > 0 && other.specimen.packing == PackingKind::file)
    refuse(other, "Specimen/Packing", "leaves " + section + "Coarser seeds nothing to pack.");
  if (target.step_seeds > 0 && other.time_step.fixed_step > 0)
    refuse(other, "Integration/Time step", "leaves " + section + "Step seeds nothing to halve.");
}

// A gain by platen friction, or by slenderness, that the bonds of either side are not calibrated for is none:
// no packing would change that.
void check_calibration(const Scene &scene, const Scene &other) {
  const auto slenderness = [](const Scene &of) { return of.specimen.height / of.specimen.width(); };
  const auto need = [&](CalibratedFigure figure) {
    for (const Scene *one : {&scene, &other})
      if (const std::string reason = one->bond.calibrated.against(figure); !reason.empty())
        refuse(scene, section + "Figure", "is none: " + reason + ". Allowed: strength, modulus.");
  };
  const auto differ = [](double a, double b) { return std::abs(a - b) > 1e-9; }; // not where one is not given
  const Platens &own = scene.platens, &others = other.platens;
  if (differ(own.top.friction_static, others.top.friction_static) ||
      differ(own.bottom.friction_static, others.bottom.friction_static))
    need(CalibratedFigure::friction);
  if (scene.specimen.shape != other.specimen.shape || differ(slenderness(scene), slenderness(other)))
    need(CalibratedFigure::slenderness);
}

// What runs do not need to know, lest another accuracy make them runs of another scene.
std::vector<std::string> without_target(const Scene &scene) {
  std::vector<std::string> entries;
  for (const Entry &entry : scene.parameters->entries())
    if (entry.path.rfind(section, 0) == 0) entries.push_back(entry.path + " = " + entry.default_text);
  return entries;
}

// Of one scene, `over` or not, at one speed and with what else is changed.
StudyCase case_of(const Scene &scene, bool over, double transits, const std::string &prefix = "",
                  const std::vector<std::string> &more = {}) {
  const StudyTarget &target = study_of(scene).target;
  StudyCase one{prefix + (over ? "over_" : "") + "wave_crossings_" + in_name(transits),
                without_target(scene)};
  const auto append = [&](const std::vector<std::string> &entries) {
    one.overrides.insert(one.overrides.end(), entries.begin(), entries.end());
  };
  if (over && target.over_scene.empty()) append(target.over);
  if (over) one.scene = target.over_scene;
  append({"Loading/Axial rate =", set("Loading/Wave crossings", transits, "")});
  append(more);
  one.is_expected = !over && more.empty();
  return one;
}

Scene read_other(const Scene &scene, const StudyCase &over, const std::vector<std::string> &overrides) {
  Scene other = scene_of(over, StudyKind::target, scene, scene.general.seed, overrides);
  try {
    check_other(other, study_of(scene).target);
  } catch (const InputError &error) {
    throw InputError(scene.path + ": error: a gain is over a scene that has none:\n" + error.what());
  }
  return other;
}

} // namespace

std::vector<double> target_transits(const Scene &scene) {
  return study_of(scene).wave_transits.empty() ? usual_transits : study_of(scene).wave_transits;
}

TargetCases target_cases(const Scene &scene) {
  const StudyTarget &target = study_of(scene).target;
  return {target_transits(scene).size(), target.figure == TargetFigure::gain ? 2U : 1U, target.step_seeds > 0,
          target.coarser_seeds > 0};
}

StudyPlan plan_target(const Scene &scene, const std::vector<std::string> &overrides) {
  check(scene);
  const TargetCases cases = target_cases(scene);
  const std::vector<double> transits = target_transits(scene);
  StudyPlan plan{StudyKind::target, {"wave_crossings"}, {}};
  for (std::size_t of = 0; of < cases.scenes; ++of)
    for (const double one : transits)
      plan.cases.push_back(case_of(scene, of > 0, one));
  std::vector<Scene> sides{scene};
  if (cases.scenes > 1) {
    sides.push_back(read_other(scene, plan.cases[cases.at(1, 0)], overrides));
    check_calibration(scene, sides.back());
  }
  const auto beside = [&](const std::string &prefix, const auto &changed) {
    for (std::size_t of = 0; of < cases.scenes; ++of)
      plan.cases.push_back(case_of(scene, of > 0, transits.front(), prefix, {changed(sides[of])}));
  };
  if (cases.half_step)
    beside("half_step_",
           [](const Scene &side) { return set("Integration/Safety", side.time_step.safety / 2, ""); });
  if (cases.coarser)
    beside("coarser_", [](const Scene &side) {
      return set("Specimen/Sphere radius", coarser * side.specimen.sphere_radius, "m");
    });
  return plan;
}

} // namespace platen::apps
