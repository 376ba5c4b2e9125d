#include "apps/report/crack_density.h"

#include <vtkCell.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

std::size_t cell_of(const DensityMap &map, const Place &place) {
  const double r = (map.is_plane ? std::abs(place.x) : std::hypot(place.x, place.y)) / map.radius,
               z = (place.z - map.bottom) / (map.top - map.bottom);
  const int column = std::clamp(static_cast<int>(r * map.columns), 0, map.columns - 1);
  const int row = std::clamp(static_cast<int>(std::floor(z * map.rows)), 0, map.rows - 1);
  return static_cast<std::size_t>(row * map.columns + column);
}

std::vector<double> counts(const DensityMap &map, const std::vector<Place> &places) {
  std::vector<double> count(map.values.size(), 0.0);
  for (const Place &place : places)
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
    Crack crack{{x[k], y[k], z[k]}, nx[k], ny[k], nz[k], area[k], mode == "tension", times[k]};
    const auto first = row_of.find(std::llround(a[k])), second = row_of.find(std::llround(b[k]));
    if (first != row_of.end() && second != row_of.end()) {
      const std::size_t i = first->second, j = second->second;
      crack.place = {0.5 * (before_test.x0[i] + before_test.x0[j]),
                     0.5 * (before_test.y0[i] + before_test.y0[j]),
                     0.5 * (before_test.z0[i] + before_test.z0[j])};
    }
    cracks.push_back(crack);
  }
  return cracks;
}

std::vector<Place> bond_midpoints(const Frame &frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_frame(frame);
  std::vector<Place> places;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    if (grid->GetCellType(c) != VTK_LINE) continue;
    double first[3], second[3];
    vtkCell *line = grid->GetCell(c);
    line->GetPoints()->GetPoint(0, first);
    line->GetPoints()->GetPoint(1, second);
    places.push_back(
        {0.5 * (first[0] + second[0]), 0.5 * (first[1] + second[1]), 0.5 * (first[2] + second[2])});
  }
  return places;
}

DensityMap crack_density(const std::vector<Crack> &cracks, const std::vector<Place> &bonds,
                         const Extent &extent) {
  DensityMap map;
  // A box reaches to its corners; its map goes to the half width only, corners are counted in the outermost
  // column.
  map.radius = extent.half_width;
  map.is_plane = extent.is_plane();
  map.bottom = extent.bottom;
  map.top = extent.top;
  map.columns = 8;
  if (map.is_plane) map.columns = 12;
  map.rows = std::clamp(static_cast<int>(std::lround(map.columns * extent.height() / map.radius)), 4, 64);
  map.values.assign(static_cast<std::size_t>(map.columns * map.rows), 0.0);
  map.is_share = !bonds.empty();

  std::vector<Place> places;
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
