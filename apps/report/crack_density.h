// Where bonds broke: a map over distance from the axis (discs and long bars: from the middle plane) and
// height.
#pragma once

#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// A crack or a bond as a place before the test.
struct Place {
  double x = 0, y = 0, z = 0; // m
};

// One row of cracks.csv.
struct Crack {
  Place place; // m, midpoint of the two spheres before the test where they are known, else of the break
  double nx = 0, ny = 0, nz = 0; // unit normal
  double area = 0;               // m2
  bool in_tension = true;        // else in shear
  double time = 0;               // s
};

// Cracks up to `time` (s). Throws InputError where a column is missing or a mode is neither tension nor
// shear.
std::vector<Crack> cracks_until(const CsvTable &cracks, double time, const Spheres &before_test);

// Midpoints of all bonds in a frame of bonds.pvd.
std::vector<Place> bond_midpoints(const Frame &frame);

struct DensityMap {
  int columns = 0, rows = 0;  // over r or |x| in [0, radius], over z in [bottom, top]
  double radius = 0;          // m
  bool is_plane = false;      // |x|, distance from the plane x = 0; else r, from the axis
  double bottom = 0, top = 0; // m
  bool is_share = false;      // broken / initial bonds of the cell; else breaks per cubic metre
  std::vector<double> values; // row by row from the bottom; NaN where a cell has too few bonds to say

  double at(int column, int row) const { return values[static_cast<std::size_t>(row * columns + column)]; }
};

// Counts cracks on a grid of cells about as high as wide. `bonds` are all bonds before the test; empty where
// they are not known. What lies outside the extent is counted in the outermost cell.
DensityMap crack_density(const std::vector<Crack> &cracks, const std::vector<Place> &bonds,
                         const Extent &extent);

} // namespace platen::apps::report
