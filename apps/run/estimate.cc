#include "apps/run/estimate.h"
#include "base/clock.h"

#include <fmt/format.h>

#include "apps/output/machine.h"
#include "apps/output/progress.h"

namespace platen::apps {
namespace {

// Enough to see beyond the clock and cold caches, short enough not to be noticed.
constexpr double trial_seconds = 0.3;
constexpr long warm_up = 3, most_trials = 1000, at_a_time = 8;

} // namespace

std::string cost_estimate(coupling::PlatenTest &problem, double steps) {
  long trials = 0;
  double seconds = 0;
  try {
    for (long k = 0; k < warm_up; ++k)
      problem.step();
    const Clock::time_point start = Clock::now();
    for (; trials < most_trials && seconds < trial_seconds; seconds = seconds_since(start))
      trials += problem.advance(at_a_time);
  } catch (const coupling::NumericsStopped &e) {
    return fmt::format("  estimate: none, it stops within the first steps: {}\n", e.what());
  }
  const double step = seconds / static_cast<double>(trials);
  return fmt::format(
      "  estimate: {} or more ({:.3g} ms a step, measured on the first {}), memory {:.0f} MB\n",
      duration_text(step * steps), 1e3 * step, trials, 1e-6 * static_cast<double>(peak_memory_bytes()));
}

} // namespace platen::apps
