// The path that a bond test follows: up, and back where it is cyclic, in steps that grow small before a bond
// breaks.
#pragma once

#include <vector>

#include "apps/bonds/bond_run.h"

namespace platen::apps {

// A straight part of a path, in equal steps.
struct Leg {
  double from = 0, to = 0;
  int steps = 1;
};
// From 0 by these turns, in so many steps in all, at least one in each leg.
std::vector<Leg> legs_of(const std::vector<double> &turns, int steps);

// Displacements (m) at which a prescribed path turns, the last one its end.
std::vector<double> turning_displacements(const PairTest &test);

// Goes the scene's path with a rig, at rest at every load step and on both sides of a break. Steps are
// `Pair test/Steps` of equal length in all; in between, as many more as bring the load within 2e-4 of the
// strength before a bond breaks.
BondRun follow_path(const Scene &scene);

} // namespace platen::apps
