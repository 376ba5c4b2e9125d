// One answer of a packing to one choice of bonds: moduli by static solves, strengths by short explicit runs.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/choice.h"
#include "apps/calibrate/trial_specimen.h"
#include "dem/measure/bond_network.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

struct TrialResult {
  std::string status = "done"; // or why there is no number
  double young_modulus = not_given, platen_modulus = not_given, poisson_ratio = not_given; // Pa, Pa, 1
  double strength = not_given, strain_at_peak = not_given;                                 // Pa, 1
  std::vector<double> curve; // Pa, where the test keeps them; 0 after it has lost all strength
  bool good() const { return status == "done"; }
  // It was not quasi-static: what it bore is not the specimen's strength, and does not count.
  bool too_fast() const { return status.rfind(too_fast_words, 0) == 0; }
  static constexpr const char *too_fast_words = "too fast to be quasi-static";
};

// The specimen as this test presses it.
dem::Specimen placed(const dem::Specimen &specimen, const SpecimenTest &test);

// Elastic: moduli of the middle half, between the platens of the scene, at Calibrate/Strain. Others: to four
// fifths of the peak, or the last strain of the curve that is kept: compression between platens, tension
// between glued ends, splitting between strips, under pressure counted from where it stands on all sides. A
// peak counts as in platen-compress (judge_peak): a fall by 2 %, or a plateau. One that was too fast by the
// bounds of platen-compress (apps/run/quasi_static.h) has no result but its status. The strength is the
// largest mean of both platens' stresses, the pressure included. Moduli are secants at 40 % of what the
// platens add. Throws Stopped after a signal.
TrialResult run_test(const Scene &scene, const dem::Specimen &specimen, const Choice &choice,
                     const SpecimenTest &test);
// Without a solve.
dem::NetworkModuli bounds_of(const Scene &scene, const dem::Specimen &specimen, const Choice &choice);

} // namespace platen::apps
