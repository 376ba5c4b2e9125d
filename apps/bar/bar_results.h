// What platen-bar found, side by side with strength of materials: rows of history.csv, summary.json and the
// screen.
#pragma once

#include <string>
#include <vector>

#include "apps/bar/bar_at_rest.h"
#include "apps/bar/bar_oscillations.h"
#include "apps/output/csv_writer.h"
#include "apps/run/app_output.h"

namespace platen::apps {

// Energy residual: the largest of an oscillation or impact.
struct BarResults : TestFigures {
  BarGeometry bar;
  BarModuli pulled;
  dem::Moduli bulk;
  BarTime time;
  Json loads = Json::object(); // what each of them has found, by its word, as in summary.json

  // With the measured axial rigidity and Poisson ratio, on the bounding section or the effective one.
  Rod rod(bool effective) const;
  Rod oscillating_rod(bool effective) const; // from the middle of the clamped spheres to the end plane

  void add(BarLoad load, const StaticTest &at_rest);
  void add(BarLoad load, const Oscillation &oscillation);
  void add(const Impact &impact, double struck_velocity); // m/s
};

// The common columns, of which a bar without platens fills some, and its own.
std::vector<std::string> bar_columns();
// With a ledger: energies are kept; without it their columns are NaN.
std::vector<CsvCell> bar_row(const BarSample &s, BarLoad load, const BarResults &results, bool ledger);

Json summary_of(const Scene &scene, const BarResults &results, const std::string &status);
// For the screen and the log.
std::string report_of(const BarResults &results);

} // namespace platen::apps
