// The section Calibrate: what platen-calibrate looks for, and what it may change.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "apps/scene/program.h"
#include "apps/scene/scene.h"
#include "apps/scene/surfaces.h"
#include "base/describe.h"

namespace platen::apps {

enum class CalibrateMode { bounds, abacus, search };
inline const Words<CalibrateMode> calibrate_modes{
    {"bounds", CalibrateMode::bounds}, {"abacus", CalibrateMode::abacus}, {"search", CalibrateMode::search}};

// What a calibration may change, in the order of its tables.
enum class Knob {
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
constexpr std::size_t knob_count = 10;
// Those that a search may free, as Calibrate/Free names them.
inline const Words<Knob> free_knobs{{"modulus", Knob::modulus},
                                    {"stiffness ratio", Knob::stiffness_ratio},
                                    {"radius multiplier", Knob::radius_multiplier},
                                    {"tensile strength", Knob::tensile_strength},
                                    {"shear strength", Knob::shear_strength},
                                    {"moment contribution", Knob::moment_contribution},
                                    {"friction angle", Knob::friction_angle},
                                    {"compression limits", Knob::compression_limits},
                                    {"contact friction", Knob::contact_friction}};

enum class TargetKind {
  none,
  young_modulus,
  poisson_ratio,
  strength,
  strain_at_peak,
  tension,
  splitting,
  strength_at_pressure,
  gain_by_friction,
  cube_over_prism,
  slenderness,  // strength of a short specimen over that of one of 2
  secant_ratio, // Poisson's ratio to 40 % of the strength
  curve
};
inline const Words<TargetKind> target_kinds{{"none", TargetKind::none},
                                            {"young modulus", TargetKind::young_modulus},
                                            {"poisson ratio", TargetKind::poisson_ratio},
                                            {"strength", TargetKind::strength},
                                            {"strain at peak", TargetKind::strain_at_peak},
                                            {"tension", TargetKind::tension},
                                            {"splitting", TargetKind::splitting},
                                            {"strength at pressure", TargetKind::strength_at_pressure},
                                            {"gain by friction", TargetKind::gain_by_friction},
                                            {"cube over prism", TargetKind::cube_over_prism},
                                            {"slenderness", TargetKind::slenderness},
                                            {"secant ratio", TargetKind::secant_ratio},
                                            {"curve", TargetKind::curve}};

enum class TargetForm { scene, cylinder, box };

constexpr std::size_t most_targets = 20;

// One of "Calibrate/Target 1" ... as it is read.
struct TargetSection {
  TargetKind kind = TargetKind::none;
  std::string value, file;
  double weight = 1, tolerance = not_given; // 1, relative; not given: Calibrate/Tolerance
  double pressure = not_given;              // Pa
  ConfinementKind cell = ConfinementKind::particles;
  TargetForm form = TargetForm::scene;
  double slenderness = not_given;                   // height over width
  std::vector<StudySurface> platens, other_platens; // one or none
  double rate = not_given, strain = not_given;      // m/s, 1
};

// What is wanted, in SI: of a section "Target", or of a key of Calibrate.
struct Target {
  TargetKind kind = TargetKind::strength;
  double value = not_given;                      // of a curve: not given
  double weight = 1, tolerance = 0.02;           // relative; of a curve: root mean square over its peak
  double pressure = not_given;                   // Pa
  bool sleeve = false, box = false;              // the pressure's, and the specimen instead of the scene's
  double slenderness = not_given;                // the scene's where not given
  double friction = not_given;                   // of the platens; not given: as the scene has them
  double other_friction = 0;                     // that a gain by friction is over
  double rate = not_given, strain = not_given;   // m/s, 1: speed and largest strain of its tests
  std::string file;                              // of a curve; resolved
  std::string entry = "Calibrate/Target 1/Kind"; // where its faults are told

  // Static solves tell it; all others need platens that move.
  bool is_elastic() const { return kind == TargetKind::young_modulus || kind == TargetKind::poisson_ratio; }
};

struct Calibrate { // platen-calibrate
  CalibrateMode mode = CalibrateMode::search;
  // Wanted of the specimen; each may be left out.
  double young_modulus = not_given, poisson_ratio = not_given;           // Pa, 1
  double compressive_strength = not_given, tensile_strength = not_given; // Pa
  double triaxial_strength = not_given, confining_pressure = not_given;  // Pa, largest axial stress at it
  std::array<TargetSection, most_targets> target_sections;
  std::vector<Target> targets;           // all of the above
  std::vector<Knob> free;                // empty: what the targets need
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
};

inline const Calibrate &calibrate_of(const Scene &scene) {
  return scene.own<Calibrate>();
}

// What is asked for: whether it can be measured, and whether it is enough.
void check_calibrate(const SceneCheck &check);

Program calibrate_program();

} // namespace platen::apps
