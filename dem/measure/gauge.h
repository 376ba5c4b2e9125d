// Strain of the middle of a specimen, away from its ends.
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

// 1 for each particle row that ever had a bond, broken ones included; all 1 where there never was any. What
// sits loose between bonded spheres does not follow their strain.
std::vector<char> ever_bonded(const Particles &particles, const Bonds *bonds);

// Best-fit displacement gradient over the particles whose reference centre lies in |z - H/2| < H/4 and that
// were bonded once: least squares of the displacement on the reference position, less noisy than pairs of
// single particles.
class Gauge {
public:
  // The same whenever it is made: from reference positions and the record of all bonds. `bonds` may be null.
  Gauge(const Particles &particles, const Shape &shape, const Bonds *bonds);
  GaugeStrain strain(const Particles &particles) const;
  // Of displacements (m, one per particle row) instead of where the particles are.
  GaugeStrain strain_of(const Particles &particles, const std::vector<Vector3> &displacement) const;
  std::size_t size() const { return rows_.size(); }

private:
  template <class Displacement>
  GaugeStrain fit(const Particles &particles, const Displacement &displacement) const;

  std::vector<int> rows_;
  Vector3 centre_;
  std::array<double, 9> inverse_{}; // of the second moments of the reference positions
};

// Lateral and axial strain the way of Tannu 2017 (32)-(34): in three sections (a quarter, half and three
// quarters of the height) two pairs of outermost particles, along x and along y; the mean of the six
// distances gives the lateral strain. Axial from the topmost and the lowest particle nearest to the axis of
// each end. Loose spheres are passed over as in Gauge.
class ExtremalPairs {
public:
  ExtremalPairs(const Particles &particles, const Shape &shape, const Bonds *bonds);
  double lateral(const Particles &particles) const; // tension positive
  double axial(const Particles &particles) const;   // tension positive

private:
  std::vector<std::array<int, 2>> across_;
  std::array<int, 2> along_{};
};

} // namespace platen::dem
