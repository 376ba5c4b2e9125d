// Runs of a study of a target: logarithms of the figure by packing and by speed.
#pragma once

#include <cstddef>
#include <map>
#include <vector>

namespace platen::apps {

constexpr std::size_t most_speeds = 8; // of a plan

// Bit k: a run at speed k.
using SpeedSet = unsigned;

// Packings by the speeds at which they are run.
using Design = std::map<SpeedSet, double>;

// How many runs, at how many speeds, and how many packings have more than one.
struct DesignCounts {
  double runs = 0, speeds = 0, repeated = 0;
};
DesignCounts counts_of(const Design &design);

// NaN: no run, or one without the figure.
struct TargetRuns {
  std::vector<double> transits; // N of each speed
  std::vector<std::vector<double>> logs;

  SpeedSet speeds_of(std::size_t packing) const;
  Design design() const;
};

} // namespace platen::apps
