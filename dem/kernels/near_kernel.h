// Kernel of the search for partners of soft spheres (dem/packing/soft_partners.h): finds the balls of some
// cells that are near a given ball. One source, compiled once per instruction set (near_kernel.inc.h), all
// with the same result.
#pragma once

#include <cstddef>

namespace platen::dem::kernels {

// Balls in the order of their cells. All columns have `near_spare` more values, which are read but not used.
constexpr std::size_t near_spare = 8;
struct NearColumns {
  const float *x, *y, *z, *reach;
  const int *ball; // number of each
};

struct NearBall {
  float x, y, z, reach;
  int ball;
};

// Writes to `found`, in order, the number of every ball of members [first, last) except `own` whose distance
// is below the sum of both reaches. Returns how many there are; `near_spare` places after them may be
// overwritten.
std::size_t find_near_baseline(const NearColumns &, const NearBall &own, int first, int last, int *found);
std::size_t find_near_avx2(const NearColumns &, const NearBall &own, int first, int last, int *found);
std::size_t find_near_avx512(const NearColumns &, const NearBall &own, int first, int last, int *found);
using FindNear = std::size_t (*)(const NearColumns &, const NearBall &, int, int, int *);

} // namespace platen::dem::kernels
