// Cases of the studies of platens.
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "apps/scene/parameters.h"
#include "apps/scene/surfaces.h"
#include "apps/scene/values.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

void check_test(const Scene &scene) {
  if (scene.loading.test != LoadingTest::compression)
    scene.parameters->refuse("Loading/Test", "is no test that platens end. Allowed: compression.");
  require_fall(scene);
}

void check_surfaces(const Scene &scene) {
  if (study_of(scene).surfaces.empty()) return;
  for (const coupling::Side side : coupling::all_sides)
    for (const char *key : {"/Surface", "/Friction static", "/Friction dynamic", "/Friction law"})
      if (scene.platens.has(side) && scene.parameters->at(section_of(side) + key).changed())
        scene.parameters->refuse(section_of(side) + key,
                                 "contradicts Study/Surface list, which says what both platens are. Allowed: "
                                 "one of both.");
}

void check_heights(const Scene &scene) {
  if (study_of(scene).slendernesses.empty()) return;
  const SpecimenSection &s = scene.specimen;
  if (s.packing == PackingKind::file)
    scene.parameters->refuse(
        "Specimen/Packing",
        "has one height: a study of slenderness packs its own. Allowed: advancing front, "
        "random close.");
  if (s.shape != SpecimenShape::cylinder && s.shape != SpecimenShape::box)
    scene.parameters->refuse("Specimen/Shape",
                             "has no slenderness that could be varied. Allowed: cylinder, box.");
}

void check_pressures(const Scene &scene) {
  const bool any = std::any_of(study_of(scene).pressures.begin(), study_of(scene).pressures.end(),
                               [](double pressure) { return pressure > 0; });
  if (any && scene.loading.confinement == ConfinementKind::none)
    scene.parameters->refuse("Study/Confining pressure list",
                             "needs Loading/Confinement = particles, sleeve: how the pressure acts.");
}

// What the scene says of friction, and what it has for other faces, is taken back.
std::vector<std::string> surface_entries(const Scene &scene, const StudySurface &to) {
  if (to.kind == SurfaceKind::custom && std::isnan(to.friction)) return {};
  const std::string section = "Platens/";
  std::vector<std::string> entries{section + "Surface = " + surface(to.kind).word};
  if (!std::isnan(to.friction)) {
    for (const char *key : {"Friction static", "Friction dynamic"})
      entries.push_back(set(section + key, to.friction, ""));
    entries.push_back(section + "Friction law = constant");
  }
  for (const auto &[key, text] : surface(to.kind).entries)
    entries.push_back(section + key + " = " + text);
  if (to.kind == SurfaceKind::custom) return entries;
  const auto take_back = [&](const char *key, const char *text) {
    if (scene.parameters->at(section + key).changed()) entries.push_back(section + key + " = " + text);
  };
  if (to.kind != SurfaceKind::glued) take_back("Attachment", "contact");
  if (to.kind != SurfaceKind::rubber_sheet) take_back("Pad thickness", "0 m");
  if (to.kind != SurfaceKind::brush)
    for (const char *file : {"Top/Mesh file", "Bottom/Mesh file", "Left/Mesh file", "Right/Mesh file",
                             "Front/Mesh file", "Back/Mesh file"})
      take_back(file, "");
  return entries;
}

std::string surface_name(const StudySurface &of) {
  return std::isnan(of.friction) ? as_name(text_of(of)) : "friction_" + in_name(of.friction);
}

void set_height(const Scene &scene, double slenderness, StudyCase &one) {
  const double height = to_twelve_digits(slenderness * scene.specimen.width());
  one.name += (one.name.empty() ? "slenderness_" : "_slenderness_") + in_name(slenderness);
  one.overrides.push_back(set("Specimen/Height", height, "m"));
  // Where it would grow with the specimen, the platen stays as thick as the scene's.
  if (scene.platens.deformable && !scene.parameters->at("Platens/Thickness").changed())
    one.overrides.push_back(set("Platens/Thickness", scene.platens.thickness, "m"));
}

void set_pressure(double pressure, StudyCase &one) {
  one.envelope = one.name;
  one.name += "_pressure_" + in_name(pressure, "Pa");
  one.overrides.push_back(pressure > 0 ? set("Loading/Confining pressure", pressure, "Pa")
                                       : "Loading/Confinement = none");
}

StudyPlan plan_platens(const Scene &scene) {
  const Study &study = study_of(scene);
  check_test(scene);
  check_surfaces(scene);
  check_heights(scene);
  check_pressures(scene);
  StudyPlan plan;
  plan.varied = {"friction_static", "friction_dynamic", "slenderness",
                 "height_m",        "sphere_radius_m",  "confining_pressure_pa"};
  for (const double pressure : or_own(study.pressures, not_given))
    for (const double radius : or_own(study.sphere_radii, not_given))
      for (const double slenderness : or_own(study.slendernesses, not_given))
        for (const StudySurface &platens : or_own(study.surfaces, StudySurface{})) {
          StudyCase one;
          if (!study.surfaces.empty()) one.name = surface_name(platens);
          one.overrides = surface_entries(scene, platens);
          if (!std::isnan(slenderness)) set_height(scene, slenderness, one);
          if (!std::isnan(radius)) {
            one.name += "_sphere_radius_" + in_name(radius, "m");
            one.overrides.push_back(set("Specimen/Sphere radius", radius, "m"));
          }
          if (!std::isnan(pressure)) set_pressure(pressure, one);
          add(plan, one);
        }
  return plan;
}

} // namespace

StudyPlan plan_friction(const Scene &scene) {
  if (study_of(scene).surfaces.empty())
    scene.parameters->refuse("Study/Surface list",
                             "is not set: nothing is varied. Allowed: words of Platens/Surface and "
                             "coefficients of friction with commas between them.");
  return plan_platens(scene);
}

StudyPlan plan_slenderness(const Scene &scene) {
  if (study_of(scene).slendernesses.empty())
    scene.parameters->refuse(
        "Study/Slenderness list",
        "is not set: nothing is varied. Allowed: heights over the width with commas between them.");
  if (study_of(scene).surfaces.size() > 1)
    scene.parameters->refuse(
        "Study/Surface list",
        "holds several: a study of slenderness has one kind of platens. Allowed: one, or "
        "platen-study friction.");
  return plan_platens(scene);
}

void label_platens(StudyCase &of, const Scene &led_to) {
  const Platens &p = led_to.platens;
  const bool alike = !p.any_of([&](coupling::Side side) {
    return p.at(side).friction_static != p.top.friction_static ||
           p.at(side).friction_dynamic != p.top.friction_dynamic;
  }),
             slides = alike && !p.glued, known = p.surface != SurfaceKind::custom;
  of.surface = known    ? surface(p.surface).word
               : slides ? "friction " + in_name(p.top.friction_static)
                        : surface(p.surface).word;
  of.labels = {slides ? p.top.friction_static : not_given,
               slides ? p.top.friction_dynamic : not_given,
               to_twelve_digits(led_to.specimen.height / led_to.specimen.width()),
               led_to.specimen.height,
               led_to.specimen.sphere_radius,
               led_to.loading.confined() ? led_to.loading.cell->pressure : 0.0};
}

} // namespace platen::apps
