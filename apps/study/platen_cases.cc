// Cases of the studies of platens.
#include <algorithm>
#include <cmath>
#include <string>

#include "apps/scene/parameters.h"
#include "apps/scene/surfaces.h"
#include "apps/scene/values.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

void check_surfaces(const Scene &scene) {
  if (study_of(scene).surfaces.empty()) return;
  for (const coupling::Side side : coupling::all_sides)
    for (const char *key : {"/Surface", "/Friction static", "/Friction dynamic", "/Friction law"})
      if (scene.platens.has(side) && scene.parameters->at(section_of(side) + key).changed())
        refuse(scene, section_of(side) + key,
               "contradicts Study/Surface list, which says what both platens are. Allowed: "
               "one of both.");
}

void check_heights(const Scene &scene) {
  if (study_of(scene).slendernesses.empty()) return;
  const SpecimenSection &s = scene.specimen;
  if (s.packing == PackingKind::file)
    refuse(scene, "Specimen/Packing",
           "has one height: a study of slenderness packs its own. Allowed: advancing front, "
           "random close.");
  if (s.shape != SpecimenShape::cylinder && s.shape != SpecimenShape::box)
    refuse(scene, "Specimen/Shape", "has no slenderness that could be varied. Allowed: cylinder, box.");
}

void check_pressures(const Scene &scene) {
  const std::vector<double> &pressures = study_of(scene).pressures;
  const bool any =
      std::any_of(pressures.begin(), pressures.end(), [](double pressure) { return pressure > 0; });
  if (any && scene.loading.confinement == ConfinementKind::none)
    refuse(scene, "Study/Confining pressure list",
           "needs Loading/Confinement = particles, sleeve: how the pressure acts.");
}

// What the scene says of friction, and what it has for other faces, is taken back.
StudyCase of_surface(const Scene &scene, const StudySurface &to) {
  const bool by_number = !std::isnan(to.friction);
  StudyCase one{by_number ? "friction_" + in_name(to.friction) : as_name(text_of(to))};
  if (to.kind == SurfaceKind::custom && !by_number) return one;
  const auto add = [&](const std::string &key, const std::string &text) {
    one.overrides.push_back("Platens/" + key + " = " + text);
  };
  add("Surface", surface(to.kind).word);
  if (by_number) {
    for (const char *key : {"Friction static", "Friction dynamic"})
      add(key, shortest_text(to.friction));
    add("Friction law", "constant");
  }
  for (const auto &[key, text] : surface(to.kind).entries)
    add(key, text);
  if (to.kind == SurfaceKind::custom) return one;
  const auto take_back = [&](const std::string &key, const char *text) {
    if (scene.parameters->at("Platens/" + key).changed()) add(key, text);
  };
  if (to.kind != SurfaceKind::glued) take_back("Attachment", "contact");
  if (to.kind != SurfaceKind::rubber_sheet) take_back("Pad thickness", "0 m");
  if (to.kind != SurfaceKind::brush)
    for (const char *side : {"Top", "Bottom", "Left", "Right", "Front", "Back"})
      take_back(std::string(side) + "/Mesh file", "");
  return one;
}

StudyCase of_slenderness(const Scene &scene, double slenderness) {
  const double height = to_twelve_digits(slenderness * scene.specimen.width());
  StudyCase one{"slenderness_" + in_name(slenderness), {set("Specimen/Height", height, "m")}};
  // Where it would grow with the specimen, the platen stays as thick as the scene's.
  if (scene.platens.deformable && !scene.parameters->at("Platens/Thickness").changed())
    one.overrides.push_back(set("Platens/Thickness", scene.platens.thickness, "m"));
  return one;
}

StudyPlan plan_platens(StudyKind kind, const Scene &scene) {
  const Study &study = study_of(scene);
  if (scene.loading.test != LoadingTest::compression)
    refuse(scene, "Loading/Test", "is no test that platens end. Allowed: compression.");
  require_fall(scene);
  check_surfaces(scene);
  check_heights(scene);
  check_pressures(scene);
  const auto surfaces = cases_of(study.surfaces, [&](const auto &to) { return of_surface(scene, to); });
  const auto heights = cases_of(study.slendernesses, [&](double to) { return of_slenderness(scene, to); });
  const auto radii = cases_of(study.sphere_radii, [](double radius) {
    return StudyCase{"sphere_radius_" + in_name(radius, "m"), {set("Specimen/Sphere radius", radius, "m")}};
  });
  std::vector<StudyCase> cases = times(times(surfaces, heights), radii);
  for (StudyCase &one : cases)
    one.envelope = one.name;
  const auto pressures = cases_of(study.pressures, [](double pressure) {
    return StudyCase{
        "pressure_" + in_name(pressure, "Pa"),
        {pressure > 0 ? set("Loading/Confining pressure", pressure, "Pa") : "Loading/Confinement = none"}};
  });
  return {kind,
          {"friction_static", "friction_dynamic", "slenderness", "height_m", "sphere_radius_m",
           "confining_pressure_pa"},
          times(cases, pressures)};
}

} // namespace

StudyPlan plan_friction(const Scene &scene) {
  if (study_of(scene).surfaces.empty())
    refuse(scene, "Study/Surface list",
           "is not set: nothing is varied. Allowed: words of Platens/Surface and "
           "coefficients of friction with commas between them.");
  return plan_platens(StudyKind::friction, scene);
}

StudyPlan plan_slenderness(const Scene &scene) {
  if (study_of(scene).slendernesses.empty())
    refuse(scene, "Study/Slenderness list",
           "is not set: nothing is varied. Allowed: heights over the width with commas between them.");
  if (study_of(scene).surfaces.size() > 1)
    refuse(scene, "Study/Surface list",
           "holds several: a study of slenderness has one kind of platens. Allowed: one, or "
           "platen-study friction.");
  return plan_platens(StudyKind::slenderness, scene);
}

const dem::SurfaceFriction *common_friction(const Scene &scene) {
  const Platens &p = scene.platens;
  const bool differ = p.any_of([&](coupling::Side side) {
    return p.at(side).friction_static != p.top.friction_static ||
           p.at(side).friction_dynamic != p.top.friction_dynamic;
  });
  return differ || p.glued ? nullptr : &p.top;
}

std::string surface_of(const Scene &scene) {
  const SurfaceKind kind = scene.platens.surface;
  const dem::SurfaceFriction *friction = common_friction(scene);
  return kind == SurfaceKind::custom && friction != nullptr ? "friction " + in_name(friction->friction_static)
                                                            : surface(kind).word;
}

} // namespace platen::apps
