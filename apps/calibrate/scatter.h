// Mean and scatter over seeds, and which seeds those are.
#pragma once

#include <cmath>
#include <vector>

#include "apps/scene/scene.h"

namespace platen::apps {

class Scatter {
public:
  void add(double value) { values_.push_back(value); }
  std::size_t count() const { return values_.size(); }
  double mean() const { // NaN of nothing
    if (values_.empty()) return not_given;
    double sum = 0;
    for (const double v : values_)
      sum += v;
    return sum / static_cast<double>(values_.size());
  }
  double deviation() const { // of a single one; NaN of fewer than two
    if (values_.size() < 2) return not_given;
    double squares = 0;
    const double m = mean();
    for (const double v : values_)
      squares += (v - m) * (v - m);
    return std::sqrt(squares / (static_cast<double>(values_.size()) - 1));
  }

private:
  std::vector<double> values_;
};

inline std::vector<unsigned long> seeds_from(unsigned long first, int count) {
  std::vector<unsigned long> seeds;
  for (int k = 0; k < count; ++k)
    seeds.push_back(first + static_cast<unsigned long>(k));
  return seeds;
}
inline std::vector<unsigned long> training_seeds(const Scene &s) {
  return seeds_from(s.general.seed, s.calibrate.seeds);
}
inline std::vector<unsigned long> unseen_seeds(const Scene &s) {
  return seeds_from(s.general.seed + static_cast<unsigned long>(s.calibrate.seeds),
                    s.calibrate.verification_seeds);
}

} // namespace platen::apps
