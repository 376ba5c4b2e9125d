// The sides of a specimen that platens press: stresses on each, and the path of all three stresses. Pictures
// need an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "apps/report/chart.h"
#include "apps/report/run_folder.h"
#include "coupling/side.h"

namespace platen::apps::report {

using coupling::Side;

struct TableOfFigures;

// Those with platens, as the columns of the history tell: bottom and top, and further ones of a box.
std::vector<Side> sides_of(const Run &run);
bool has_further_sides(const Run &run);

// Axes of its picture, across and up: 0 x, 1 y, 2 z.
constexpr std::array<int, 2> plane_of(Side side) {
  const int axis = coupling::axis_of(side);
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

// Pa on a platen, one per row of the history; compression positive.
const std::vector<double> &stress_on(const Run &run, Side side);

// Pa along x, y and z, one per row: the mean of the platens there, else the pressure of a cell or wall.
std::array<std::vector<double>, 3> axis_stresses(const Run &run);

// p = (s_x + s_y + s_z) / 3 and q = sqrt(3 J_2) of the stresses along the axes, taken for principal ones; Pa.
struct StressPath {
  std::vector<double> mean, deviator;
};
StressPath stress_path_of(const Run &run);
// Whether anything presses the sides.
bool has_stress_path(const Run &run);

// Of its curves in every picture: a colour an axis, the high side dashed.
Colour side_colour(Side side);
Stroke side_stroke(Side side);

// A curve for each side against axial strain. The run must have further sides.
void draw_side_stresses(const Run &run, const std::filesystem::path &png);
// q against p, of those runs that have a path; one must. The peak of each is marked.
void draw_stress_path(const std::vector<Run> &runs, const std::filesystem::path &png);

// A row for each side: largest stress, stress at the peak, work of friction. The run must have further sides.
TableOfFigures table_of_sides(const Run &run);

} // namespace platen::apps::report
