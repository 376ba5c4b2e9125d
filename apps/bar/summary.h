// What platen-bar found, side by side with strength of materials.
#pragma once

#include <string>

#include "apps/bar/run_bar.h"
#include "apps/io/summary.h"

namespace platen::apps {

struct BarCosts {
  int threads = 1;
  double seconds = 0, setup_seconds = 0; // s
};

Json summary_of(const Scene &scene, const BarResults &results, const BarCosts &costs,
                const std::string &status);
// For the screen and the log.
std::string report_of(const BarResults &results);

} // namespace platen::apps
