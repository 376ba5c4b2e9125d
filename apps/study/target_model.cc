#include "apps/study/target_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>

namespace platen::apps {
namespace {

constexpr int speeds_at_most = static_cast<int>(most_speeds);
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, speeds_at_most, speeds_at_most>;
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, speeds_at_most, 1>;

// Of c where runs say nothing: that of a figure of 1 + b / N to 1 / (1 - b / N) with b = 1 is between -1/2
// and 1/2, and b of concrete is 0.7 to 1.5. Where b comes out larger, its square.
constexpr double least_curvature = 1;
// Of the variance, the most that packings may have: chaos of nothing would leave no likelihood.
constexpr double largest_share = 1 - 1e-9, least_share = 1e-12;
// No variance is less, relative to the figure's square: figures are written with sixteen digits.
constexpr double least_variance = 1e-24;

// How many runs, at how many speeds, and how many packings have more than one.
struct DesignCounts {
  double runs = 0, speeds = 0, repeated = 0;
};

DesignCounts counts_of(const Design &design) {
  DesignCounts counts;
  SpeedSet any = 0;
  for (const auto &[set, packings] : design) {
    if (packings <= 0) continue;
    const int size = __builtin_popcount(set);
    counts.runs += packings * size, any |= set;
    if (size > 1) counts.repeated += packings;
  }
  counts.speeds = __builtin_popcount(any);
  return counts;
}

// The slope needs two speeds.
bool tells_slope(const Design &design) {
  return counts_of(design).speeds > 1;
}

// Runs of one packing as rows of a linear model.
struct PackingRuns {
  std::vector<std::size_t> speeds;
  explicit PackingRuns(SpeedSet set) {
    for (std::size_t k = 0; k < most_speeds; ++k)
      if ((set >> k & 1U) != 0) speeds.push_back(k);
  }
  Eigen::Index size() const { return static_cast<Eigen::Index>(speeds.size()); }
  template <class Rows> // one for each speed
  void fill(const Rows &row) const {
    for (Eigen::Index r = 0; r < size(); ++r)
      row(r, speeds[static_cast<std::size_t>(r)]);
  }
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
    fill([&](Eigen::Index r, std::size_t speed) {
      const double x = 1 / transits[speed];
      columns.row(r) << 1, x, x * x;
    });
    return columns;
  }
  // A column for each speed.
  Matrix means(std::size_t count) const {
    Matrix columns = Matrix::Zero(size(), static_cast<Eigen::Index>(count));
    fill([&](Eigen::Index r, std::size_t speed) { columns(r, static_cast<Eigen::Index>(speed)) = 1; });
    return columns;
  }
  Vector values(const std::vector<double> &logs) const {
    Vector y(size());
    fill([&](Eigen::Index r, std::size_t speed) { y[r] = logs[speed]; });
    return y;
  }
};

// Speeds that no packing has leave columns of nothing.
Matrix without_gaps(Matrix normal) {
  for (Eigen::Index k = 0; k < normal.rows(); ++k)
    if (normal(k, k) == 0) normal(k, k) = 1;
  return normal;
}

// Inverse of the covariance of both variances, as the restricted likelihood has them: a half of
// tr(P V_i P V_j), P the projection that is free of the means.
Eigen::Matrix2d information(const Design &design, std::size_t speeds, const Spread &spread) {
  const auto count = static_cast<Eigen::Index>(speeds);
  const Matrix zero = Matrix::Zero(count, count);
  Matrix normal = zero, once[2] = {zero, zero}, twice[2][2] = {{zero, zero}, {zero, zero}};
  Eigen::Matrix2d traces = Eigen::Matrix2d::Zero();
  for (const auto &[set, packings] : design) {
    const PackingRuns block(set);
    const Matrix inverse = block.inverse(spread), x = block.means(speeds), wx = inverse * x,
                 parts[2] = {Matrix::Ones(block.size(), block.size()),
                             Matrix::Identity(block.size(), block.size())};
    normal += packings * x.transpose() * wx;
    for (int i = 0; i < 2; ++i) {
      once[i] += packings * wx.transpose() * parts[i] * wx;
      for (int j = 0; j < 2; ++j) {
        traces(i, j) += packings * (inverse * parts[i] * inverse * parts[j]).trace();
        twice[i][j] += packings * wx.transpose() * parts[i] * inverse * parts[j] * wx;
      }
    }
  }
  const Matrix f = without_gaps(normal).inverse();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      traces(i, j) += (f * once[i] * f * once[j]).trace() - 2 * (f * twice[i][j]).trace();
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
  double squares = 0, determinants = 0;
  for (std::size_t s = 0; s < runs.logs.size(); ++s) {
    const PackingRuns block(runs.speeds_of(s));
    if (block.size() == 0) continue;
    const Matrix inverse = block.inverse(unit), x = block.means(speeds);
    const Vector y = block.values(runs.logs[s]);
    normal += x.transpose() * inverse * x;
    right += x.transpose() * inverse * y;
    squares += y.dot(inverse * y);
    determinants += block.log_determinant(unit);
  }
  normal = without_gaps(normal);
  squares -= right.dot(normal.inverse() * right);
  squares += prior.sum_freedom * prior.about.total();
  const DesignCounts counts = counts_of(runs.design());
  const double freedom = counts.runs - counts.speeds + prior.sum_freedom;
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

Matrix normal_of_law(const Design &design, const std::vector<double> &transits, const RunErrors &errors) {
  Matrix normal = Matrix::Zero(3, 3);
  normal(2, 2) = 1 / (errors.curvature * errors.curvature);
  for (const auto &[set, packings] : design) {
    const PackingRuns block(set);
    const Matrix x = block.law(transits);
    normal += packings * x.transpose() * block.inverse(errors.spread) * x;
  }
  return normal;
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

std::optional<Precision> precision_of(const Design &design, const std::vector<double> &transits,
                                      const RunErrors &errors, Freedom wants) {
  if (!tells_slope(design)) return std::nullopt;
  const Matrix inverse = normal_of_law(design, transits, errors).inverse();
  double packing = 0, chaos = 0, speed = 0;
  for (const auto &[set, packings] : design) {
    const PackingRuns block(set);
    const Matrix x = block.law(transits);
    const Vector weights = block.inverse(errors.spread) * x * inverse.col(0);
    packing += packings * weights.sum() * weights.sum();
    chaos += packings * weights.squaredNorm();
    speed += packings * weights.dot(x.col(2));
  }
  Precision of;
  of.packing = packing * errors.spread.packing;
  of.chaos = chaos * errors.spread.chaos;
  of.speed = std::pow(speed * errors.curvature, 2);
  of.slope = inverse(1, 1);
  if (wants == Freedom::counted)
    of.freedom = freedom_of(design, transits.size(), errors.spread, errors.prior, {packing, chaos});
  return of;
}

std::optional<TargetEstimate> estimate(const TargetRuns &runs, const SpreadPrior &prior,
                                       double curvature_at_least) {
  const std::optional<Spread> spread = spread_of(runs, prior);
  if (!spread || !tells_slope(runs.design())) return std::nullopt;
  TargetEstimate of;
  of.errors = {*spread, prior, std::max(least_curvature, curvature_at_least)};
  const auto solve = [&] {
    Vector right = Vector::Zero(3);
    for (std::size_t s = 0; s < runs.logs.size(); ++s)
      if (const PackingRuns block(runs.speeds_of(s)); block.size() > 0)
        right += block.law(runs.transits).transpose() * block.inverse(of.errors.spread) *
                 block.values(runs.logs[s]);
    const Vector found = normal_of_law(runs.design(), runs.transits, of.errors).inverse() * right;
    of.mean = found[0], of.slope = found[1];
  };
  solve();
  if (of.slope * of.slope > of.errors.curvature) {
    of.errors.curvature = of.slope * of.slope;
    solve();
  }
  of.precision = *precision_of(runs.design(), runs.transits, of.errors);
  return of;
}

double quantile_of(double freedom, double probability) {
  return std::isinf(freedom) ? boost::math::quantile(boost::math::normal(), probability)
                             : boost::math::quantile(boost::math::students_t(freedom), probability);
}

double half_interval(const Precision &precision, double confidence, double others) {
  return quantile_of(precision.freedom, 0.5 + confidence / 2) * std::sqrt(precision.total() + others);
}

} // namespace platen::apps
