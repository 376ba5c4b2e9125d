// Studies that are made up: figures drawn from the law that is meant to be found.
#pragma once

#include <cmath>
#include <random>

#include "apps/study/target_plan.h"

namespace platen::apps::testing {

struct MadeUpFigure {
  double mean = std::log(40.0); // of the logarithm, slow loading
  double haste = 1.2;           // times (1 / N)^order
  double order = 1;
  double packing = 0.02, chaos = 0.015; // deviations
  // Relative excess at so many crossings; a law of another order has the same at 15.
  double excess(double transits) const { return haste / 15 * std::pow(15 / transits, order); }
};

// Draws what is asked for beyond what has been made, packing by packing.
class MadeUpRuns {
public:
  MadeUpRuns(const MadeUpFigure &figure, unsigned seed) : figure_(figure), random_(seed) {}
  void make(TargetState &state, const Counts &counts) {
    const std::size_t speeds = counts.size();
    for (std::size_t k = 0; k < speeds; ++k)
      for (std::size_t s = state.made[k]; s < counts[k]; ++s) {
        while (state.runs.logs.size() <= s) {
          state.runs.logs.emplace_back(speeds, std::nan(""));
          packings_.push_back(figure_.packing * normal_(random_));
        }
        state.runs.logs[s][k] = figure_.mean + std::log1p(figure_.excess(state.runs.transits[k])) +
                                packings_[s] + figure_.chaos * normal_(random_);
      }
    state.made = counts;
  }
  void begin(TargetState &state, const std::vector<double> &transits) {
    state = {};
    state.runs.transits = transits;
    state.made = Counts(transits.size(), 0);
    packings_.clear();
  }

private:
  MadeUpFigure figure_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<double> packings_;
};

// Runs of a figure as drawn; the seed tells one draw from another.
inline TargetState drawn_state(const MadeUpFigure &figure, const std::vector<double> &transits,
                               const Counts &counts, unsigned seed = 1) {
  MadeUpRuns drawn(figure, seed);
  TargetState state;
  drawn.begin(state, transits);
  drawn.make(state, counts);
  return state;
}

// Analysis of variance of packings that are all run at two speeds of several: n - 1 degrees each, of chaos
// and of chaos / 2 + packing.
struct Analysis {
  double fast = 0, slow = 0; // means
  Spread spread;

  Analysis(const TargetRuns &runs, std::size_t at_fast, std::size_t at_slow) {
    const double n = static_cast<double>(runs.logs.size());
    double between = 0, within = 0;
    for (const std::vector<double> &y : runs.logs)
      fast += y[at_fast] / n, slow += y[at_slow] / n;
    for (const std::vector<double> &y : runs.logs) {
      between += std::pow((y[at_fast] + y[at_slow] - fast - slow) / 2, 2);
      within += std::pow(y[at_fast] - y[at_slow] - fast + slow, 2) / 2;
    }
    spread.chaos = within / (n - 1), spread.packing = between / (n - 1) - spread.chaos / 2;
  }
};

// Steps of the concrete cylinder of 5 018 spheres (docs/accuracy.md), in multiples of its spheres.
inline TargetCosts costs_of_cylinder(const std::vector<double> &transits) {
  TargetCosts costs;
  for (const double n : transits)
    costs.runs.push_back(1400 + 285 * n);
  costs.packing = 6000;
  return costs;
}

} // namespace platen::apps::testing
