// What platen-bar found, side by side with strength of materials, and how it is told: rows of history.csv,
// summary.json and the screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/bar/bar_at_rest.h"
#include "apps/bar/bar_oscillations.h"
#include "apps/bar/bar_section.h"
#include "apps/output/csv_writer.h"
#include "apps/run/app_output.h"

namespace platen::apps {

// One load: tension, bending or torsion.
struct LoadResult {
  BarLoad load = BarLoad::tension;
  StaticTest at_rest; // always solved, for the bar is released from there
  bool keeps_static = false;
  std::optional<Oscillation> oscillation;
};

// Energy residual: the largest of an oscillation or impact.
struct BarResults : TestFigures {
  BarGeometry bar;
  BarModuli pulled;
  dem::Moduli bulk;
  BarTime time;
  std::vector<LoadResult> loads;
  std::optional<Impact> impact;
  double struck_velocity = 0; // m/s

  // With the measured axial rigidity and Poisson ratio, on the bounding section or the effective one.
  Rod rod(bool effective) const;
  Rod oscillating_rod(bool effective) const; // from the middle of the clamped spheres to the end plane
};

// The common columns, of which a bar without platens fills some, and its own.
std::vector<std::string> bar_columns();
// With a ledger: energies are kept; without it their columns are NaN.
std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger);

Json summary_of(const Scene &scene, const BarResults &results, const std::string &status);
// For the screen and the log.
std::string report_of(const BarResults &results);

} // namespace platen::apps
