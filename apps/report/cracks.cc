#include "apps/report/cracks.h"

#include <vtkCell.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

std::size_t cell_of(const DensityMap &map, const Position &place) {
  const double r = (map.is_plane ? std::abs(place[0]) : std::hypot(place[0], place[1])) / map.radius,
               z = (place[2] - map.bottom) / (map.top - map.bottom);
  const int column = std::clamp(static_cast<int>(r * map.columns), 0, map.columns - 1);
  const int row = std::clamp(static_cast<int>(std::floor(z * map.rows)), 0, map.rows - 1);
  return static_cast<std::size_t>(row * map.columns + column);
}

Position midpoint(const Position &a, const Position &b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

std::vector<double> counts(const DensityMap &map, const std::vector<Position> &places) {
  std::vector<double> count(map.values.size(), 0.0);
  for (const Position &place : places)
    ++count[cell_of(map, place)];
  return count;
}

} // namespace

std::vector<Crack> cracks_until(const CsvTable &table, double time, const Spheres &before_test) {
  std::unordered_map<long long, std::size_t> row_of;
  for (std::size_t k = 0; k < before_test.size(); ++k)
    row_of[before_test.id[k]] = k;

  const auto &times = table.column("time_s"), &x = table.column("x_m"), &y = table.column("y_m"),
             &z = table.column("z_m"), &nx = table.column("nx"), &ny = table.column("ny"),
             &nz = table.column("nz"), &area = table.column("area_m2"), &a = table.column("particle_a"),
             &b = table.column("particle_b");
  const auto modes = table.words.find("mode");
  if (modes == table.words.end()) throw InputError(table.file.string() + ": no column mode");
  std::vector<Crack> cracks;
  for (std::size_t k = 0; k < table.rows; ++k) {
    const std::string &mode = modes->second[k];
    if (mode != "tension" && mode != "shear")
      throw InputError(table.file.string() + ":" + std::to_string(k + 2) + ": mode \"" + mode +
                       "\" is neither tension nor shear");
    if (times[k] > time) continue;
    Crack crack{{x[k], y[k], z[k]}, {nx[k], ny[k], nz[k]}, area[k], mode == "tension", times[k]};
    const auto first = row_of.find(std::llround(a[k])), second = row_of.find(std::llround(b[k]));
    if (first != row_of.end() && second != row_of.end())
      crack.place = midpoint(before_test.initial[first->second], before_test.initial[second->second]);
    cracks.push_back(crack);
  }
  return cracks;
}

std::vector<Position> bond_midpoints(const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  std::vector<Position> places;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) != VTK_LINE) continue;
    Position first, second;
    vtkPoints *ends = grid->GetCell(c)->GetPoints();
    ends->GetPoint(0, first.data());
    ends->GetPoint(1, second.data());
    places.push_back(midpoint(first, second));
  }
  return places;
}

DensityMap crack_density(const std::vector<Crack> &cracks, const std::vector<Position> &bonds,
                         const Extent &extent) {
  DensityMap map;
  // A box reaches to its corners; its map goes to the half width only, corners are counted in the outermost
  // column.
  map.radius = extent.half_width;
  map.is_plane = extent.is_plane();
  map.bottom = extent.bottom;
  map.top = extent.top;
  map.columns = map.is_plane ? 12 : 8;
  map.rows = std::clamp(static_cast<int>(std::lround(map.columns * extent.height() / map.radius)), 4, 64);
  map.values.assign(static_cast<std::size_t>(map.columns * map.rows), 0.0);
  map.is_share = !bonds.empty();

  std::vector<Position> places;
  for (const Crack &crack : cracks)
    places.push_back(crack.place);
  const std::vector<double> broken = counts(map, places), initial = counts(map, bonds);
  constexpr double least_bonds = 5; // fewer tell nothing about a share
  const double high = extent.height() / map.rows, wide = map.radius / map.columns;
  for (std::size_t k = 0; k < map.values.size(); ++k) {
    const double column = static_cast<double>(k % static_cast<std::size_t>(map.columns));
    if (!map.is_share)
      map.values[k] = broken[k] / (high * (map.is_plane ? 4 * extent.half_depth * wide
                                                        : pi * wide * wide * (2 * column + 1)));
    else
      map.values[k] =
          initial[k] >= least_bonds ? broken[k] / initial[k] : std::numeric_limits<double>::quiet_NaN();
  }
  return map;
}

} // namespace platen::apps::report
