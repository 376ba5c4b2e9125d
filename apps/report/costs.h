// What a run cost, as its summary says.
#pragma once

#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

struct Cost {
  std::string name;
  double seconds = 0;
  bool is_stage = true; // of the steps; else setting up, and what no clock saw
};

// The largest first; the rest of the wall clock last. Empty where the summary has no stage_seconds.
std::vector<Cost> costs_of(const Run &run);

// "2.63 million sphere steps a second, 1 thread, Intel ..., 190 MB at most"; what is not known is left out.
std::string machine_words(const Run &run);

} // namespace platen::apps::report
