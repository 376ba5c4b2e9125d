#include "apps/study/target_spread.h"

#include <algorithm>
#include <array>
#include <boost/math/tools/minima.hpp>

#include "apps/study/target_packing_runs.h"

namespace platen::apps {
namespace {

// Of the variance, the most that packings may have: chaos of nothing would leave no likelihood.
constexpr double largest_share = 1 - 1e-9, least_share = 1e-12;
// No variance is less, relative to the figure's square: figures are written with sixteen digits.
constexpr double least_variance = 1e-24;

// Speeds that no packing has leave columns of nothing.
Matrix inverse_of_means(Matrix normal) {
  for (Eigen::Index k = 0; k < normal.rows(); ++k)
    if (normal(k, k) == 0) normal(k, k) = 1;
  return normal.inverse();
}

// Inverse of the covariance of both variances, as the restricted likelihood has them: a half of
// tr(P V_i P V_j), P the projection that is free of the means.
Eigen::Matrix2d information(const Design &design, std::size_t speeds, const Spread &spread) {
  const auto count = static_cast<Eigen::Index>(speeds);
  Matrix normal = Matrix::Zero(count, count);
  std::array<Matrix, 2> once{normal, normal};
  std::array<std::array<Matrix, 2>, 2> twice{once, once};
  Eigen::Matrix2d traces = Eigen::Matrix2d::Zero();
  for (const auto &[set, packings] : design) {
    const PackingRuns block(set);
    const Matrix inverse = block.inverse(spread), x = block.means(speeds), wx = inverse * x;
    const std::array<Matrix, 2> parts{Matrix::Ones(block.size(), block.size()),
                                      Matrix::Identity(block.size(), block.size())};
    normal += packings * x.transpose() * wx;
    for (std::size_t i = 0; i < 2; ++i) {
      once[i] += packings * wx.transpose() * parts[i] * wx;
      for (std::size_t j = 0; j < 2; ++j) {
        traces(static_cast<int>(i), static_cast<int>(j)) +=
            packings * (inverse * parts[i] * inverse * parts[j]).trace();
        twice[i][j] += packings * wx.transpose() * parts[i] * inverse * parts[j] * wx;
      }
    }
  }
  const Matrix f = inverse_of_means(normal);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j)
      traces(static_cast<int>(i), static_cast<int>(j)) +=
          (f * once[i] * f * once[j]).trace() - 2 * (f * twice[i][j]).trace();
  return 0.5 * traces;
}

// Logarithm of the ratio of the variances over the ratio that was expected.
double off_expected(const Spread &spread, const Spread &about) {
  return std::log(spread.packing / about.packing) - std::log(spread.chaos / about.chaos);
}

// Of the density of F in the logarithm of the ratio.
double minus_twice_log_of_ratio(const Spread &spread, const SpreadPrior &prior) {
  if (prior.ratio_freedom == 0) return 0;
  return 2 * prior.ratio_freedom * std::log(std::cosh(off_expected(spread, prior.about) / 2));
}

// What is known beforehand of both variances, as the runs' information: of so many degrees on a sum a half of
// them over its square; the curvature of the logarithm of the density of F.
Eigen::Matrix2d information(const SpreadPrior &prior, const Spread &spread) {
  Eigen::Matrix2d known = Eigen::Matrix2d::Constant(0.5 * prior.sum_freedom / std::pow(spread.total(), 2));
  if (prior.ratio_freedom == 0) return known;
  const double slope = 1 / std::cosh(off_expected(spread, prior.about) / 2);
  const Eigen::Vector2d ratio(slope / spread.packing, -slope / spread.chaos);
  return known + 0.25 * prior.ratio_freedom * ratio * ratio.transpose();
}

struct Likelihood {
  double minus_twice_log = 0;
  double variance = 0; // of packing and chaos
};

// Restricted, where packings have this share of the variance, whose size is the best for it.
Likelihood likelihood(const TargetRuns &runs, const SpreadPrior &prior, double share) {
  const std::size_t speeds = runs.transits.size();
  const auto count = static_cast<Eigen::Index>(speeds);
  const Spread unit{std::max(share, least_share), 1 - share};
  Matrix normal = Matrix::Zero(count, count);
  Vector right = Vector::Zero(count);
  double squares = 0, determinants = 0, freedom = 0;
  for (std::size_t s = 0; s < runs.logs.size(); ++s) {
    const PackingRuns block(runs.speeds_of(s));
    if (block.size() == 0) continue;
    const Matrix inverse = block.inverse(unit), x = block.means(speeds);
    const Vector y = values_of(runs, s, block);
    normal += x.transpose() * inverse * x;
    right += x.transpose() * inverse * y;
    squares += y.dot(inverse * y);
    determinants += block.log_determinant(unit);
    freedom += static_cast<double>(block.size());
  }
  for (Eigen::Index k = 0; k < count; ++k)
    if (normal(k, k) == 0)
      normal(k, k) = 1;
    else
      freedom -= 1;
  squares -= right.dot(normal.inverse() * right);
  squares += prior.sum_freedom * prior.about.total();
  freedom += prior.sum_freedom;
  determinants += minus_twice_log_of_ratio(unit, prior);
  const double variance = std::max(squares / freedom, least_variance);
  return {freedom * std::log(variance) + determinants + std::log(normal.determinant()), variance};
}

// The mean taken off, so that squares of differences do not drown in squares of logarithms.
TargetRuns centred(TargetRuns runs) {
  double sum = 0, count = 0;
  for (const std::vector<double> &packing : runs.logs)
    for (const double y : packing)
      if (!std::isnan(y)) sum += y, count += 1;
  for (std::vector<double> &packing : runs.logs)
    for (double &y : packing)
      y -= sum / count;
  return runs;
}

} // namespace

