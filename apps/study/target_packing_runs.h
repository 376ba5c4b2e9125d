// Runs of one packing as rows of a linear model: for target_model.cc and target_spread.cc alone.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "apps/study/target_spread.h"

namespace platen::apps {

constexpr int speeds_at_most = static_cast<int>(most_speeds);
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, speeds_at_most, speeds_at_most>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, speeds_at_most, 1>;

struct PackingRuns {
  std::vector<std::size_t> speeds;
  explicit PackingRuns(SpeedSet set) {
    for (std::size_t k = 0; k < most_speeds; ++k)
      if ((set >> k & 1U) != 0) speeds.push_back(k);
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(speeds.size()); }
  // Covariance chaos I + packing 1 1', its inverse in closed form (Sherman and Morrison), its determinant.
  double sum_of_row(const Spread &spread) const {
    return spread.chaos + static_cast<double>(size()) * spread.packing;
  }
  Matrix inverse(const Spread &spread) const {
    return (Matrix::Identity(size(), size()) -
            Matrix::Constant(size(), size(), spread.packing / sum_of_row(spread))) /
           spread.chaos;
  }
  double log_determinant(const Spread &spread) const {
    return static_cast<double>(size() - 1) * std::log(spread.chaos) + std::log(sum_of_row(spread));
  }
  // Columns: mean, 1 / N, 1 / N^2.
  Matrix law(const std::vector<double> &transits) const {
    Matrix columns(size(), 3);
    for (Eigen::Index r = 0; r < size(); ++r) {
      const double x = 1 / transits[speeds[static_cast<std::size_t>(r)]];
      columns.row(r) << 1, x, x * x;
    }
    return columns;
  }
  // A column for each speed.
  Matrix means(std::size_t count) const {
    Matrix columns = Matrix::Zero(size(), static_cast<Eigen::Index>(count));
    for (Eigen::Index r = 0; r < size(); ++r)
      columns(r, static_cast<Eigen::Index>(speeds[static_cast<std::size_t>(r)])) = 1;
    return columns;
  }
};

inline Vector values_of(const TargetRuns &runs, std::size_t packing, const PackingRuns &block) {
  Vector y(block.size());
  for (Eigen::Index r = 0; r < block.size(); ++r)
    y[r] = runs.logs[packing][block.speeds[static_cast<std::size_t>(r)]];
  return y;
}

} // namespace platen::apps
