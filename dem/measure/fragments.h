// Pieces that hold together by intact bonds.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

struct Fragments {
  std::vector<int> of_particle; // fragment number of each row; 0 is the largest by mass, then descending
  std::vector<int> particles;   // count in each fragment
  std::vector<double> mass;     // kg
  int count = 0;                // pieces of at least two particles
  int single = 0;               // particles that are alone
};
Fragments find_fragments(const Particles &particles, const Bonds *bonds);

} // namespace platen::dem
