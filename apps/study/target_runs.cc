#include "apps/study/target_runs.h"

#include <cmath>

namespace platen::apps {

DesignCounts counts_of(const Design &design) {
  DesignCounts counts;
  SpeedSet any = 0;
  for (const auto &[set, packings] : design) {
    if (packings <= 0) continue;
    const int size = __builtin_popcount(set);
    counts.runs += packings * size, any |= set;
    if (size > 1) counts.repeated += packings;
  }
  counts.speeds = __builtin_popcount(any);
  return counts;
}

SpeedSet TargetRuns::speeds_of(std::size_t packing) const {
  SpeedSet set = 0;
  for (std::size_t k = 0; k < transits.size(); ++k)
    if (!std::isnan(logs[packing][k])) set |= 1U << k;
  return set;
}

Design TargetRuns::design() const {
  Design all;
  for (std::size_t s = 0; s < logs.size(); ++s)
    if (const SpeedSet set = speeds_of(s); set != 0) ++all[set];
  return all;
}

} // namespace platen::apps
