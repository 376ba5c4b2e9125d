// The largest of some numbers, which does not ignore NaN.
#pragma once

#include <cmath>
#include <limits>

namespace platen {

// std::max and std::fmax can ignore a NaN and then return a wrong largest value.
class Largest {
public:
  void add(double value) {
    if (none_ || value > value_ || std::isnan(value)) value_ = value;
    none_ = false;
  }
  double value() const { return value_; } // NaN without numbers, and where one of them is NaN

private:
  double value_ = std::numeric_limits<double>::quiet_NaN();
  bool none_ = true;
};

} // namespace platen
