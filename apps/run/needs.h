// What a test between platens will need of the machine, counted before anything is made.
#pragma once

#include <string>

#include "apps/scene/scene.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// Throws InputError where the test needs more than the machine's memory, by lower bounds: names the entry of
// what needs most. `shape`: the specimen as the app presses it.
void require_memory(const Scene &scene, const dem::Shape &shape);

// What a run takes, counted as above: spheres, their and all elements' bytes, seconds of wall clock to the
// target strain on two threads; NaN where stages or a stress lead, for then nobody knows how long.
struct CountedCosts {
  double spheres = 0, bytes = 0, seconds = 0;
};
CountedCosts counted_costs(const Scene &scene, const dem::Shape &shape);
// Of a run of the scene; NaN where nothing can be counted: specimens of files, bars that lie, and what its
// run will refuse.
CountedCosts counted_costs(const Scene &scene);

// For a dry run that would have to make more than a share of the memory only to look at it: its estimate from
// the counts alone. "" where it can be made.
std::string counted_estimate(const Scene &scene, const dem::Shape &shape);

} // namespace platen::apps
