// A stress-strain curve of the user's own, and how far another one lies from it.
//   strain_platen,stress_mpa
//   0.0005,12.1
// Comment lines (#), empty lines, CR LF, a byte order mark and blanks around numbers are taken.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platen::apps {

constexpr std::size_t curve_points = 16; // at equal steps of strain

struct TargetCurve {
  std::vector<double> strain, stress; // 1, Pa; compression positive, strains ascend from 0 on
  bool of_gauge = false;              // else between the platens

  double last_strain() const { return strain.back(); }
  double largest_stress() const;
  // Linear between its points and from the origin to the first.
  double stress_at(double strain) const;
  // At the `curve_points` equal steps up to its last strain.
  std::vector<double> sampled() const;
};

// Throws InputError with file, line and what is allowed: cannot be read, other columns, no row, a number that
// is none or not finite, strains that do not ascend from above 0 (the first may be 0), no stress above 0.
TargetCurve read_target_curve(const std::filesystem::path &path);

// Of stresses at the same steps: their differences over the largest stress of the curve.
std::vector<double> misses_of_curve(const TargetCurve &wanted, const std::vector<double> &stress);
double root_mean_square(const std::vector<double> &values);
// "largest stress 26 of 35 MPa, rising branch off by 12 %, after the peak by 30 %": root mean squares over
// the largest stress, up to the point with that of the target and beyond it.
std::string branches_of_curve(const TargetCurve &wanted, const std::vector<double> &stress);

} // namespace platen::apps
