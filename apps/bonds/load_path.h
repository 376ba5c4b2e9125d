// The path that a bond test follows: up, and back where it is cyclic, in steps that grow small before a bond
// breaks.
#pragma once

#include <vector>

#include "apps/bonds/bond_rig.h"
#include "apps/bonds/pair_section.h"

namespace platen::apps {

// Turning points over the largest load, tension positive: {1}; {-1}; {.5, 0, -.5, 0, 1} for a cycle of two
// spheres, {-.5, 0, -1} for one of three, which only stand on their plate.
std::vector<double> turning_points(const PairTest &test);

struct PathResult {
  std::vector<RigReading> rows; // at rest, at every load step and on both sides of a break
  RigReading largest;           // intact, at the largest load (by magnitude)
  double break_load = 0;        // N or N m, last load that was held before the first break; NaN without one
};

// Goes the scene's path with a rig that has not been used. Steps are `Pair test/Steps` of equal length in
// all; in between, as many more as bring the load within 2e-4 of the strength before a bond breaks.
PathResult follow_path(BondRig &rig, const Scene &scene);

} // namespace platen::apps
