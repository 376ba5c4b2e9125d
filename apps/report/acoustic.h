// Acoustic events of a run: how many there are of which size.
#pragma once

#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

enum class Stage { before_peak, after_peak };

// log10 of how many events have at least a magnitude: a step down at each event, from the smallest on.
struct MagnitudeCount {
  std::vector<double> magnitude, log_count;
};
// Of the events that began then; those without energy have no magnitude and do not count. The run must have
// events.
MagnitudeCount count_of(const Run &run, Stage stage);

// The line log10 N = log10 n - b (M - limit) that the summary's b-value stands for.
struct FittedLine {
  bool is_there = false; // too few events have none
  double b = 0, error = 0, limit = 0, events = 0;
  double log_count(double magnitude) const;
};
FittedLine line_of(const Run &run, Stage stage);

} // namespace platen::apps::report
