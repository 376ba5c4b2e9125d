// Was a test slow enough to be called quasi-static? Measured on the way to its peak.
#pragma once

#include <string>
#include <vector>

#include "apps/run/results.h"
#include "coupling/platen_test.h"

namespace platen::apps {

// From a tenth of the peak stress to the peak; NaN where not measured.
struct Slowness {
  double kinetic = not_measured;    // largest kinetic over internal energy
  double unbalanced = not_measured; // median of the mean net force over the mean bond force
  double inertial = not_measured;   // largest inertial number, d eps/dt d sqrt(rho / sigma) (GDR MiDi 2004)
  double wave_transits = not_measured; // of a wave over the loaded length, from the start of the axial stage
  bool to_peak = true;                 // else to the largest stress of a test that has reached no peak
};
constexpr double fewest_transits = 60;
// How often a wave crosses the length of an axis in so many seconds; NaN without bonds.
double wave_transits(const coupling::PlatenTest &problem, int axis, double seconds);
Slowness slowness(const coupling::PlatenTest &problem, const Results &results);
// What follows from samples alone, from a tenth of the peak stress to the peak of an axis: not the wave
// transits.
Slowness slowness(const coupling::PlatenTest &problem, const std::vector<Sample> &rise, int axis);

// Whether the way to the peak is known, and with it whether the test was slow enough: it has reached its
// peak, or has come to its own end without one. `ended_by`: that of summary.json, "" while it goes on.
bool knows_slowness(bool peak_reached, const std::string &ended_by);

// What says that the test was too fast, each with its bound: "36 wave crossings to the peak, 60 at least".
// Empty where it was slow enough. Of a bent bar, which oscillates much more slowly than waves cross it,
// transits say nothing.
std::vector<std::string> reasons_not_quasi_static(const Slowness &slowness, bool bent);

} // namespace platen::apps
