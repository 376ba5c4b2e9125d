#include "apps/bar/bar_section.h"

#include "apps/scene/declare.h"
#include "apps/scene/scene_check.h"

namespace platen::apps {
namespace {

void declare_bar_test(Parameters &parameters, Scene &scene) {
  BarTest &bar = scene.own<BarTest>();
  Section section(parameters, "Bar test");
  section.entry("Load", bar.load, bar_loads,
                "What is done to a bar clamped at its lower end; none: its moduli alone.");
  section.entry<BarMethod>(
      "Method", bar.method,
      {{"both", BarMethod::both}, {"static", BarMethod::at_rest}, {"dynamic", BarMethod::dynamic}},
      "Static: the bar at rest under the load. Dynamic: it is let go from there and oscillates; an impact is "
      "dynamic.");
  section
      .entry<BarSide>("Bent along", bar.side, {{"x", BarSide::x}, {"y", BarSide::y}},
                      "The way in which bending pushes the free end.")
      .only_if("Bar test/Load", {"bending", "all"});
  section.number("Strain", bar.strain, above_up_to(0, 0.01),
                 "Size of the load: strain at the skin of the clamped end by strength of materials; impact: "
                 "speed of the struck end over that of the wave.");
  section.number("End depth", bar.end_depth, between(0.05, 10),
                 "Spheres whose surface is within this many mean radii of an end plane are clamped, loaded "
                 "or struck.");
  section.number("Periods", bar.periods, between(4, 1000), "Recorded of each oscillation.")
      .unless("Bar test/Method", {"static"});
  section.entry("Bulk moduli", bar.bulk_moduli,
                "Measure the moduli of the interior too, under six strains of its skin.");
}

void bar_notes(const SceneCheck &check) {
  for (const char *key : {"Specimen/Ends", "Specimen/Seat"})
    check.note(key, "a bar is held by the spheres of its end");
  for (const char *key : {"Loading/Axial rate", "Loading/Target strain", "Platens/Friction static"})
    check.note(key, "a bar meets no platens");
  check.note("Output/Fields every", "platen-bar writes no frames");
  check.note("Checkpoint/Every", "platen-bar writes no checkpoints");
  if (bar_test_of(check.scene()).method == BarMethod::at_rest && check.scene().effects.contact)
    check.note("Effects/Contact", "Bar test/Method = static");
}

void check_bar_test(const SceneCheck &check) {
  bar_notes(check);
  const BarTest &bar = bar_test_of(check.scene());
  if (!check.scene().bond.bonded())
    check.refuse("Effects/Bond", "leaves a heap of grains, no bar. Allowed: parallel bond, cohesive beam.");
  if (check.scene().effects.gravity)
    check.refuse("Effects/Gravity", "would load the bar before the test does. Allowed: off.");
  const bool oscillates = bar.method != BarMethod::at_rest && bar.load != BarLoad::none;
  const std::string damps =
      "would damp what is to oscillate freely. Allowed: 0, or Bar test/Method = static.";
  if (oscillates && check.scene().model.local_damping > 0) check.refuse("Integration/Damping", damps);
  if (oscillates && check.scene().model.bond_dashpot > 0) check.refuse("Bond/Damping", damps);
  if (bar.load == BarLoad::impact && bar.method == BarMethod::at_rest)
    check.refuse("Bar test/Method", "leaves nothing of Bar test/Load = impact. Allowed: both, dynamic.");
  const SpecimenSection &specimen = check.scene().specimen;
  if (given(specimen.sphere_radius) && given(specimen.height) &&
      2 * (bar.end_depth + 2) * specimen.sphere_radius > specimen.height)
    check.refuse("Bar test/End depth",
                 "is too deep: the two ends leave no bar between them in Specimen/Height = " +
                     check.parameters().at("Specimen/Height").text + ".");
}

} // namespace

Program bar_program() {
  Program p;
  p.name = "platen-bar";
  p.purpose = "Pulls, bends, twists and strikes a bonded bar and compares it with strength of materials.";
  p.section = "Bar test";
  p.declare = declare_bar_test;
  p.check = check_bar_test;
  return p;
}

} // namespace platen::apps
