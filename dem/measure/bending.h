// How a bar along x bends under three lines of load, and where it breaks.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// A beam of rectangular section on two supports, loaded in the middle of the span.
struct ThreePoints {
  double span = 0;    // m, L
  double breadth = 0; // m, b, along y
  double depth = 0;   // m, d, along the load

  // m^2; the load over it is the flexural stress of a slender elastic beam, 3 P L / (2 b d^2).
  double nominal_area() const { return 2 * breadth * depth * depth / (3 * span); }
  // Deflection by shear over that by bending, Timoshenko's beam with the shear factor of Cowper (1966),
  // 10 (1 + nu) / (12 + 11 nu).
  double shear_share(double poisson_ratio) const {
    return depth * depth / (span * span) * (12 + 11 * poisson_ratio) / 5;
  }
  // Deflection at mid-span under a flexural stress (Pa) of a beam with Young's modulus E (Pa), m:
  // sigma L^2 / (6 E d), and the share of shear.
  double deflection(double stress, double young_modulus, double poisson_ratio) const {
    return stress * span * span / (6 * young_modulus * depth) * (1 + shear_share(poisson_ratio));
  }
};

// Sag of the middle of the span: mean displacement along -z of the spheres at mid-span minus that of the
// spheres above the two supports, the mean of both sides, m. All lie at half the depth, so that what is
// crushed at the lines of load does not enter. A place is a window of a quarter of the depth, or of four mean
// radii where that is more, along x no wider than what of the bar lies beyond the support.
class Deflection {
public:
  // Throws std::invalid_argument where a place holds no sphere.
  Deflection(const Particles &particles, const Shape &shape, double span);
  double operator()(const Particles &particles) const;

private:
  std::vector<int> left_, middle_, right_;
};

// Share of the broken bonds whose reference midpoint lies within half a depth of mid-span; NaN without any.
double broken_near_midspan(const Particles &particles, const Bonds &bonds, double depth);

} // namespace platen::dem
