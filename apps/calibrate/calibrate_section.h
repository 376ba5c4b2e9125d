// The section Calibrate: what platen-calibrate looks for, and what it may change.
#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "apps/calibrate/target.h"
#include "apps/scene/program.h"
#include "apps/scene/scene.h"
#include "base/describe.h"

namespace platen::apps {

template <class Value>
bool holds(const std::vector<Value> &all, const Value &one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

enum class CalibrateMode { bounds, abacus, search };
inline const Words<CalibrateMode> calibrate_modes{
    {"bounds", CalibrateMode::bounds}, {"abacus", CalibrateMode::abacus}, {"search", CalibrateMode::search}};

// What a calibration may change, in the order of its tables (choice.h says what is known of each).
enum class FreeParameter {
  modulus,
  stiffness_ratio,
  radius_multiplier,
  poisson_ratio, // of beams; abacus alone
  tensile_strength,
  shear_strength, // that over the tensile one is what is bounded
  moment_contribution,
  friction_angle,
  compression_limits, // one factor to all of the scene's
  contact_friction
};
constexpr std::size_t parameter_count = 10;

struct Bounds {
  double low = not_given, high = not_given; // SI
};

// Any other number of the scene that a search may change: "Contact/Rolling friction: 0.01 ... 0.5". Beyond
// parameter_count these follow in their order.
struct FreedEntry {
  std::string path;       // "" of none
  std::string from, to;   // as they stand in the scene
  Bounds bounds;          // in the entry's unit
  double own = not_given; // of the scene
  std::string unit;       // SI
};
constexpr std::size_t most_freed = 8;

struct Calibrate { // platen-calibrate
  CalibrateMode mode = CalibrateMode::search;
  std::array<Target, most_targets> lines;      // "Target 1" ...
  std::array<std::string, most_curves> curves; // files
  std::vector<Target> targets;                 // the lines that are set, once all is read
  std::array<FreedEntry, most_freed> entries;  // "Parameter 1" ...
  std::vector<FreedEntry> freed;               // those of them that are set
  std::vector<FreeParameter> free;             // empty: what the targets need
  bool differences = false;                    // sensitivities measured one by one before the search
  int seeds = 3, verification_seeds = 5;       // packings to calibrate on, and others to judge by
  double strain = 1e-5;                        // of the static solves
  double tension_rate = not_given;             // m/s; tension tests
  int most_trials = 8;                         // sets of parameters that are tried
  double tolerance = 0.02;                     // of targets that have none of their own, relative
  // Where the search may go; NaN: there is no default.
  std::map<FreeParameter, Bounds> bounds{
      {FreeParameter::stiffness_ratio, {0.02, 1}}, {FreeParameter::radius_multiplier, {0.3, 1}},
      {FreeParameter::shear_strength, {0.5, 6}},   {FreeParameter::moment_contribution, {0, not_given}},
      {FreeParameter::friction_angle, {}},         {FreeParameter::compression_limits, {0.2, 5}},
      {FreeParameter::contact_friction, {0, 1}}};
  // Abacus; each holds the bond's own value where the list is empty.
  std::vector<double> moduli, stiffness_ratios, radius_multipliers, poisson_ratios; // Pa, 1, 1, 1

  bool wants(std::initializer_list<TargetKind> any_of_these) const {
    return std::any_of(targets.begin(), targets.end(), [&](const Target &t) {
      return std::find(any_of_these.begin(), any_of_these.end(), t.kind) != any_of_these.end();
    });
  }
  bool wants_strengths() const { // or anything else that static solves do not tell
    return std::any_of(targets.begin(), targets.end(), [](const Target &t) { return !t.is_elastic(); });
  }
  bool searches_strengths() const { return mode == CalibrateMode::search && wants_strengths(); }
  // Whether sensitivities are measured before the search: where nothing is known of them they have to be.
  bool measures_differences() const { return differences || !freed.empty() || wants({TargetKind::other}); }
};

inline const Calibrate &calibrate_of(const Scene &scene) {
  return scene.own<Calibrate>();
}

Program calibrate_program();

} // namespace platen::apps
