#include "apps/output/seed_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace platen::apps {

void SeedStatistics::add(double value) {
  if (!std::isnan(value)) values_.push_back(value);
}

double SeedStatistics::mean() const {
  return std::accumulate(values_.begin(), values_.end(), 0.0) / static_cast<double>(values_.size());
}

SeedStatistics SeedStatistics::scaled(double factor) const {
  SeedStatistics to;
  for (const double value : values_)
    to.add(factor * value);
  return to;
}

double SeedStatistics::error_of_mean() const {
  return deviation() / std::sqrt(static_cast<double>(count()));
}

double SeedStatistics::deviation() const {
  if (values_.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  double squares = 0;
  const double m = mean();
  for (const double v : values_)
    squares += (v - m) * (v - m);
  return std::sqrt(squares / (static_cast<double>(values_.size()) - 1));
}

double SeedStatistics::root_mean_square() const {
  const double squares = std::inner_product(values_.begin(), values_.end(), values_.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(values_.size()));
}

double SeedStatistics::least() const {
  return values_.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : *std::min_element(values_.begin(), values_.end());
}

double SeedStatistics::largest() const {
  return values_.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : *std::max_element(values_.begin(), values_.end());
}

std::string short_text_of(const SeedStatistics &s, double unit) {
  if (s.count() == 0) return "-";
  if (s.count() == 1) return fmt::format("{:.4g}", s.mean() / unit);
  if (s.count() < fewest_for_deviation)
    return fmt::format("{:.4g} ... {:.4g}", s.least() / unit, s.largest() / unit);
  return fmt::format("{:.4g} +- {:.2g}", s.mean() / unit, s.deviation() / unit);
}

std::string text_of(const SeedStatistics &s, double unit) {
  const std::string text = short_text_of(s, unit);
  if (s.count() == 0 || s.count() >= fewest_for_deviation) return text;
  return text + (s.count() == 1 ? ", 1 packing" : fmt::format(", {} packings", s.count()));
}

} // namespace platen::apps
