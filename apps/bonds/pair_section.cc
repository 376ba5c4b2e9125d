#include "apps/bonds/pair_section.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "apps/scene/members.h"
#include "apps/scene/scene_check.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

void declare_pair_test(Parameters &parameters, Scene &scene) {
  PairTest &pair = scene.own<PairTest>();
  Section section(parameters, "Pair test");
  section.integer("Particles", pair.particles, 2, 3, "Two in a row, or three as a pyramid.");
  section.entry("Path", pair.path, pair_paths, "How the upper particle is moved against the lower ones.");
  Section three = section.only_if([](const Scene &s) { return is_pyramid(s); }, "Pair test/Particles = 2");
  three.entry("Plate", pair.plate, pair_plates, "Three particles: what the lower two stand on.");
  three.entry("Base bond", pair.base_bond, "Three particles: a bond between the lower two.");
  section.entry("Force", pair.force, "N", above(0), "Largest force.");
  section.entry("Displacement", pair.displacement, "m", above(0), "Largest displacement.");
  Section prescribed = section.only_if([](const Scene &s) { return is_prescribed(s); },
                                       "bonds of Effects/Bond have no history");
  prescribed.entry(
      "Turns", pair.turns, "m", any_number(),
      "Displacements at which the path turns, opening positive, the last one its end; instead of "
      "Displacement (bonds with history).");
  prescribed
      .entry("Pressure", pair.pressure, "Pa", at_least(0), "Presses a bond with history while it is sheared.")
      .only_if("Pair test/Path", {"shear"});
  prescribed.number("Slip ratio", pair.slip_ratio, above(0), "Slip over opening of a bond with history.")
      .only_if("Pair test/Path", {"combined"});
  section.entry("Modulus list", pair.moduli, "Pa", above(0), "Bond moduli to run; empty: Bond/Modulus.");
  section.entry("Stiffness ratio list", pair.stiffness_ratios, "1",
                range_of<dem::ParallelBond::Parameters>("stiffness_ratio"),
                "Stiffness ratios to run; empty: Bond/Stiffness ratio.");
  section.integer("Steps", pair.steps, 1, 1e9, "Steps of loading.");
}

// Lists that are empty hold the one value of the scene.
void complete_pair(Parameters & /*parameters*/, Scene &scene) {
  PairTest &pair = scene.own<PairTest>();
  const double modulus = scene.model.bond_layout.modulus;
  if (pair.moduli.empty() && !std::isnan(modulus)) pair.moduli = {modulus};
  if (pair.stiffness_ratios.empty()) pair.stiffness_ratios = {scene.bond.number("stiffness_ratio")};
}

bool pair_gives(const Scene &scene, const Parameters & /*parameters*/, const std::string &path) {
  return path == "Bond/Modulus" && !pair_test_of(scene).moduli.empty();
}

// Of a bond with history, which is moved from place to place.
void check_prescribed(const SceneCheck &check) {
  const Scene &scene = check.scene();
  const PairTest &test = pair_test_of(scene);
  for (const char *key :
       {"Integration/Damping", "Integration/Damping form", "Integration/Time step", "Bond/Damping"})
    check.note(key, "a bond with history is moved without inertia");
  if (test.particles != 2)
    check.refuse("Pair test/Particles",
                 "leaves a bond that remembers to the oscillations of free spheres. Allowed: 2.");
  if (given(test.force))
    check.refuse("Pair test/Force",
                 "cannot lead a bond through its softening. Allowed: Pair test/Displacement or "
                 "Pair test/Turns instead.");
  if (!given(test.displacement) && test.turns.empty())
    check.refuse("Pair test/Displacement", "is not set, nor is Pair test/Turns. Allowed: one of them.");
  if (given(test.displacement) && !test.turns.empty())
    check.refuse("Pair test/Turns",
                 "contradicts Pair test/Displacement. Allowed: one of both leads the test.");
  double at = 0;
  for (const double turn : test.turns) {
    if (turn == at)
      check.refuse("Pair test/Turns", "stays where it is at " + shortest_text(turn) +
                                          " m. Allowed: "
                                          "displacements that differ from the one before, from 0 on.");
    if (test.path == PairPath::combined && turn < 0)
      check.refuse("Pair test/Turns", "closes a combined path. Allowed: >= 0.");
    at = turn;
  }
  if ((test.path == PairPath::shear || test.path == PairPath::combined) && !scene.model.rotation)
    check.refuse("Effects/Rotation",
                 "is off, but Pair test/Path slides spheres by turning them. Allowed: on.");
  if (scene.model.bond_layout.area_factor == 0)
    check.refuse("Bond/Area factor", "is taken from a packing, and two spheres are none. Allowed: > 0.");
}

void pair_scale(const SceneCheck &check) {
  if (!given(check.scene().specimen.sphere_radius)) return;
  const PairTest &test = pair_test_of(check.scene());
  const double radius = check.scene().specimen.sphere_radius;
  const auto far = [&](const char *path, double displacement) {
    if (std::abs(displacement) > 2 * radius)
      check.refuse(path, "moves a sphere by more than its size, " + check.set_to("Specimen/Sphere radius") +
                             ". Allowed: up to twice that.");
  };
  far("Pair test/Displacement", test.displacement);
  for (const double turn : test.turns)
    far("Pair test/Turns", turn);
  if (test.moduli.empty()) return;
  const double strain =
      test.force / (pi * radius * radius * *std::max_element(test.moduli.begin(), test.moduli.end()));
  if (strain > 1)
    check.refuse("Pair test/Force", "strains bonds between spheres of " +
                                        check.set_to("Specimen/Sphere radius") + " by " +
                                        fmt::format("{:.3g}", strain) + ". Allowed: up to 1.");
}

void check_pair_test(const SceneCheck &check) {
  pair_scale(check);
  if (!check.scene().bond.bonded())
    return check.refuse("Effects/Bond", "leaves platen-bonds without a bond to test.");
  if (check.scene().bond.remembers()) return check_prescribed(check);
  if (pair_test_of(check.scene()).path == PairPath::combined)
    check.refuse(
        "Pair test/Path",
        "needs a bond with history (elasto damage plastic, yielding parallel bond, facet). Allowed: tension, "
        "compression, shear, bending, twisting, cyclic.");
  if (!given(pair_test_of(check.scene()).force) && !given(pair_test_of(check.scene()).displacement))
    check.refuse("Pair test/Force",
                 "is not set, nor is Pair test/Displacement. Allowed: at least one of them.");
}

} // namespace

Program pair_program() {
  Program p;
  p.name = "platen-bonds";
  p.purpose = "Tests bonds between two or three spheres: loads, stiffness, strength, energies.";
  p.section = "Pair test";
  p.declare = declare_pair_test;
  p.complete = complete_pair;
  p.check = check_pair_test;
  p.gives = pair_gives;
  return p;
}

} // namespace platen::apps
