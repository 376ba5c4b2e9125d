// Sections of a scene that one app each reads. NaN means "not given" where a member says so.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/quality.h"
#include "apps/scene/quantities.h"
#include "apps/scene/scene_calibrate.h"
#include "apps/scene/scene_loading.h"

namespace platen::apps {

enum class PairPath { tension, compression, shear, bending, twisting, cyclic, combined };
inline const Words<PairPath> pair_paths{
    {"tension", PairPath::tension},  {"compression", PairPath::compression}, {"shear", PairPath::shear},
    {"bending", PairPath::bending},  {"twisting", PairPath::twisting},       {"cyclic", PairPath::cyclic},
    {"combined", PairPath::combined}};
enum class PairPlate { frictionless, rolling, sticking };
inline const Words<PairPlate> pair_plates{{"frictionless", PairPlate::frictionless},
                                          {"rolling", PairPlate::rolling},
                                          {"sticking", PairPlate::sticking}};

struct PairTest { // platen-bonds
  int particles = 2;
  PairPath path = PairPath::tension;
  PairPlate plate = PairPlate::frictionless; // three particles: what the lower two stand on
  bool base_bond = true;                     // three particles: a bond between the lower two
  double force = not_given;                  // N, largest
  double displacement = not_given;           // m, largest
  // Elasto damage plastic.
  std::vector<double> turns;  // m, displacements at which the path turns, opening positive; empty: one way
  double pressure = 0;        // Pa, that presses the bond while it is sheared
  double slip_ratio = 1;      // slip over opening of a combined path
  std::vector<double> moduli; // Pa; holds Bond/Modulus where the list is empty
  std::vector<double> stiffness_ratios; // holds Bond/Stiffness ratio where the list is empty
  int steps = 1000;
};

enum class BarLoad { all, tension, bending, torsion, impact, none };
inline const Words<BarLoad> bar_loads{{"all", BarLoad::all},         {"tension", BarLoad::tension},
                                      {"bending", BarLoad::bending}, {"torsion", BarLoad::torsion},
                                      {"impact", BarLoad::impact},   {"none", BarLoad::none}};
enum class BarMethod { both, at_rest, dynamic };
enum class BarSide { x, y };

struct BarTest {               // platen-bar
  BarLoad load = BarLoad::all; // none: the moduli alone
  BarMethod method = BarMethod::both;
  BarSide side = BarSide::x; // the way in which the bar is bent
  double strain = 1e-4;      // at the skin of the clamped end
  double end_depth = 1;      // mean sphere radii
  double periods = 10;       // recorded of each oscillation
  bool bulk_moduli = true;
};

struct DomainSize {              // of a cylinder
  double height = 0, radius = 0; // m
};

// The list, or the one value that the scene has.
template <class Value>
std::vector<Value> or_own(const std::vector<Value> &list, const Value &own) {
  return list.empty() ? std::vector<Value>{own} : list;
}

enum class TargetFigure { strength, modulus, gain };
inline const Words<TargetFigure> target_figures{{"strength", TargetFigure::strength},
                                                {"youngs modulus", TargetFigure::modulus},
                                                {"gain", TargetFigure::gain}};

struct StudyTarget { // study of a target: an accuracy that is ordered
  TargetFigure figure = TargetFigure::strength;
  double accuracy = 0.02;        // half of the interval over the figure
  double confidence = 0.9;       // of the interval
  std::string over_scene;        // gain: path of the scene that it is over
  std::vector<std::string> over; // or what makes that scene of this one
  int pilot_seeds = 5;
  int most_runs = 200;
  double step_allowance = 0.002; // relative error of the figure
  int step_seeds = 0, coarser_seeds = 0;
};

struct Study {                        // platen-study; a list that is empty leaves the scene's own value
  int seeds = 5;                      // runs of each case: Scene/Seed and those after it
  std::vector<StudySurface> surfaces; // friction
  std::vector<double> slendernesses;  // height over width; friction, slenderness
  std::vector<double> pressures;      // Pa, of the cell; friction, slenderness
  std::vector<double> sphere_radii;   // m; size, friction, slenderness
  std::vector<DomainSize> domains;    // size; at the scene's sphere radius
  std::vector<Gap> gaps;              // packing
  std::vector<double> radius_multipliers, radius_spreads; // packing
  std::vector<double> axial_rates;                        // m/s; rate, accuracy
  // The rest, sphere radii and rates: accuracy, each from coarse to fine, the last the reference.
  std::vector<double> safeties, mass_scalings, rate_multipliers;
  std::vector<double> platen_elements, steps_per_solve; // whole
  std::vector<double> sleeve_elements;                  // whole
  std::vector<double> sleeve_mass_scalings, wave_transits;
  std::vector<Quality> qualities;
  std::vector<std::string> changes; // "Section/Key = value", each alone against the scene as it is
  StudyTarget target;
};

} // namespace platen::apps
