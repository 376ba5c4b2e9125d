// Which way the cracks of a run face, as bars.
#include <cstdio>

#include "apps/report/bars.h"
#include "apps/report/pictures.h"

namespace platen::apps::report {

bool tells_rose(const Run &run) {
  const auto rose = run.summary.find("crack_rose");
  return rose != run.summary.end() && rose->is_array() && !rose->empty() && rose->front().is_number();
}

void draw_crack_rose(const Run &run, const std::filesystem::path &png) {
  const nlohmann::json &rose = run.summary["crack_rose"];
  const double step = 90.0 / static_cast<double>(rose.size());
  std::vector<Bar> bars;
  for (std::size_t k = 0; k < rose.size(); ++k) {
    char name[64], words[64];
    std::snprintf(name, sizeof name, "%.0f to %.0f\xC2\xB0", step * static_cast<double>(k),
                  step * static_cast<double>(k + 1));
    std::snprintf(words, sizeof words, "%.2f", rose[k].get<double>());
    const char *which = k == 0 ? "   across" : k + 1 == rose.size() ? "   along" : "";
    bars.push_back({name, std::string(words) + which, rose[k].get<double>(), colours::vermilion});
  }
  save_bars(run.title, "Area of cracks by angle of normal to axis; line: all ways alike", bars, 1, png);
}

} // namespace platen::apps::report
