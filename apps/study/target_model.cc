#include "apps/study/target_model.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "apps/study/target_packing_runs.h"

namespace platen::apps {
namespace {

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

// The slope needs two speeds.
bool tells_slope(const Design &design) {
  return counts_of(design).speeds > 1;
}

} // namespace

std::optional<Precision> precision_of(const Design &design, const std::vector<double> &transits,
                                      const RunErrors &errors, Freedom wants) {
  if (!tells_slope(design)) return std::nullopt;
  const Matrix inverse = normal_of_law(design, transits, errors).inverse();
  Precision of;
  double packing = 0, chaos = 0, speed = 0;
  for (const auto &[set, packings] : design) {
    const PackingRuns block(set);
    const Matrix x = block.law(transits);
    const Vector weights = block.inverse(errors.spread) * x * inverse.col(0);
    packing += packings * weights.sum() * weights.sum();
    chaos += packings * weights.squaredNorm();
    speed += packings * weights.dot(x.col(2));
  }
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
    for (std::size_t s = 0; s < runs.logs.size(); ++s) {
      const PackingRuns block(runs.speeds_of(s));
      if (block.size() == 0) continue;
      right +=
          block.law(runs.transits).transpose() * block.inverse(of.errors.spread) * values_of(runs, s, block);
    }
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

double half_interval(const Precision &precision, double confidence, double others) {
  const double tail = 0.5 + confidence / 2,
               quantile = std::isinf(precision.freedom)
                              ? boost::math::quantile(boost::math::normal(), tail)
                              : boost::math::quantile(boost::math::students_t(precision.freedom), tail);
  return quantile * std::sqrt(precision.total() + others);
}

} // namespace platen::apps
