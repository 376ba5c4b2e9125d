// Possible partners of every soft sphere in the near future, in groups that the kernels read
// (dem/kernels/soft_kernel.h). Lengths in mean radii.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_vector.h"
#include "base/vector3.h"
#include "dem/kernels/soft_kernel.h"

namespace platen::dem {

// A sphere, an image of one, or a fixed sphere.
struct SoftBall {
  Vector3 centre;
  double radius = 0;
  double reach = 0; // largest displacement while the lists are valid
  int row = 0;      // row whose displacement it follows
};

// Lists of one block of rows; their memory is reused.
struct SoftPartners {
  std::vector<int> row, steps;
  AlignedVector<unsigned> partner;
  AlignedVector<float> separation;

  kernels::SoftLists lists() const {
    return {steps.size(), row.data(), steps.data(), partner.data(), separation.data()};
  }
};

// For each of the first `own` balls, which are the rows of that number: every other ball whose gap the two
// may close. Spheres with equally many partners are in the same groups.
void find_soft_partners(const std::vector<SoftBall> &balls, std::size_t own,
                        std::vector<SoftPartners> &blocks);

} // namespace platen::dem
