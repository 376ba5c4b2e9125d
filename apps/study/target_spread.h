// How much runs differ: variances of packings and of chaos, by runs and by what is known beforehand.
//
// By runs: the variances of largest restricted likelihood with one mean a speed, so that they trust no law of
// speed (Patterson and Thompson 1971). Beforehand their sum is known as by so many degrees of freedom (scaled
// inverse chi-square, Box and Tiao 1973, section 2.3), and apart from that their ratio as by two variances
// with so many degrees each (F): where packings scatter more, so does chaos.
#pragma once

#include <optional>

#include "apps/study/target_runs.h"

namespace platen::apps {

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

} // namespace platen::apps
