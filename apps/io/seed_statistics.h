// Mean and scatter of what several seeds gave.
#pragma once

#include <string>
#include <vector>

namespace platen::apps {

// A number that is NaN was not measured and does not count.
class SeedStatistics {
public:
  void add(double value);
  std::size_t count() const { return values_.size(); }
  double mean() const;             // NaN of nothing
  double deviation() const;        // sample standard deviation; NaN of fewer than two
  double root_mean_square() const; // NaN of nothing

private:
  std::vector<double> values_;
};

// "mean +- deviation" in multiples of `unit`, "-" of nothing.
std::string text_of(const SeedStatistics &statistics, double unit);

} // namespace platen::apps
