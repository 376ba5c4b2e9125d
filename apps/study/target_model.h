// What runs at several speeds on several packings tell of a figure: its value for slow loading, and how well
// it is known.
//
// Of packing s at N wave crossings (transits of a wave in 0.1 % of closure), y being the figure's logarithm,
//   y = m + b / N + c / N^2 + a_s + e,
// m: sought; b: haste, known from docs/accuracy.md to act as 1 / N; c: the next order, of which only a bound
// is known; a_s: the packing, the same in all its runs; e: chaos of crushing, which anything that changes the
// last digits draws anew. A gain is the same with the difference of two logarithms on one packing and speed.
//
// Variances of a and e are those of target_spread.h; m is the best linear unbiased estimate with them, c
// being drawn from a distribution as wide as its bound; the interval is Student's with the freedom that
// Satterthwaite's match gives.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "apps/study/target_spread.h"

namespace platen::apps {

// By what runs differ from m + b / N.
struct RunErrors {
  Spread spread;
  SpreadPrior prior;
  double curvature = 0; // deviation of c
};

// How well a design tells m. All but freedom are variances of it.
struct Precision {
  double packing = 0, chaos = 0, speed = 0; // speed: what 1 / N may miss, and nothing of what b costs
  // Degrees of it, of packing + chaos; infinite where it was not counted.
  double freedom = std::numeric_limits<double>::infinity();
  double slope = 0; // variance of b
  double total() const { return packing + chaos + speed; }
};

enum class Freedom { counted, infinite }; // counting it takes longer than all the rest

// Nothing where the design cannot tell a slope from a mean.
std::optional<Precision> precision_of(const Design &design, const std::vector<double> &transits,
                                      const RunErrors &errors, Freedom wants = Freedom::counted);

// Of c where runs say nothing: that of a figure of 1 + b / N to 1 / (1 - b / N) with b = 1 is between -1/2
// and 1/2, and b of concrete is 0.7 to 1.5. Where b comes out larger, its square.
constexpr double least_curvature = 1;

struct TargetEstimate {
  double mean = 0;  // m
  double slope = 0; // b
  RunErrors errors; // as they were found, or taken
  Precision precision;
};

// m by runs that are there. `curvature_at_least`: of c, beside what the runs say of it.
std::optional<TargetEstimate> estimate(const TargetRuns &runs, const SpreadPrior &prior,
                                       double curvature_at_least = 0);

// Half the width of the interval that holds m with this confidence. `others`: variance of what errs beside
// the runs, known.
double half_interval(const Precision &precision, double confidence, double others);

} // namespace platen::apps
