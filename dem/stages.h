// Named stages of a step and the seconds that each has taken.
#pragma once

#include <array>

#include "base/clock.h"

namespace platen::dem {

enum class Stage { motion, search, bonds, contacts, surfaces, bodies, stable_step, measures, output };
constexpr int stage_count = 9;
constexpr std::array<const char *, stage_count> stage_names{
    "motion", "search", "bonds", "contacts", "surfaces", "bodies", "stable_step", "measures", "output"};

class StageClock {
public:
  // Measures the time from construction to destruction.
  class Lap {
  public:
    Lap(StageClock &clock, Stage stage) : clock_(clock), stage_(stage) {}
    ~Lap() { clock_.seconds_[static_cast<int>(stage_)] += seconds_since(start_); }
    Lap(const Lap &) = delete;
    Lap &operator=(const Lap &) = delete;

  private:
    StageClock &clock_;
    Stage stage_;
    Clock::time_point start_ = Clock::now();
  };
  double seconds(Stage stage) const { return seconds_[static_cast<int>(stage)]; }

private:
  std::array<double, stage_count> seconds_{};
};

} // namespace platen::dem
