// A measure of one's own: where along the axis bonds have broken, as the mean height of the cracks over the
// height of the specimen. A measure is a free function of what it reads.
#pragma once

#include <cmath>
#include <limits>

#include <dem/bonds.h>
#include <dem/measure/damage.h>
#include <dem/packing/specimen.h>

// 0 at the lower end, 1 at the upper; NaN where no bond has broken.
inline double mean_crack_height(const platen::dem::Particles &particles, const platen::dem::Bonds &bonds,
                                const platen::dem::Shape &shape) {
  double sum = 0;
  int broken = 0;
  for (std::size_t k = 0; k < bonds.initial_count(); ++k) {
    if (!platen::dem::is_broken(bonds.state[k])) continue;
    const auto first = static_cast<std::size_t>(bonds.record_first[k]),
               second = static_cast<std::size_t>(bonds.record_second[k]);
    sum += 0.5 * (particles.reference_position[first].z + particles.reference_position[second].z);
    ++broken;
  }
  return broken == 0 ? std::numeric_limits<double>::quiet_NaN() : sum / broken / shape.height;
}
