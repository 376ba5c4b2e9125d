// Readings of instruments on a specimen: strain of its middle, opening of a disc, deflection of a bar,
// opening of a notch.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

struct GaugeStrain {
  double axial = 0, lateral_x = 0, lateral_y = 0; // tension positive
  double lateral() const { return 0.5 * (lateral_x + lateral_y); }
};

// 1 for each particle row that ever had a bond, broken ones included; all 1 if there never was a bond. Loose
// spheres between bonded ones do not follow their strain.
std::vector<char> ever_bonded(const Particles &particles, const Bonds *bonds);

// Best-fit displacement gradient over the particles with reference centre in |z - H/2| < H/4 that ever had a
// bond: least squares of the displacement on the reference position, less noisy than pairs of single
// particles.
class Gauge {
public:
  // Gives the same object at any time: uses reference positions and the record of all bonds (may be null).
  Gauge(const Particles &particles, const Shape &shape, const Bonds *bonds);
  GaugeStrain strain(const Particles &particles) const;
  // For given displacements (m, one per particle row) instead of the present positions.
  GaugeStrain strain_of(const Particles &particles, const std::vector<Vector3> &displacement) const;
  std::size_t size() const { return rows_.size(); }

private:
  template <class Displacement>
  GaugeStrain fit(const Particles &particles, const Displacement &displacement) const;

  std::vector<int> rows_;
  Vector3 centre_;
  std::array<double, 9> inverse_{}; // of the second moments of the reference positions
};

// Lateral and axial strain of Tannu 2017 (32)-(34): in three sections (a quarter, half and three quarters of
// the height) two pairs of outermost particles, along x and along y; the mean of the six distances gives the
// lateral strain. The axial strain is that between the topmost and the lowest particle nearest to the axis at
// each end. Loose spheres are skipped as in Gauge.
class ExtremalPairs {
public:
  ExtremalPairs(const Particles &particles, const Shape &shape, const Bonds *bonds);
  double lateral(const Particles &particles) const; // tension positive
  double axial(const Particles &particles) const;   // tension positive

private:
  std::vector<std::array<int, 2>> across_;
  std::array<int, 2> along_{};
};

// Increase of the width across the loaded diameter: mean displacement along x of the spheres of the right rim
// (reference x > 0.7 R, within R/4 of the centre's height) minus that of the left rim, m; NaN if a rim has
// none.
class DiscOpening {
public:
  DiscOpening(const Particles &particles, const Shape &shape);
  double operator()(const Particles &particles) const;

private:
  std::vector<int> left_, right_;
};

// A beam of rectangular section on two supports, loaded in the middle of the span.
struct ThreePoints {
  double span = 0;    // m, L
  double breadth = 0; // m, b, along y
  double depth = 0;   // m, d, along the load
  double notch = 0;   // m, a_0, depth of a notch below the middle

  // m^2; the load divided by it is the flexural stress of a slender elastic beam, 3 P L / (2 b d^2).
  double nominal_area() const { return 2 * breadth * depth * depth / (3 * span); }
  // The same of the ligament above the notch, of depth h = d - a_0: 3 P L / (2 b h^2) (EN 14651).
  double net_area() const { return 2 * breadth * ligament() * ligament() / (3 * span); }
  double ligament() const { return depth - notch; }             // m, h
  double ligament_area() const { return breadth * ligament(); } // m^2
  // Deflection by shear over that by bending, Timoshenko's beam with the shear factor of Cowper (1966),
  // 10 (1 + nu) / (12 + 11 nu).
  double shear_fraction(double poisson_ratio) const {
    return depth * depth / (span * span) * (12 + 11 * poisson_ratio) / 5;
  }
  // Deflection at mid-span under a flexural stress (Pa) of a beam with Young's modulus E (Pa), m: sigma L^2 /
  // (6 E d), plus the part by shear.
  double deflection(double stress, double young_modulus, double poisson_ratio) const {
    return stress * span * span / (6 * young_modulus * depth) * (1 + shear_fraction(poisson_ratio));
  }
};

// Deflection at mid-span: mean displacement along -z of the spheres at mid-span minus that of the spheres
// above the two supports (mean of both sides), m. All lie at half the depth, so that crushing at the load
// lines has no effect. Each of the three windows is as wide as a quarter of the depth, or as four mean radii
// if that is more; along x the outer ones are no wider than the bar beyond the support.
class Deflection {
public:
  // Throws std::invalid_argument if a window contains no sphere.
  Deflection(const Particles &particles, const Shape &shape, double span);
  double operator()(const Particles &particles) const;

private:
  std::vector<int> left_, middle_, right_;
};

// Crack mouth opening displacement (CMOD), as a clip gauge across the mouth of a notch measures it: mean
// displacement along x of the spheres on its right minus that of those on its left, m, positive where it
// opens. They lie within two mean radii of the wall of the notch and of the lower face (z = 0), thus
// measure a little above the mouth, and had a bond.
class MouthOpening {
public:
  // Gives the same object at any time of the run, as Gauge. `bonds` may be null. Throws std::invalid_argument
  // if the notch is shallower than that, or if there is no such sphere on a side.
  MouthOpening(const Particles &particles, const Notch &notch, const Bonds *bonds);
  double operator()(const Particles &particles) const;
  std::vector<int> rows() const; // ascending

private:
  std::vector<int> left_, right_;
};

} // namespace platen::dem
