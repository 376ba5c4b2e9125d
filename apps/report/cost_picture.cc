// Where the seconds of a run went, as bars.
#include <cstdio>

#include "apps/report/bars.h"
#include "apps/report/costs.h"
#include "apps/report/pictures.h"

namespace platen::apps::report {

void draw_costs(const Run &run, const std::filesystem::path &png) {
  const std::vector<Cost> costs = costs_of(run);
  double whole = 0;
  for (const Cost &cost : costs)
    whole += cost.seconds;
  std::vector<Bar> bars;
  char text[96];
  for (const Cost &cost : costs) {
    std::snprintf(text, sizeof text, "%.2f s   %.1f %%", cost.seconds, 100 * cost.seconds / whole);
    bars.push_back({cost.name, text, cost.seconds, cost.is_stage ? colours::blue : colours::grey});
  }
  std::snprintf(text, sizeof text, "Where %.1f seconds went; blue: stages of the steps", whole);
  save_bars(run.title, text, bars, 0, png);
}

} // namespace platen::apps::report
