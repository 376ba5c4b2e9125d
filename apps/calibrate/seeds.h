// Which packings a calibration is made on, and which it is judged by.
#pragma once

#include <vector>

#include "apps/scene/scene.h"

namespace platen::apps {

inline std::vector<unsigned long> seeds_from(unsigned long first, int count) {
  std::vector<unsigned long> seeds;
  for (int k = 0; k < count; ++k)
    seeds.push_back(first + static_cast<unsigned long>(k));
  return seeds;
}
inline std::vector<unsigned long> training_seeds(const Scene &s) {
  return seeds_from(s.general.seed, s.calibrate.seeds);
}
inline std::vector<unsigned long> unseen_seeds(const Scene &s) {
  return seeds_from(s.general.seed + static_cast<unsigned long>(s.calibrate.seeds),
                    s.calibrate.verification_seeds);
}

} // namespace platen::apps
