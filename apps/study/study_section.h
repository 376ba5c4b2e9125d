// The section Study, which platen-study reads. NaN means "not given" where a member says so.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/scene/program.h"
#include "apps/scene/scene.h"
#include "apps/scene/surfaces.h"

namespace platen::apps {

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

struct DomainSize {              // of a cylinder
  double height = 0, radius = 0; // m
};

struct Varied {                                 // study of any entries
  std::vector<std::string> paths;               // "Platens/Friction static"; none where nothing is varied
  std::vector<std::vector<std::string>> values; // of each case, one for each path
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
  std::array<Varied, 4> vary;       // vary: each value with each of the others
  StudyTarget target;
};

inline const Study &study_of(const Scene &scene) {
  return scene.own<Study>();
}

// Kinds of studies by their word on the command line, as StudyKind (apps/study/cases.h) numbers them.
inline constexpr std::array study_words{"friction", "slenderness", "size", "packing",
                                        "rate",     "accuracy",    "vary", "target"};

Program study_program();

} // namespace platen::apps
