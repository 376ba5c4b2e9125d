// What runs at several speeds on several packings tell of a figure: its value for slow loading, and how well
// it is known.
//
// Of packing s at N wave crossings (transits of a wave in 0.1 % of closure), y being the figure's logarithm,
//   y = m + b / N + c / N^2 + a_s + e,
// m: sought; b: haste, known from docs/accuracy.md to act as 1 / N; c: the next order, of which only a bound
// is known; a_s: the packing, the same in all its runs; e: chaos of crushing, which anything that changes the
// last digits draws anew. A gain is the same with the difference of two logarithms on one packing and speed.
//
// Variances of a and e by runs: those of largest restricted likelihood with one mean a speed, so that they
// trust no law of speed (Patterson and Thompson 1971). Beforehand their sum is known as by so many degrees of
// freedom (scaled inverse chi-square, Box and Tiao 1973, section 2.3), and apart from that their ratio as by
// two variances with so many degrees each (F): where packings scatter more, so does chaos. m is the best
// linear unbiased estimate with them, c being drawn from a distribution as wide as its bound; the interval is
// Student's with the freedom that Satterthwaite's match gives.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace platen::apps {

constexpr std::size_t most_speeds = 8; // of a plan

// Bit k: a run at speed k.
using SpeedSet = unsigned;

// Packings by the speeds at which they are run.
using Design = std::map<SpeedSet, double>;

// Logarithms of the figure by packing and by speed; NaN: no run, or one without the figure.
struct TargetRuns {
  std::vector<double> transits; // N of each speed
  std::vector<std::vector<double>> logs;

  SpeedSet speeds_of(std::size_t packing) const;
  Design design() const;
};

struct Spread { // variances of logarithms
  double packing = 0, chaos = 0;
  double total() const { return packing + chaos; }
};

struct SpreadPrior {
  Spread about;
  double sum_freedom = 0, ratio_freedom = 0; // 0: nothing is known
};

// Two packings with more than one run, and one run more than means: before that runs tell no variances,
// whatever is known beforehand.
bool tells_spread(const Design &design);

// Nothing where the runs tell none.
std::optional<Spread> spread_of(const TargetRuns &runs, const SpreadPrior &prior);

// Degrees of freedom of a sum of both variances with these weights, by Satterthwaite's match (Giesbrecht and
// Burns 1985).
double freedom_of(const Design &design, std::size_t speeds, const Spread &spread, const SpreadPrior &prior,
                  const Spread &weights);

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

struct TargetEstimate {
  double mean = 0;  // m
  double slope = 0; // b
  RunErrors errors; // as they were found, or taken
  Precision precision;
};

// m by runs that are there. `curvature_at_least`: of c, beside what the runs say of it.
std::optional<TargetEstimate> estimate(const TargetRuns &runs, const SpreadPrior &prior,
                                       double curvature_at_least = 0);

// What Student's variable of so many degrees of freedom, or a normal one of infinitely many, exceeds with the
// rest of this probability.
double quantile_of(double freedom, double probability);

// Half the width of the interval that holds m with this confidence. `others`: variance of what errs beside
// the runs, known.
double half_interval(const Precision &precision, double confidence, double others);

} // namespace platen::apps
