// Which soft spheres may touch soon: for every sphere all its partners, in packs that the kernels read
// (dem/kernels/soft_kernel.h). Lengths in mean radii.
#pragma once

#include <cstddef>
#include <vector>

#include "dem/kernels/soft_kernel.h"

namespace platen::dem {

// Balls as the lists see them: [0, own) have partners; images of them begin at `first_image`. The ball just
// before these touches none and fills lanes up.
struct SoftBalls {
  const kernels::Ball *ball = nullptr;
  std::size_t own = 0, first_image = 0, all = 0;
  const int *owner = nullptr;    // of each image
  const double *reach = nullptr; // how far each own one may go while the lists hold
};

struct SoftPartners {
  std::vector<int> partner;
  std::vector<std::size_t> first; // a pack each, and the end
  std::vector<double> earlier;    // a sphere each

  // Every pair whose gap both together may cross. Partners of a sphere stand in the order of their number,
  // images in the place of their owner; a pair belongs to the sphere with the smaller number.
  void build(const SoftBalls &balls);
};

} // namespace platen::dem
