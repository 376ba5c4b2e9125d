// The moments of a test that a report looks at: the peak, the fall to 0.8 of it, the end.
#pragma once

#include <optional>
#include <vector>

#include "apps/report/csv.h"

namespace platen::apps::report {

// Where the stress has fallen to this share of the peak, the crack pattern is judged: later the ends are
// eaten too.
constexpr double post_peak_share = 0.8;

struct Moments {
  std::size_t peak_row = 0;             // row of the history
  double peak_stress = 0;               // Pa, mean of both platens; negative for a tension test
  double peak_time = 0;                 // s
  std::optional<double> post_peak_time; // s; nothing where the stress never fell so far
  double end_time = 0;                  // s
};

// Mean of the stresses at both platens, Pa, one per row of the history; compression positive.
std::vector<double> axial_stress(const CsvTable &history);

// The peak is the largest stress by size, so that a tension test has one too. Time of the fall is
// interpolated between samples. Throws InputError where the history has no row or no finite stress.
Moments moments_of(const CsvTable &history);

} // namespace platen::apps::report
