// How well a cell's pressure has kept to its stress path.
#pragma once

#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

constexpr double most_off_path = 0.01; // of the pressure

// Of a test whose pressure gains a share of the deviator, up to the peak or to where the path ends.
struct PressurePath {
  // Largest distance from the path, over its pressure there or that which it begins with, the larger; NaN
  // without a path.
  double deviation = not_measured;
  double ended_at_strain =
      not_measured; // of the platens since consolidation, where the pressure came to nothing
};
PressurePath pressure_path(const coupling::PlatenTest &problem, const Results &results);

} // namespace platen::apps
