// Which soft spheres may touch soon: for every sphere all its partners, in groups that the kernels read
// (dem/kernels/soft_kernel.h). Lengths in mean radii.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_vector.h"
#include "base/vector3.h"
#include "dem/kernels/soft_kernel.h"

namespace platen::dem {

// A sphere, an image of one, or one that stands still.
struct SoftBall {
  Vector3 centre;
  double radius = 0;
  double reach = 0; // how far it may go while the lists hold
  int row = 0;      // whose way it goes
};

// Lists of one block of rows; their memory is used again.
struct SoftPartners {
  std::vector<int> row, steps;
  AlignedVector<unsigned> partner;
  AlignedVector<float> apart;

  kernels::SoftLists lists() const {
    return {steps.size(), row.data(), steps.data(), partner.data(), apart.data()};
  }
};

// For the first `own` balls, which are the rows of that number, every other ball whose gap both together may
// cross. Spheres with as many partners share groups.
void find_soft_partners(const std::vector<SoftBall> &balls, std::size_t own,
                        std::vector<SoftPartners> &blocks);

} // namespace platen::dem
