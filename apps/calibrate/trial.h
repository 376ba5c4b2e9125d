// One answer of a packing to one choice of bonds: moduli by static solves, strengths by short explicit runs.
#pragma once

#include <string>

#include "apps/scene/scene.h"
#include "dem/measure/bond_network.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

struct BondChoice {
  double modulus = 0, stiffness_ratio = 0, radius_multiplier = 1, poisson_ratio = 0; // Pa, 1, 1, 1
  double tensile_strength = 0, shear_strength = 0;                                   // Pa
  double moment_contribution = 1;
  double friction_angle = 0; // rad
};
BondChoice choice_of(const Scene &scene);

enum class TrialKind { elastic, compression, tension, triaxial };
const char *word(TrialKind kind);

struct TrialResult {
  std::string status = "done"; // or why there is no number
  double young_modulus = not_given, platen_modulus = not_given, poisson_ratio = not_given; // Pa, Pa, 1
  double strength = not_given, strain_at_peak = not_given;                                 // Pa, 1
  bool good() const { return status == "done"; }
};

// Of the middle half, between the platens of the scene, at Calibrate/Strain.
TrialResult elastic_trial(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice);
// To four fifths of the peak, at the rate of the scene: compression as the scene has its platens, tension
// between glued ends, triaxial at Calibrate/Confining pressure on the skin (strains and stresses counted from
// where it stands on all sides; a peak that holds to the largest strain counts too). The strength is the
// largest mean of both platens' stresses, the pressure included. Moduli are secants at 40 % of what the
// platens add.
TrialResult strength_trial(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice,
                           TrialKind kind);
// Without a solve.
dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen, const BondChoice &choice);

} // namespace platen::apps
