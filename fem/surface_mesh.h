// The outer surface of a body as plain arrays: all that the contact layer sees of a finite-element mesh.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::fem {

// Quadrilaterals with their vertices counter-clockwise seen from outside the body, so that
// (v1 - v0) x (v3 - v0) points out of the solid. No duplicate vertices: faces that share a corner share its
// index.
struct SurfaceMesh {
  std::vector<Vector3> vertices;         // m, current
  std::vector<Vector3> velocities;       // m/s, one per vertex
  std::vector<std::array<int, 4>> faces; // vertex indices
  std::vector<int> face_tags;            // boundary id of each face (0 unless the body gives another)
  // The vertices are those of the start plus one displacement and have one velocity.
  bool only_shifted = false;
};

// (i, j): normal displacement of corner i of a face per normal force on corner j (m/N); symmetric. With the
// weights w that a force at a place gives the corners, that place gives way by w^T C w.
using FaceCompliance = std::array<std::array<double, 4>, 4>;

// Area times mean outward normal of a face (m^2): exact for the bilinear face, flat or warped.
Vector3 face_area_vector(const SurfaceMesh &surface, std::size_t face);

// Sum of all area vectors (m^2): zero for a closed surface.
Vector3 total_area_vector(const SurfaceMesh &surface);

// Volume inside a closed surface (m^3), by the divergence theorem; exact for flat faces.
double enclosed_volume(const SurfaceMesh &surface);

// Faces without area (|area vector| below 1e-12 of their longest diagonal squared): no normal can be given to
// them.
std::vector<int> zero_area_faces(const SurfaceMesh &surface);

} // namespace platen::fem