bool tells_spread(const Design &design) {
  const DesignCounts counts = counts_of(design);
  return counts.repeated >= 2 && counts.runs > counts.speeds;
}

double freedom_of(const Design &design, std::size_t speeds, const Spread &spread, const SpreadPrior &prior,
                  const Spread &weights) {
  const DesignCounts counts = counts_of(design);
  const Eigen::Vector2d gradient(weights.packing, weights.chaos);
  const Eigen::Matrix2d covariance =
      (information(design, speeds, spread) + information(prior, spread)).inverse();
  const double value = gradient.dot(Eigen::Vector2d(spread.packing, spread.chaos));
  const double matched = 2 * value * value / gradient.dot(covariance * gradient);
  return std::clamp(std::isfinite(matched) ? matched : 1, 1.0,
                    std::max(1.0, counts.runs - counts.speeds + prior.sum_freedom));
}

std::optional<Spread> spread_of(const TargetRuns &runs, const SpreadPrior &prior) {
  if (!tells_spread(runs.design())) return std::nullopt;
  const TargetRuns centre = centred(runs);
  const auto minus_twice_log = [&](double share) { return likelihood(centre, prior, share).minus_twice_log; };
  // The best of a coarse walk, then Brent's search between its neighbours: there may be two hills.
  constexpr int steps = 20;
  int best = 0;
  for (int k = 1; k <= steps; ++k)
    if (minus_twice_log(largest_share * k / steps) < minus_twice_log(largest_share * best / steps)) best = k;
  constexpr int bits = 30; // of the share
  double share =
      boost::math::tools::brent_find_minima(minus_twice_log, largest_share * std::max(0, best - 1) / steps,
                                            largest_share * std::min(steps, best + 1) / steps, bits)
          .first;
  for (const double end : {0.0, largest_share})
    if (minus_twice_log(end) <= minus_twice_log(share)) share = end;
  const double variance = likelihood(centre, prior, share).variance;
  return Spread{share * variance, (1 - share) * variance};
}

} // namespace platen::apps
