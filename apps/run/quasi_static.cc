#include "apps/run/quasi_static.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/largest.h"

namespace platen::apps {
namespace {

// The calibrated concrete cylinder bears 5 to 10 % more at these than in the limit of slow loading
// (docs/theory.md, 5.3); a kinetic share of 1 %, as is often allowed, is beyond.
constexpr double most_kinetic = 0.005, most_unbalanced = 0.015;
constexpr double most_inertial = 1e-3; // dense granular flow is quasi-static below (GDR MiDi 2004)

// NaN of none, and where one of them is NaN.
double median(std::vector<double> values) {
  const auto is_nan = [](double value) { return std::isnan(value); };
  if (values.empty() || std::any_of(values.begin(), values.end(), is_nan)) return not_measured;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// 1/s. The speed of the axial platens is measured, that of others follows from what they have closed.
double strain_rate(const std::vector<Sample> &rise, std::size_t row, const coupling::PlatenTest &problem,
                   int axis) {
  if (axis == 2) return std::abs(rise[row].platen_speed) / problem.shape().height;
  if (row == 0) return not_measured;
  const auto strain = platen_strain(axis);
  return std::abs((rise[row].*strain - rise[row - 1].*strain) / (rise[row].time - rise[row - 1].time));
}

} // namespace

double wave_transits(const coupling::PlatenTest &problem, int axis, double seconds) {
  const double share = coupling::length(problem.shape(), axis) / problem.shape().height;
  const double transit = share * problem.facts().wave_transit;
  return transit > 0 ? seconds / transit : not_measured;
}

Slowness slowness(const coupling::PlatenTest &problem, const std::vector<Sample> &rise, int axis) {
  Slowness s;
  std::vector<double> unbalanced;
  Largest kinetic, inertial;
  const double diameter = 2 * problem.facts().mean_radius;
  for (std::size_t k = 0; k < rise.size(); ++k) {
    const Sample &sample = rise[k];
    kinetic.add(sample.kinetic / sample.internal());
    if (sample.intact_bonds > 0) unbalanced.push_back(sample.unbalanced); // over the forces of bonds
    const double rate = strain_rate(rise, k, problem, axis), stress = std::abs(sample.stress(axis));
    if (stress != 0 && (k > 0 || axis == 2)) // its speed is not known at the first
      inertial.add(rate * diameter * std::sqrt(problem.facts().grain_density / stress));
  }
  s.kinetic = kinetic.value();
  s.inertial = inertial.value();
  s.unbalanced = median(unbalanced);
  return s;
}

Slowness slowness(const coupling::PlatenTest &problem, const Results &results) {
  Slowness s = slowness(problem, results.rise(), results.axis());
  s.wave_transits = wave_transits(problem, results.axis(), results.axial_time_to_peak());
  s.to_peak = results.peak().reached();
  return s;
}

bool knows_slowness(bool peak_reached, const std::string &ended_by) {
  const std::string by = ended_by.substr(0, ended_by.find(';')); // what follows was not reached
  const bool cut_off = by.empty() || by == "signal" || by == "failure" || by == "script";
  return peak_reached || !cut_off;
}

std::vector<std::string> reasons_not_quasi_static(const Slowness &s, bool bent) {
  std::vector<std::string> signs;
  if (s.kinetic > most_kinetic)
    signs.push_back(
        fmt::format("kinetic energy is {:.2g} of the internal, {:g} at most", s.kinetic, most_kinetic));
  if (s.unbalanced > most_unbalanced)
    signs.push_back(fmt::format("unbalanced forces are {:.2g} of those of the bonds, {:g} at most",
                                s.unbalanced, most_unbalanced));
  if (s.inertial > most_inertial)
    signs.push_back(fmt::format("inertial number {:.2g}, {:g} at most", s.inertial, most_inertial));
  if (!bent && s.wave_transits < fewest_transits)
    signs.push_back(fmt::format("{:.0f} wave crossings to the {}, {:g} at least", s.wave_transits,
                                s.to_peak ? "peak" : "largest stress, no peak", fewest_transits));
  return signs;
}

} // namespace platen::apps
