#include "apps/report/joined.h"

#include <vtkIncrementalOctreePointLocator.h>
#include <vtkNew.h>
#include <vtkPoints.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace platen::apps::report {

std::vector<vtkIdType> joined_points(vtkUnstructuredGrid &grid) {
  constexpr double nearly = 1e-6; // of the size: places are kept in single precision
  vtkNew<vtkPoints> places;
  places->SetDataTypeToDouble();
  vtkNew<vtkIncrementalOctreePointLocator> locator;
  locator->SetTolerance(nearly * grid.GetLength());
  locator->InitPointInsertion(places, grid.GetBounds());
  std::vector<vtkIdType> joined, first; // of each point; of each place
  for (vtkIdType k = 0; k < grid.GetNumberOfPoints(); ++k) {
    vtkIdType place = 0;
    if (locator->InsertUniquePoint(grid.GetPoint(k), place) != 0) first.push_back(k);
    joined.push_back(first[static_cast<std::size_t>(place)]);
  }
  return joined;
}

std::vector<Bounds> bounds_of_bodies(vtkUnstructuredGrid &grid) {
  const std::vector<vtkIdType> joined = joined_points(grid);
  std::vector<vtkIdType> parent(
      joined.size()); // the smallest point of what is known to hang together is last
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&parent](vtkIdType k) {
    while (parent[static_cast<std::size_t>(k)] != k)
      k = parent[static_cast<std::size_t>(k)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(k)])];
    return k;
  };
  const auto corner = [&](vtkIdType cell, vtkIdType k) {
    return joined[static_cast<std::size_t>(grid.GetCell(cell)->GetPointId(static_cast<int>(k)))];
  };
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell)
    for (vtkIdType k = 1; k < grid.GetCell(cell)->GetNumberOfPoints(); ++k) {
      const vtkIdType a = root(corner(cell, 0)), b = root(corner(cell, k));
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  std::map<vtkIdType, Bounds> bodies;
  for (vtkIdType cell = 0; cell < grid.GetNumberOfCells(); ++cell) {
    std::array<double, 6> box{}; // low x, high x, low y ...
    grid.GetCellBounds(cell, box.data());
    const auto [found, is_new] =
        bodies.try_emplace(root(corner(cell, 0)), Bounds{box[0], box[2], box[4], box[1], box[3], box[5]});
    for (std::size_t k = 0; k < 3; ++k) {
      found->second[k] = std::min(found->second[k], box[2 * k]);
      found->second[k + 3] = std::max(found->second[k + 3], box[2 * k + 1]);
    }
  }
  std::vector<Bounds> bounds;
  for (const auto &[point, box] : bodies)
    bounds.push_back(box);
  return bounds;
}

} // namespace platen::apps::report
