// What the same accuracy costs by runs at one slow speed.
#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "apps/study/target_plan.h"

namespace platen::apps {
namespace {

// That Student's variable, of so many degrees of freedom, is less.
double below(double value, double freedom) {
  return std::isinf(freedom) ? boost::math::cdf(boost::math::normal(), value)
                             : boost::math::cdf(boost::math::students_t(freedom), value);
}

} // namespace

// Haste is allowed for up to what the pilot's error leaves possible with this confidence.
OneSpeedKnown known_by_pilot(const TargetEstimate &pilot, std::size_t packings, double cost,
                             double confidence) {
  const double quantile = boost::math::quantile(boost::math::students_t(pilot.precision.freedom), confidence);
  return {std::abs(pilot.slope) + quantile * std::sqrt(pilot.precision.slope), pilot.errors.spread, packings,
          pilot.precision.freedom, cost};
}

OneSpeed one_slow_speed(const OneSpeedKnown &known, const LinearCost &cost, double fastest, const Aim &aim) {
  OneSpeed best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t packings = 2; packings <= aim.most_packings; ++packings) {
    const std::size_t further = packings - std::min(packings, known.packings);
    const double count = static_cast<double>(packings), more = static_cast<double>(further);
    if (known.cost + count * cost.at(fastest) > best.cost) break; // and so do more of them
    const double deviation = std::sqrt(known.spread.total() / count + aim.others);
    const auto within = [&](double bias) {
      return below((aim.accuracy - bias) / deviation, known.freedom + more) -
             below((-aim.accuracy - bias) / deviation, known.freedom + more);
    };
    if (within(0) < aim.confidence) continue;
    double low = 0, high = aim.accuracy; // bias that is allowed
    constexpr int halvings = 40;
    for (int k = 0; k < halvings; ++k)
      (within((low + high) / 2) < aim.confidence ? high : low) = (low + high) / 2;
    const double transits = std::max(fastest, known.haste / low),
                 total = known.cost + count * cost.at(transits) + more * cost.packing;
    if (total < best.cost) best = {transits, packings, total};
  }
  return best;
}

} // namespace platen::apps
