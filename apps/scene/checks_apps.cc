// Sections that one app each reads.
#include "apps/scene/scene_check.h"

#include <algorithm>

#include "apps/scene/units.h"
#include "apps/scene/values.h"

namespace platen::apps {

void SceneCheck::pair_test() const {
  if (app_ != AppKind::bonds) return;
  if (!scene_.bond.bonded()) return refuse("Effects/Bond", "leaves platen-bonds without a bond to test.");
  if (scene_.bond.remembers()) return led_pair();
  if (scene_.pair_test.path == PairPath::combined)
    refuse("Pair test/Path",
           "needs a bond that remembers (elasto damage plastic, yielding parallel bond). Allowed: tension, "
           "compression, "
           "shear, bending, twisting, cyclic.");
  if (!given(scene_.pair_test.force) && !given(scene_.pair_test.displacement))
    refuse("Pair test/Force", "is not set, nor is Pair test/Displacement. Allowed: at least one of them.");
}

// A bond that remembers is moved from place to place.
void SceneCheck::led_pair() const {
  const PairTest &test = scene_.pair_test;
  const bool slips = test.path == PairPath::shear || test.path == PairPath::combined;
  if (test.particles != 2)
    refuse("Pair test/Particles",
           "leaves a bond that remembers to the oscillations of free spheres. Allowed: 2.");
  const bool turns = test.path == PairPath::bending || test.path == PairPath::twisting;
  const bool yields = scene_.bond.is<dem::YieldingParallelBond>();
  const bool bends = yields ? std::get<dem::YieldingParallelBond::Parameters>(scene_.bond.laws).moments
                            : std::get<dem::ElastoDamagePlastic::Parameters>(scene_.bond.laws).moments;
  if (turns && !(bends && scene_.model.rotation))
    refuse("Pair test/Path",
           std::string("turns spheres against each other, which their bond without moments does "
                       "not resist. Allowed: tension, compression, shear, cyclic, combined, or "
                       "Effects/Rotation and Effects/") +
               (yields ? "Bond" : "Interface") + " moments = on.");
  if (given(test.force))
    refuse("Pair test/Force",
           "cannot lead a bond through its softening. Allowed: Pair test/Displacement or "
           "Pair test/Turns instead.");
  if (!given(test.displacement) && test.turns.empty())
    refuse("Pair test/Displacement", "is not set, nor is Pair test/Turns. Allowed: one of them.");
  if (given(test.displacement) && !test.turns.empty())
    refuse("Pair test/Turns", "contradicts Pair test/Displacement. Allowed: one of both leads the test.");
  double at = 0;
  for (const double turn : test.turns) {
    if (turn == at)
      refuse("Pair test/Turns", "stays where it is at " + shortest_text(turn) +
                                    " m. Allowed: "
                                    "displacements that differ from the one before, from 0 on.");
    if (test.path == PairPath::combined && turn < 0)
      refuse("Pair test/Turns", "closes a combined path. Allowed: >= 0.");
    at = turn;
  }
  if (slips && !scene_.model.rotation)
    refuse("Effects/Rotation", "is off, but Pair test/Path slides spheres by turning them. Allowed: on.");
  if (scene_.model.bond_layout.area_factor == 0)
    refuse("Bond/Area factor", "is taken from a packing, and two spheres are none. Allowed: > 0.");
}

void SceneCheck::bar_test() const {
  if (app_ != AppKind::bar) return;
  const BarTest &bar = scene_.bar_test;
  if (!scene_.bond.bonded())
    refuse("Effects/Bond", "leaves a heap of grains, no bar. Allowed: parallel bond, cohesive beam.");
  if (scene_.effects.gravity)
    refuse("Effects/Gravity", "would load the bar before the test does. Allowed: off.");
  const bool oscillates = bar.method != BarMethod::at_rest && bar.load != BarLoad::none;
  const std::string damps =
      "would damp what is to oscillate freely. Allowed: 0, or Bar test/Method = static.";
  if (oscillates && scene_.model.local_damping > 0) refuse("Integration/Damping", damps);
  if (oscillates && scene_.model.bond_dashpot > 0) refuse("Bond/Damping", damps);
  if (bar.load == BarLoad::impact && bar.method == BarMethod::at_rest)
    refuse("Bar test/Method", "leaves nothing of Bar test/Load = impact. Allowed: both, dynamic.");
  const SpecimenSection &specimen = scene_.specimen;
  if (given(specimen.sphere_radius) && given(specimen.height) &&
      2 * (bar.end_depth + 2) * specimen.sphere_radius > specimen.height)
    refuse("Bar test/End depth", "is too deep: the two ends leave no bar between them in Specimen/Height = " +
                                     parameters_.at("Specimen/Height").text + ".");
}

// What a list of the study stands for must be there to be varied, and vary: each value once.
void SceneCheck::study() const {
  if (app_ != AppKind::study) return;
  const Study &study = scene_.study;
  const auto words_once = [&](const std::string &path, std::vector<std::string> words) {
    std::sort(words.begin(), words.end());
    const auto twice = std::adjacent_find(words.begin(), words.end());
    if (twice != words.end()) refuse(path, "holds " + *twice + " twice. Allowed: each once.");
  };
  const auto once = [&](const std::string &path, const std::vector<double> &values) {
    std::vector<std::string> words;
    for (const double value : values)
      words.push_back(shortest_text(value));
    words_once(path, std::move(words));
  };
  std::vector<std::string> platens;
  for (const StudySurface &one : study.surfaces)
    platens.push_back(text_of(one));
  words_once("Study/Surface list", std::move(platens));
  once("Study/Slenderness list", study.slendernesses);
  once("Study/Confining pressure list", study.pressures);
  once("Study/Sphere radius list", study.sphere_radii);
  once("Study/Radius multiplier list", study.radius_multipliers);
  once("Study/Radius spread list", study.radius_spreads);
  once("Study/Axial rate list", study.axial_rates);
  once("Study/Safety list", study.safeties);
  once("Study/Wave crossings list", study.wave_transits);
  once("Study/Hurry list", study.rate_multipliers);
  once("Study/Mass scaling list", study.mass_scalings);
  once("Study/Platen mesh list", study.platen_elements);
  once("Study/Steps per solve list", study.steps_per_solve);
  once("Study/Sleeve mesh list", study.sleeve_elements);
  once("Study/Sleeve mass scaling list", study.sleeve_mass_scalings);
  words_once("Study/Effects list", study.changes);
  for (const bool relative : {true, false}) {
    std::vector<double> gaps;
    for (const Gap &gap : study.gaps)
      if (gap.relative == relative) gaps.push_back(gap.value);
    once("Study/Gap list", gaps);
  }
  if (!study.domains.empty() && scene_.specimen.shape != SpecimenShape::cylinder)
    refuse("Study/Domain list", "holds cylinders, but Specimen/Shape = " +
                                    parameters_.at("Specimen/Shape").text + ". Allowed: Shape = cylinder.");
  if (study.seeds > 1 && scene_.specimen.packing == PackingKind::file && !scene_.bond.scattered)
    refuse("Study/Seeds",
           "would repeat one run: with Specimen/Packing = file and Bond/Strength scatter = none nothing is "
           "drawn. Allowed: 1.");
}

} // namespace platen::apps
