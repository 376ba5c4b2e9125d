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
  section.entry("Plate", pair.plate, pair_plates, "Three particles: what the lower two stand on.");
  section.entry("Base bond", pair.base_bond, "Three particles: a bond between the lower two.");
  section.entry("Force", pair.force, "N", above(0), "Largest force.");
  section.entry("Displacement", pair.displacement, "m", above(0), "Largest displacement.");
  section.entry("Turns", pair.turns, "m", any_number(),
                "Displacements at which the path turns, opening positive, the last one its end; instead of "
                "Displacement (elasto damage plastic).");
  section.entry("Pressure", pair.pressure, "Pa", at_least(0),
                "Presses the bond while it is sheared (elasto damage plastic).");
  section.number("Slip ratio", pair.slip_ratio, above(0),
                 "Slip over opening of the combined path (elasto damage plastic).");
  section.entry("Modulus list", pair.moduli, "Pa", above(0), "Bond moduli to run; empty: Bond/Modulus.");
  section.entry("Stiffness ratio list", pair.stiffness_ratios, "1",
                range_of<dem::ParallelBond::Parameters>("stiffness_ratio"),
                "Stiffness ratios to run; empty: Bond/Stiffness ratio.");
  section.integer("Steps", pair.steps, 1, 1e9, "Steps of loading.");
}

// Lists that are empty hold the one value of the scene.
void complete(Parameters & /*parameters*/, Scene &scene) {
  PairTest &pair = scene.own<PairTest>();
  const double modulus = scene.model.bond_layout.modulus;
  if (pair.moduli.empty() && !std::isnan(modulus)) pair.moduli = {modulus};
  if (pair.stiffness_ratios.empty()) pair.stiffness_ratios = {scene.bond.number("stiffness_ratio")};
}

bool gives(const Scene &scene, const Parameters & /*parameters*/, const std::string &path) {
  return path == "Bond/Modulus" && !pair_test_of(scene).moduli.empty();
}

// A bond that remembers is moved from place to place.
void led_pair(const SceneCheck &check) {
  const PairTest &test = pair_test_of(check.scene());
  if (check.scene().bond.is<dem::FacetBond>())
    return check.refuse("Effects/Bond",
                        "has no closed forms here. Allowed: another law, or a test of specimens.");
  const bool slips = test.path == PairPath::shear || test.path == PairPath::combined;
  if (test.particles != 2)
    check.refuse("Pair test/Particles",
                 "leaves a bond that remembers to the oscillations of free spheres. Allowed: 2.");
  const bool turns = test.path == PairPath::bending || test.path == PairPath::twisting;
  const bool yields = check.scene().bond.is<dem::YieldingParallelBond>();
  const bool bends = yields ? std::get<dem::YieldingParallelBond::Parameters>(check.scene().bond.laws).moments
                            : std::get<dem::ElastoDamagePlastic::Parameters>(check.scene().bond.laws).moments;
  if (turns && !(bends && check.scene().model.rotation))
    check.refuse("Pair test/Path",
                 std::string("turns spheres against each other, which their bond without moments does "
                             "not resist. Allowed: tension, compression, shear, cyclic, combined, or "
                             "Effects/Rotation and Effects/") +
                     (yields ? "Bond" : "Interface") + " moments = on.");
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
  if (slips && !check.scene().model.rotation)
    check.refuse("Effects/Rotation",
                 "is off, but Pair test/Path slides spheres by turning them. Allowed: on.");
  if (check.scene().model.bond_layout.area_factor == 0)
    check.refuse("Bond/Area factor", "is taken from a packing, and two spheres are none. Allowed: > 0.");
}

void pair_notes(const SceneCheck &check) {
  if (pair_test_of(check.scene()).particles == 2)
    for (const char *key : {"Pair test/Plate", "Pair test/Base bond"})
      check.note(key, "Pair test/Particles = 2");
  if (!check.scene().bond.remembers()) {
    for (const char *key : {"Pair test/Turns", "Pair test/Pressure", "Pair test/Slip ratio"})
      check.note(key, "Effects/Bond is not elasto damage plastic");
    return;
  }
  for (const char *key :
       {"Integration/Damping", "Integration/Damping form", "Integration/Time step", "Bond/Damping"})
    check.note(key, "an elasto damage plastic bond is led without inertia");
  if (pair_test_of(check.scene()).path != PairPath::shear)
    check.note("Pair test/Pressure", "Pair test/Path is not shear");
  if (pair_test_of(check.scene()).path != PairPath::combined)
    check.note("Pair test/Slip ratio", "Pair test/Path is not combined");
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
  pair_notes(check);
  pair_scale(check);
  if (!check.scene().bond.bonded())
    return check.refuse("Effects/Bond", "leaves platen-bonds without a bond to test.");
  if (check.scene().bond.remembers()) return led_pair(check);
  if (pair_test_of(check.scene()).path == PairPath::combined)
    check.refuse(
        "Pair test/Path",
        "needs a bond that remembers (elasto damage plastic, yielding parallel bond). Allowed: tension, "
        "compression, "
        "shear, bending, twisting, cyclic.");
  if (!given(pair_test_of(check.scene()).force) && !given(pair_test_of(check.scene()).displacement))
    check.refuse("Pair test/Force",
                 "is not set, nor is Pair test/Displacement. Allowed: at least one of them.");
}

} // namespace

Program pair_program() {
  Program p;
  p.name = "platen-bonds";
  p.purpose = "Tests bonds between two or three spheres and compares them with closed forms.";
  p.section = "Pair test";
  p.declare = declare_pair_test;
  p.complete = complete;
  p.check = check_pair_test;
  p.gives = gives;
  return p;
}

} // namespace platen::apps
