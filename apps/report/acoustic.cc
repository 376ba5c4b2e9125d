// Events as the report reads and draws them.
#include "apps/report/acoustic.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/report/chart.h"
#include "apps/report/pictures.h"

namespace platen::apps::report {

MagnitudeCount count_of(const Run &run, Stage stage) {
  const std::vector<double> &time = run.events->column("time_s"), &all = run.events->column("magnitude");
  std::vector<double> magnitudes;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool before = time[k] < run.moments.peak_time;
    if (before == (stage == Stage::before_peak) && !std::isnan(all[k])) magnitudes.push_back(all[k]);
  }
  std::sort(magnitudes.begin(), magnitudes.end());
  MagnitudeCount count;
  for (std::size_t k = 0; k < magnitudes.size(); ++k) {
    count.magnitude.push_back(magnitudes[k]);
    count.log_count.push_back(std::log10(static_cast<double>(magnitudes.size() - k)));
  }
  return count;
}

double FittedLine::log_count(double magnitude) const {
  return std::log10(events) - b * (magnitude - limit);
}

FittedLine line_of(const Run &run, Stage stage) {
  FittedLine line;
  const auto acoustic = run.summary.find("acoustic");
  if (acoustic == run.summary.end() || !acoustic->is_object()) return line;
  const std::string start = stage == Stage::before_peak ? "b_before" : "b_after";
  const auto get = [&](const std::string &key, double &to) {
    const auto found = acoustic->find(key);
    if (found == acoustic->end() || !found->is_number()) return false;
    to = found->get<double>();
    return true;
  };
  line.is_there = get(start, line.b) && get(start + "_error", line.error) &&
                  get(start + "_limit", line.limit) && get(start + "_events", line.events);
  return line;
}

void draw_acoustic(const Run &run, const std::filesystem::path &png) {
  Chart chart;
  double low = 0, high = -100; // of all magnitudes
  for (const Stage stage : {Stage::before_peak, Stage::after_peak}) {
    const bool before = stage == Stage::before_peak;
    const MagnitudeCount count = count_of(run, stage);
    if (count.magnitude.empty()) continue;
    low = std::min(low, count.magnitude.front());
    high = std::max(high, count.magnitude.back());
    const Colour colour = before ? colours::blue : colours::vermilion;
    const std::string when = before ? "before the peak" : "after the peak";
    chart.curves.push_back({std::to_string(count.magnitude.size()) + " events " + when, count.magnitude,
                            count.log_count, colour, Stroke::solid, 4});
    const FittedLine line = line_of(run, stage);
    if (!line.is_there) continue;
    char words[64];
    std::snprintf(words, sizeof words, "b = %.2f +- %.2f ", line.b, line.error);
    const double end = line.limit + std::log10(line.events) / line.b; // where one event is left
    chart.curves.push_back({words + when,
                            {line.limit, end},
                            {line.log_count(line.limit), 0},
                            colours::black,
                            before ? Stroke::solid : Stroke::dashed,
                            3});
    high = std::max(high, end);
  }
  chart.x_range = {std::floor(2 * low) / 2, std::ceil(2 * high) / 2};
  chart.x_title = "Magnitude M";
  chart.y_title = "log10 of events of M and more";
  save_charts(run.title, "Acoustic events by magnitude; black: the fitted b-values", {chart}, {800}, png);
}

} // namespace platen::apps::report
