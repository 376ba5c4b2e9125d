// Strengths of bonds for wanted strengths of a specimen.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "apps/calibrate/trial.h"
#include "base/pi.h"

namespace platen::apps {

constexpr double degree = pi / 180; // rad

// Whether the scene wants such a number.
inline bool wanted(double value) {
  return !std::isnan(value);
}

// Of a specimen, means over the seeds; NaN where none was asked for or no run came to a peak.
struct Strengths {
  double compressive = not_given, tensile = not_given, triaxial = not_given; // Pa
};
// Tells what bonds give; `trial` counts from one.
using StrengthTest = std::function<Strengths(const BondChoice &choice, int trial)>;

struct FoundStrengths {
  BondChoice choice;
  int trials = 0;
  std::vector<std::string> missed; // what could not be reached, one line
};

// Which of the bond's own numbers the search may change, the tensile strength always.
struct StrengthParameters {
  bool shear = false, moments = false, friction = false; // ratio to the tensile strength, contribution, angle
  double friction_low = 0, friction_high = 0;            // rad
};
StrengthParameters strength_parameters(const Scene &scene);

// Parameters are the logarithms of the bond's tensile strength and of the shear strength over it, its moment
// contribution and its friction angle, as far as what is wanted needs them; responses the logarithms of
// measured over wanted strengths. Ends within Calibrate/Tolerance, after Calibrate/Most trials or where the
// bounds allow nothing better. Throws NumericsError where no runs come to a peak.
FoundStrengths search_strengths(const Scene &scene, const BondChoice &start, const StrengthTest &test);

} // namespace platen::apps
