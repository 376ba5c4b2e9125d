// Where and when bonds broke: as discs in the half specimen, and as a map over distance from the axis (discs
// and long bars: from the middle plane) and height. Pictures need an X server (display.h) and throw
// OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// One row of cracks.csv.
struct Crack {
  Position place{}; // midpoint of the two spheres before the test where they are known, else of the break
  std::array<double, 3> normal{}; // of unit length
  double area = 0;                // m2
  bool in_tension = true;         // else in shear
  double time = 0;                // s
};

// Cracks up to `time` (s). Throws InputError where a column is missing or a mode is neither tension nor
// shear.
std::vector<Crack> cracks_until(const CsvTable &cracks, double time, const Spheres &before_test);

// Midpoints of all bonds in a frame of bonds.pvd.
std::vector<Position> bond_midpoints(const Frame &frame);

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
DensityMap crack_density(const std::vector<Crack> &cracks, const std::vector<Position> &bonds,
                         const Extent &extent);

// The bonds broken up to Run::pattern_time() as discs of their areas in the half specimen: those that broke
// in tension on the left, in shear on the right. `before_test` is the first frame of the specimen. The run
// must have cracks.
void draw_cracks(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

// The same coloured by when they broke: before the peak on the left, after it on the right.
void draw_crack_times(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

// The same, counted over radius and height: as a share of the initial bonds where bonds.pvd is there, else
// per volume. Height upwards, radius to both sides (the map on the right, its mirror image on the left).
void draw_crack_density(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

} // namespace platen::apps::report
