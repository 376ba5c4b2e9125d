// The largest of numbers, where one that is not a number must not be passed over.
#pragma once

#include <cmath>
#include <limits>

namespace platen {

// std::max and std::fmax keep the other number where one is NaN, and tell a largest that nobody has measured.
class Largest {
public:
  void add(double value) {
    if (none_ || value > value_ || std::isnan(value)) value_ = value;
    none_ = false;
  }
  double value() const { return value_; } // NaN of none, and where one of them is NaN

private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
  bool none_ = true;
};

} // namespace platen
