// How a disc pressed along its vertical diameter opens and splits.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {

// Growth of the width across the loaded diameter: mean displacement along x of the spheres of the right rim
// (reference x > 0.7 R, within R/4 of the centre's height) minus that of the left rim, m; NaN where a rim has
// none.
class DiscOpening {
public:
  DiscOpening(const Particles &particles, const Shape &shape);
  double operator()(const Particles &particles) const;

private:
  std::vector<int> left_, right_;
};

// Where bonds broke, by reference midpoint. Shares of broken bonds, NaN without any. The loaded diameter is
// the band |x| < R/4, its middle half |z - R| < R/2.
struct SplitPattern {
  double on_diameter = 0;     // of all that broke, in the band
  double in_middle = 0;       // of all that broke, in its middle half
  double first_in_middle = 0; // of the first twenty
};
SplitPattern split_pattern(const Particles &particles, const Bonds &bonds, const Shape &shape);

} // namespace platen::dem
