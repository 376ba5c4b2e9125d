// Numbers that the summary and the report of a test take from the state at its peak; NaN where not measured.
#pragma once

#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// Poisson's ratio of the share of shear in a deflection, which a bent bar does not tell: between 0.1 and 0.3
// the share changes by a sixth.
constexpr double assumed_poisson_ratio = 0.2;

// How often a wave crosses the length of an axis in so many seconds; NaN without bonds.
double wave_transits(const coupling::PlatenTest &problem, int axis, double seconds);

// Speed of a slow test: how often a wave crosses the specimen, along the axis that is loaded, from the start
// of the axial stage to the peak.
double wave_transits_to_peak(const coupling::PlatenTest &problem, const Results &results);

// Of a bent bar: Pa; the moment at mid-span over P L / 4; how often it could have swung until the peak.
double flexural_modulus(const coupling::PlatenTest &problem, const Results &results);
double moment_over_nominal(const coupling::PlatenTest &problem, const Results &results);
double oscillations_to_peak(const coupling::PlatenTest &problem, const Results &results);

} // namespace platen::apps
