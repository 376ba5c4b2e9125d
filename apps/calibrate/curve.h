// A stress-strain curve: of the user's own file, or of a run, and how far one lies from the other.
//   strain_platen,stress_mpa
//   0.0005,12.1
// Comment lines (#), empty lines, CR LF, a byte order mark and blanks around numbers are taken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "base/describe.h"

namespace platen::apps {

constexpr std::size_t curve_points = 16; // at equal steps of strain

struct Curve {
  std::vector<double> strain, stress; // 1, Pa; compression positive
  bool of_gauge = false;              // else between the platens

  double last_strain() const { return strain.back(); }
  double largest_stress() const;
  // Linear between its points and from the origin to the first, where the strain is first reached; the last
  // stress beyond all of them.
  double stress_at(double strain) const;
  // At the `curve_points` equal steps up to a strain: `step`, from 1 on, and all of them.
  static double strain_of(std::size_t step, double last) {
    return last * static_cast<double>(step) / curve_points;
  }
  std::vector<double> sampled(double last) const;
  std::vector<double> sampled() const { return sampled(last_strain()); }
  // Of stresses at these steps: their differences over the largest stress of this curve.
  std::vector<double> misses(const std::vector<double> &stress) const;
};

// Strains ascend from 0 on. Throws InputError with file, line and what is allowed: cannot be read, other
// columns, no row, a number that is none or not finite, strains that do not ascend from above 0 (the first
// may be 0), no stress above 0.
Curve read_curve(const std::filesystem::path &path);
// Of history.csv: strains and stresses from the end of consolidation on, positive in the sense of the test.
Curve curve_of_run(const std::filesystem::path &history, const Json &summary, bool of_gauge);

double root_mean_square(const std::vector<double> &values);
// "largest stress 26 of 35 MPa, rising branch off by 12 %, after the peak by 30 %": root mean squares over
// the largest stress, up to the point with that of the target and beyond it.
std::string branches_of_curve(const Curve &wanted, const std::vector<double> &stress);

} // namespace platen::apps
