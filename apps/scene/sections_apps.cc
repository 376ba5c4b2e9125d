// Sections that one app each reads.
#include "apps/scene/members.h"
#include "apps/scene/sections.h"

namespace platen::apps {
namespace {

// What trades accuracy for time: each list is run alone, all else as the scene has it.
void declare_accuracy_lists(Section &section, Study &study) {
  section.entry(
      "Safety list", study.safeties, "1", above_up_to(0, 1),
      "Study of accuracy, in place of Integration/Safety. All lists of such a study go from coarse to "
      "fine; the last value is the reference of the others.");
  section.entry(
      "Wave crossings list", study.wave_transits, "1", above(0),
      "Studies of accuracy and of a target, in place of Loading/Wave crossings. Target: speeds from which it "
      "chooses, empty: 15, 30, 60, 120.");
  section.entry("Hurry list", study.rate_multipliers, "1", between(1, 100),
                "Study of accuracy, in place of Loading/Hurry.");
  section.entry("Mass scaling list", study.mass_scalings, "1", range_of<dem::ModelSettings>("mass_scaling"),
                "Study of accuracy, in place of Integration/Mass scaling.");
  section.entry("Platen mesh list", study.platen_elements, "1", between(1, 1000),
                "Study of accuracy, in place of Platens/Elements across (Kind = deformable).");
  section.entry("Steps per solve list", study.steps_per_solve, "1", between(1, 100000),
                "Study of accuracy, in place of Platens/Steps per solve (Motion = quasi-static).");
  section.entry("Sleeve mesh list", study.sleeve_elements, "1", between(8, 10000),
                "Study of accuracy, in place of Sleeve/Elements around.");
  section.entry("Sleeve mass scaling list", study.sleeve_mass_scalings, "1", at_least(1),
                "Study of accuracy, in place of Sleeve/Mass scaling: how seldom the sleeve is stepped.");
  section.value("Quality list", study.qualities, "", "words of Scene/Quality with commas between them",
                read_qualities,
                "Study of accuracy, in place of Scene/Quality; the scene leaves open what it stands for.");
  section.value("Effects list", study.changes, "",
                "\"Effects/Rotation = off\" with commas between them; no value may hold a comma",
                read_assignments,
                "Study of accuracy: entries of the scene, each set alone and compared with the scene as "
                "it is.");
}

void declare_target(Parameters &parameters, StudyTarget &target) {
  Section section(parameters, "Study/Target");
  section.entry("Figure", target.figure, target_figures,
                "Study of a target: what is to be known. Gain: strength over that of Over scene or Over.");
  section.number("Accuracy", target.accuracy, between(0.001, 0.5),
                 "Half of the interval over the figure: where it is reached, the study ends.");
  section.number("Confidence", target.confidence, between(0.5, 0.99),
                 "How often the interval holds the figure of slow loading.");
  section.file("Over scene", target.over_scene,
               "Gain: the scene whose strength stands below; both are run on the same seeds.");
  section.value("Over", target.over, "",
                "\"Platens/Friction static = 0\" with commas between them; no value may hold a comma",
                read_assignments, "Gain: or the entries that make that scene of this one.");
  section.integer(
      "Pilot seeds", target.pilot_seeds, 3, 100,
      "Packings of the first batch at each of its two speeds, at most; a coarse accuracy asks for fewer.");
  section.integer("Most runs", target.most_runs, 1, 100000,
                  "Where the accuracy is not reached with so many, the study ends and says what was.");
  section.number(
      "Step allowance", target.step_allowance, between(0, 0.1),
      "What the time step adds to the error (docs/accuracy.md: 0.2 % of the modulus at most, of the "
      "strength nothing that chaos would show).");
  section.integer("Step seeds", target.step_seeds, 0, 100,
                  "Packings that are run with half the step too: what differs for sure counts in place of a "
                  "smaller allowance; 0: none.");
  section.integer(
      "Coarser seeds", target.coarser_seeds, 0, 100,
      "Packings of spheres 1.25 times as large that are run beside the others, for what one size of "
      "spheres means; 0: the law of bench/results/sizes.md tells it.");
}

} // namespace

void declare_pair_test(Parameters &parameters, PairTest &pair) {
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

void declare_bar_test(Parameters &parameters, BarTest &bar) {
  Section section(parameters, "Bar test");
  section.entry("Load", bar.load, bar_loads,
                "What is done to a bar clamped at its lower end; none: its moduli alone.");
  section.entry<BarMethod>(
      "Method", bar.method,
      {{"both", BarMethod::both}, {"static", BarMethod::at_rest}, {"dynamic", BarMethod::dynamic}},
      "Static: the bar at rest under the load. Dynamic: it is let go from there and oscillates; an impact is "
      "dynamic.");
  section.entry<BarSide>("Bent along", bar.side, {{"x", BarSide::x}, {"y", BarSide::y}},
                         "The way in which bending pushes the free end.");
  section.number("Strain", bar.strain, above_up_to(0, 0.01),
                 "Size of the load: strain at the skin of the clamped end by strength of materials; impact: "
                 "speed of the struck end over that of the wave.");
  section.number("End depth", bar.end_depth, between(0.05, 10),
                 "Spheres whose surface is within this many mean radii of an end plane are clamped, loaded "
                 "or struck.");
  section.number("Periods", bar.periods, between(4, 1000), "Recorded of each oscillation.");
  section.entry("Bulk moduli", bar.bulk_moduli,
                "Measure the moduli of the interior too, under six strains of its skin.");
}

void declare_study(Parameters &parameters, Study &study) {
  Section section(parameters, "Study");
  section.integer("Seeds", study.seeds, 1, 1000, "Runs of each case: Scene/Seed and those after it.");
  section.value("Surface list", study.surfaces, "",
                "words of Platens/Surface and coefficients of friction (0 ... 5) with commas between them",
                read_surfaces,
                "Study of friction: platens, in place of all that Platens says of friction; "
                "custom: what the scene says. A number: constant friction of that coefficient.");
  section.entry("Slenderness list", study.slendernesses, "1", between(0.1, 20),
                "Studies of friction and slenderness: heights over the width, in place of Specimen/Height.");
  section.entry("Confining pressure list", study.pressures, "Pa", at_least(0),
                "Studies of friction and slenderness, in place of Loading/Confining pressure; 0: no cell.");
  section.entry(
      "Sphere radius list", study.sphere_radii, "m", above(0),
      "Studies of size, friction, slenderness and accuracy: mean radii, in place of Specimen/Sphere radius. "
      "Study of size with Domain list empty too: 0.5, 0.75, 1 and 1.25 mm (Tannu 2017).");
  section.value("Domain list", study.domains, "m", "pairs with commas between them, each \"72 mm x 22.5 mm\"",
                read_domains,
                "Study of size: further cylinders, height x radius, at Specimen/Sphere radius.");
  section.value("Gap list", study.gaps, "", std::string("gaps with commas between them, each ") + gap_allowed,
                read_gaps, "Study of the packing, in place of Bond/Gap.");
  section.entry("Radius multiplier list", study.radius_multipliers, "1",
                range_of<dem::BondLayout>("radius_multiplier"),
                "Study of the packing, in place of Bond/Radius multiplier; each with every gap and spread.");
  section.entry("Radius spread list", study.radius_spreads, "1", between(0, 1.5),
                "Study of the packing, in place of Specimen/Radius spread.");
  section.entry("Axial rate list", study.axial_rates, "m/s", above(0),
                "Studies of rate and accuracy, in place of Loading/Axial rate.");
  declare_accuracy_lists(section, study);
  declare_target(parameters, study.target);
}

} // namespace platen::apps
