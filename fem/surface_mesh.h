// The outer surface of a body as plain arrays: all that the contact layer sees of a finite-element mesh.
#pragma once

#include <array>
#include <vector>

namespace platen::fem {

using Point = std::array<double, 3>;

// Quadrilaterals with their vertices counter-clockwise seen from outside the body, so that
// (v1 - v0) x (v3 - v0) points out of the solid. No duplicate vertices: faces that share a corner share its index.
struct SurfaceMesh {
  std::vector<Point> vertices;           // m, current
  std::vector<Point> velocities;         // m/s, one per vertex
  std::vector<std::array<int, 4>> faces; // vertex indices
  std::vector<int> face_tags;            // boundary id of each face (0 unless the body gives another)
};

} // namespace platen::fem
