// Elements in a frame of a body have corners of their own; what belongs together is found by place.
#pragma once

#include <vtkUnstructuredGrid.h>

#include <array>
#include <vector>

namespace platen::apps::report {

// For each point the first one at the same place, to 1e-6 of the grid's size.
std::vector<vtkIdType> joined_points(vtkUnstructuredGrid &grid);

using Bounds = std::array<double, 6>; // m: low x, y, z, high x, y, z

// Of each body of elements that share corners, in the order of their first elements: two supports are two.
std::vector<Bounds> bounds_of_bodies(vtkUnstructuredGrid &grid);

} // namespace platen::apps::report
