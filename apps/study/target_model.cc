#include "apps/study/target_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace platen::apps {
namespace {

constexpr int speeds_at_most = static_cast<int>(most_speeds);
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, speeds_at_most, speeds_at_most>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, speeds_at_most, 1>;

// Of the variance, the most that packings may have: chaos of nothing would leave no likelihood.
constexpr double largest_share = 1 - 1e-9;
// No variance is less, relative to the figure's square: figures are written with sixteen digits.
constexpr double least_variance = 1e-24;

// Runs of one packing.
struct Block {
  std::vector<std::size_t> speeds;
  explicit Block(SpeedSet set) {
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
    const Block block(set);
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

// Degrees of freedom of a sum of both variances with these weights.
double freedom_of(const Design &design, std::size_t speeds, const Spread &spread, double of_packing,
                  double of_chaos) {
  double runs = 0, means = 0;
  SpeedSet any = 0;
  for (const auto &[set, packings] : design)
    runs += packings * __builtin_popcount(set), any |= set;
  means = __builtin_popcount(any);
  const Eigen::Vector2d weights(of_packing, of_chaos);
  const Eigen::Matrix2d covariance = information(design, speeds, spread).inverse();
  const double value = of_packing * spread.packing + of_chaos * spread.chaos;
  const double matched = 2 * value * value / weights.dot(covariance * weights);
  return std::clamp(std::isfinite(matched) ? matched : 1, 1.0, std::max(1.0, runs - means));
}

Matrix normal_of_law(const Design &design, const std::vector<double> &transits, const Spread &spread,
                     double curvature) {
  Matrix normal = Matrix::Zero(3, 3);
  normal(2, 2) = 1 / (curvature * curvature);
  for (const auto &[set, packings] : design) {
    const Block block(set);
    const Matrix x = block.law(transits);
    normal += packings * x.transpose() * block.inverse(spread) * x;
  }
  return normal;
}

// The slope needs two speeds.
bool tells_slope(const Design &design) {
  SpeedSet any = 0;
  for (const auto &[set, packings] : design)
    if (packings > 0) any |= set;
  return __builtin_popcount(any) > 1;
}

Vector values_of(const TargetRuns &runs, std::size_t packing, const Block &block) {
  Vector y(block.size());
  for (Eigen::Index r = 0; r < block.size(); ++r)
    y[r] = runs.logs[packing][block.speeds[static_cast<std::size_t>(r)]];
  return y;
}

struct Likelihood {
  double minus_twice_log = 0;
  double variance = 0; // of packing and chaos
};

// Restricted, where packings have this share of the variance, whose size is the best for it.
Likelihood likelihood(const TargetRuns &runs, double share) {
  const std::size_t speeds = runs.transits.size();
  const auto count = static_cast<Eigen::Index>(speeds);
  const Spread unit{share, 1 - share};
  Matrix normal = Matrix::Zero(count, count);
  Vector right = Vector::Zero(count);
  double squares = 0, determinants = 0, freedom = 0;
  for (std::size_t s = 0; s < runs.logs.size(); ++s) {
    const Block block(runs.speeds_of(s));
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

SpeedSet TargetRuns::speeds_of(std::size_t packing) const {
  SpeedSet set = 0;
  for (std::size_t k = 0; k < transits.size(); ++k)
    if (!std::isnan(logs[packing][k])) set |= 1U << k;
  return set;
}

Design TargetRuns::design() const {
  Design all;
  for (std::size_t s = 0; s < logs.size(); ++s)
    if (const SpeedSet set = speeds_of(s); set != 0) ++all[set];
  return all;
}

std::optional<Precision> precision_of(const Design &design, const std::vector<double> &transits,
                                      const Spread &spread, double curvature, Freedom wants) {
  if (!tells_slope(design)) return std::nullopt;
  const Matrix inverse = normal_of_law(design, transits, spread, curvature).inverse();
  Precision of;
  double packing = 0, chaos = 0, speed = 0;
  for (const auto &[set, packings] : design) {
    const Block block(set);
    const Matrix x = block.law(transits);
    const Vector weights = block.inverse(spread) * x * inverse.col(0);
    packing += packings * weights.sum() * weights.sum();
    chaos += packings * weights.squaredNorm();
    speed += packings * weights.dot(x.col(2));
  }
  of.packing = packing * spread.packing;
  of.chaos = chaos * spread.chaos;
  of.speed = speed * speed * curvature * curvature;
  of.slope = inverse(1, 1);
  if (wants == Freedom::counted) of.freedom = freedom_of(design, transits.size(), spread, packing, chaos);
  return of;
}

std::optional<Spread> spread_of(const TargetRuns &given) {
  const Design design = given.design();
  double runs = 0, means = 0, repeated = 0;
  SpeedSet any = 0;
  for (const auto &[set, packings] : design) {
    const int size = __builtin_popcount(set);
    runs += packings * size, any |= set;
    if (size > 1) repeated += packings;
  }
  means = __builtin_popcount(any);
  if (repeated < 2 || runs <= means) return std::nullopt;
  const TargetRuns centre = centred(given);
  const auto minus_twice_log = [&](double share) { return likelihood(centre, share).minus_twice_log; };
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
  const double variance = likelihood(centre, share).variance;
  return Spread{share * variance, (1 - share) * variance};
}

std::optional<TargetEstimate> estimate(const TargetRuns &runs, double curvature_at_least) {
  const std::optional<Spread> spread = spread_of(runs);
  if (!spread || !tells_slope(runs.design())) return std::nullopt;
  TargetEstimate of;
  of.spread = *spread;
  of.curvature = std::max(least_curvature, curvature_at_least);
  const auto solve = [&] {
    Vector right = Vector::Zero(3);
    for (std::size_t s = 0; s < runs.logs.size(); ++s) {
      const Block block(runs.speeds_of(s));
      if (block.size() == 0) continue;
      right += block.law(runs.transits).transpose() * block.inverse(of.spread) * values_of(runs, s, block);
    }
    const Vector found =
        normal_of_law(runs.design(), runs.transits, of.spread, of.curvature).inverse() * right;
    of.mean = found[0], of.slope = found[1];
  };
  solve();
  if (of.slope * of.slope > of.curvature) {
    of.curvature = of.slope * of.slope;
    solve();
  }
  of.precision = *precision_of(runs.design(), runs.transits, of.spread, of.curvature);
  return of;
}

double half_interval(const Precision &precision, double confidence, double others) {
  const double tail = 0.5 + confidence / 2,
               quantile = std::isinf(precision.freedom)
                              ? boost::math::quantile(boost::math::normal(), tail)
                              : boost::math::quantile(boost::math::students_t(precision.freedom), tail);
  return quantile * std::sqrt(precision.total() + others);
}

} // namespace platen::apps
