// The section Calibrate: what platen-calibrate looks for, and what it may change.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "apps/calibrate/target.h"
#include "apps/scene/program.h"
#include "apps/scene/scene.h"
#include "base/describe.h"

namespace platen::apps {

enum class CalibrateMode { bounds, abacus, search };
inline const Words<CalibrateMode> calibrate_modes{
    {"bounds", CalibrateMode::bounds}, {"abacus", CalibrateMode::abacus}, {"search", CalibrateMode::search}};

// What a calibration may change, in the order of its tables.
enum class FreeParameter {
  modulus,
  stiffness_ratio,
  radius_multiplier,
  poisson_ratio, // of beams; abacus alone
  tensile_strength,
  shear_strength,
  moment_contribution,
  friction_angle,
  compression_limits, // one factor to all of the scene's
  contact_friction
};
constexpr std::size_t parameter_count = 10;
// Those that a search may free, as Calibrate/Free names them.
inline const Words<FreeParameter> free_parameters{{"modulus", FreeParameter::modulus},
                                                  {"stiffness ratio", FreeParameter::stiffness_ratio},
                                                  {"radius multiplier", FreeParameter::radius_multiplier},
                                                  {"tensile strength", FreeParameter::tensile_strength},
                                                  {"shear strength", FreeParameter::shear_strength},
                                                  {"moment contribution", FreeParameter::moment_contribution},
                                                  {"friction angle", FreeParameter::friction_angle},
                                                  {"compression limits", FreeParameter::compression_limits},
                                                  {"contact friction", FreeParameter::contact_friction}};

// Any other number of the scene that a search may change: "Contact/Rolling friction: 0.01 ... 0.5". Beyond
// parameter_count these follow in their order.
struct FreedEntry {
  std::string path;                                          // "" of none
  std::string from, to;                                      // as they stand in the scene
  double low = not_given, high = not_given, own = not_given; // SI, in the entry's unit
  std::string unit;                                          // SI
};
constexpr std::size_t most_freed = 8;

struct Calibrate { // platen-calibrate
  CalibrateMode mode = CalibrateMode::search;
  // Wanted of the specimen; each may be left out.
  double young_modulus = not_given, poisson_ratio = not_given;           // Pa, 1
  double compressive_strength = not_given, tensile_strength = not_given; // Pa
  double triaxial_strength = not_given, confining_pressure = not_given;  // Pa, largest axial stress at it
  std::array<Target, most_targets> lines;                                // "Target 1" ...
  std::array<std::string, most_curves> curves;                           // files
  std::vector<Target> targets;                                           // all of the above
  std::array<FreedEntry, most_freed> entries; // "Parameter 1" ...; those that are set, once it is read
  std::vector<FreedEntry> freed;
  std::vector<FreeParameter> free;       // empty: what the targets need
  bool differences = false;              // sensitivities measured one by one before the search
  int seeds = 3, verification_seeds = 5; // packings to calibrate on, and others to judge by
  double strain = 1e-5;                  // of the static solves
  double tension_rate = not_given;       // m/s; tension tests
  int most_trials = 8;                   // sets of parameters that are tried
  double tolerance = 0.02;               // of targets that have none of their own, relative
  // Abacus; each holds the bond's own value where the list is empty.
  std::vector<double> moduli, stiffness_ratios, radius_multipliers, poisson_ratios; // Pa, 1, 1, 1
  // Where the search may go.
  double ratio_low = 0.02, ratio_high = 1;                    // shear over normal stiffness (parallel bond)
  double multiplier_low = 0.3, multiplier_high = 1;           // radius multiplier (cohesive beam)
  double moments_low = 0, moments_high = not_given;           // moment contribution
  double strengths_low = 0.5, strengths_high = 6;             // shear over tensile strength of the bond
  double friction_low = not_given, friction_high = not_given; // rad, friction angle of the bond
  double limits_low = 0.2, limits_high = 5;                   // factor to the compression limits
  double contact_friction_low = 0, contact_friction_high = 1; // of grains

  bool searches_strengths() const {
    return mode == CalibrateMode::search &&
           std::any_of(targets.begin(), targets.end(), [](const Target &t) { return !t.is_elastic(); });
  }
  // Whether sensitivities are measured before the search: where nothing is known of them they have to be.
  bool measures_differences() const {
    return differences || !freed.empty() || std::any_of(targets.begin(), targets.end(), [](const Target &t) {
             return t.kind == TargetKind::other;
           });
  }
};

inline const Calibrate &calibrate_of(const Scene &scene) {
  return scene.own<Calibrate>();
}

// What is asked for: whether it can be measured, and whether it is enough.
void check_calibrate(const SceneCheck &check);

Program calibrate_program();

} // namespace platen::apps
