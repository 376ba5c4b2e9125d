#include "apps/report/moments.h"

#include <cmath>

#include "apps/scene/errors.h"

namespace platen::apps::report {

std::vector<double> axial_stress(const CsvTable &history) {
  const std::vector<double> &top = history.column("axial_stress_top_pa");
  const std::vector<double> &bottom = history.column("axial_stress_bottom_pa");
  std::vector<double> stress(top.size());
  for (std::size_t k = 0; k < stress.size(); ++k)
    stress[k] = 0.5 * (top[k] + bottom[k]);
  return stress;
}

Moments moments_of(const CsvTable &history) {
  const std::vector<double> stress = axial_stress(history);
  const std::vector<double> &time = history.column("time_s");
  Moments moments;
  bool found = false;
  for (std::size_t k = 0; k < stress.size(); ++k)
    if (std::isfinite(stress[k]) && (!found || std::abs(stress[k]) > std::abs(moments.peak_stress))) {
      moments.peak_row = k;
      moments.peak_stress = stress[k];
      found = true;
    }
  if (!found) throw InputError(history.file.string() + ": no sample with an axial stress");
  moments.peak_time = time[moments.peak_row];
  moments.end_time = time.back();

  const double size = std::abs(moments.peak_stress), fallen = post_peak_share * size;
  const double sign = moments.peak_stress < 0 ? -1 : 1;
  for (std::size_t k = moments.peak_row + 1; k < stress.size(); ++k) {
    const double before = sign * stress[k - 1], now = sign * stress[k];
    if (now > fallen || before <= fallen) continue;
    moments.post_peak_time = time[k - 1] + (time[k] - time[k - 1]) * (before - fallen) / (before - now);
    break;
  }
  return moments;
}

} // namespace platen::apps::report
