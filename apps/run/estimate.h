// What a run will cost, for --dry-run.
#pragma once

#include <string>

#include "coupling/platen_test.h"

namespace platen::apps {

// One line: time for `steps` steps, measured on the first ones, and memory until now. The problem is stepped,
// and not to be used afterwards. Steps with broken bonds take longer, so the time is a lower estimate.
std::string cost_estimate(coupling::PlatenTest &problem, double steps);

} // namespace platen::apps
