// Mean and scatter of what several seeds gave.
#pragma once

#include <string>
#include <vector>

namespace platen::apps {

// A number that is NaN was not measured and does not count.
class SeedStatistics {
public:
  void add(double value);
  SeedStatistics scaled(double factor) const; // of all values times the factor
  std::size_t count() const { return values_.size(); }
  double mean() const;             // NaN of nothing
  double deviation() const;        // sample standard deviation; NaN of fewer than two
  double error_of_mean() const;    // the deviation over the root of the count; NaN of fewer than two
  double least() const;            // NaN of nothing
  double largest() const;          // NaN of nothing
  double root_mean_square() const; // NaN of nothing

private:
  std::vector<double> values_;
};

// A standard deviation of fewer packings says little of the scatter: of three its 95 % range is from half to
// six times what was found. Their range is reported instead.
constexpr std::size_t fewest_for_deviation = 5;

// In multiples of `unit`: "mean +- deviation" of five packings and more, "least ... largest, 3 packings" of
// fewer, "-" of nothing.
std::string text_of(const SeedStatistics &statistics, double unit);
// The same without how many there are, for a table that says so.
std::string short_text_of(const SeedStatistics &statistics, double unit);

} // namespace platen::apps
