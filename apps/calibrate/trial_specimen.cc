#include "apps/calibrate/trial_specimen.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {
namespace {

// Largest strains over that of a compression test, and the speed of splitting over its.
constexpr double tension_strain = 0.25, splitting_strain = 0.5, splitting_rate = 0.25;
// Short specimens bear more and further.
constexpr double slender = 2;
// Of a disc: its seats, as scenes/brazilian_concrete.prm; strips over the diameter.
constexpr double disc_end_layer = 1, strip_share = 0.1;

void set_friction(Platens &platens, double friction) {
  platens.both = {friction, friction, {}};
  for (const coupling::Side side : coupling::all_sides) {
    dem::SurfaceFriction &face = platens.at(side);
    face.friction_static = face.friction_dynamic = friction;
    face.weakening = {};
  }
}

// Of the wanted tensile over compressive strength where both are wanted of the scene.
double tension_rate(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  if (given(c.tension_rate)) return c.tension_rate;
  double compressive = not_given, tensile = not_given;
  for (const Target &target : c.targets) {
    if (target.kind == TargetKind::strength && std::isnan(compressive)) compressive = target.value;
    if (target.kind == TargetKind::tension && std::isnan(tensile)) tensile = target.value;
  }
  const double ratio = tensile / compressive;
  return scene.loading.rate * (std::isnan(ratio) ? 0.1 : ratio);
}

} // namespace

std::string SpecimenTest::form() const {
  if (kind == TestKind::splitting) return "disc";
  if (!box && !round && std::isnan(slenderness)) return "";
  const std::string shape = box ? "box" : (round ? "cylinder" : "slenderness");
  return std::isnan(slenderness) ? shape : fmt::format("{}_{:.6g}", shape, slenderness);
}

std::string SpecimenTest::name() const {
  constexpr const char *words[] = {"elastic", "compression", "tension", "splitting"};
  std::string text = pressure > 0 ? "triaxial" : words[static_cast<int>(kind)];
  const auto add = [&](const char *what, double value) {
    if (!std::isnan(value)) text += fmt::format(" {} {:.6g}", what, value);
  };
  if (pressure > 0) add(sleeve ? "sleeve" : "particles", pressure);
  if (!form().empty() && kind != TestKind::splitting) text += " " + form();
  add("friction", friction);
  add("rate", rate);
  add("strain", strain);
  if (curve_strain > 0) add(curve_of_gauge ? "curve of gauge" : "curve", curve_strain);
  return text;
}

bool same_test(const SpecimenTest &a, const SpecimenTest &b) {
  SpecimenTest x = a, y = b;
  x.curve_strain = y.curve_strain = 0;
  x.curve_of_gauge = y.curve_of_gauge = false;
  return x.name() == y.name();
}

Scene scene_of_form(const Scene &scene, const SpecimenTest &test) {
  Scene s = scene;
  SpecimenSection &specimen = s.specimen;
  const double width = specimen.width();
  if (test.kind == TestKind::splitting) {
    specimen.shape = SpecimenShape::disc;
    specimen.height = specimen.radius;
    if (specimen.ends == dem::EndPreparation::ground) specimen.end_layer = disc_end_layer;
    return s;
  }
  if (test.box && specimen.shape != SpecimenShape::box) {
    specimen.shape = SpecimenShape::box;
    specimen.radius = not_given;
    specimen.width_x = specimen.width_y = width;
  }
  if (test.round && specimen.shape == SpecimenShape::box) {
    specimen.shape = SpecimenShape::cylinder;
    specimen.radius = 0.5 * width;
    specimen.width_x = specimen.width_y = not_given;
  }
  if (given(test.slenderness)) specimen.height = test.slenderness * width;
  return s;
}

Scene scene_of_test(const Scene &scene, const SpecimenTest &test) {
  Scene s = scene_of_form(scene, test);
  s.bond.calibrated.figures.clear(); // what is calibrated now
  Loading &loading = s.loading;
  const double width = scene.specimen.width();
  loading.test = test.kind == TestKind::tension ? LoadingTest::tension : LoadingTest::compression;
  if (test.kind == TestKind::tension) {
    s.platens.glued = true;
    loading.rate = tension_rate(scene);
    loading.target_strain *= tension_strain;
  } else if (test.kind == TestKind::splitting) {
    loading.rate *= splitting_rate * width / scene.specimen.height;
    loading.target_strain *= splitting_strain;
    if (!(s.platens.strip_width > 0)) s.platens.strip_width = strip_share * width;
  } else if (test.loads()) {
    loading.rate *= s.specimen.height / scene.specimen.height;
    loading.target_strain *= std::max(1.0, slender * width / s.specimen.height);
  }
  if (given(test.friction)) set_friction(s.platens, test.friction);
  if (test.pressure > 0) {
    loading.confinement = test.sleeve ? ConfinementKind::sleeve : ConfinementKind::particles;
    loading.cell->pressure = test.pressure;
  }
  if (given(test.rate)) loading.rate = test.rate;
  if (given(test.strain)) loading.target_strain = test.strain;
  loading.target_strain = std::max(loading.target_strain, test.curve_strain);
  return s;
}

} // namespace platen::apps
