// Closest point of a bilinear quadrilateral, flat or warped, to the origin. The query point is the origin:
// callers give corners relative to the particle's centre, so that no digit of the gap is lost far from the
// origin of the scene.
#pragma once

#include <array>

#include "base/vector3.h"

namespace platen::coupling {

enum class Feature { face, edge, vertex };

using Quad = std::array<Vector3, 4>; // corners, counter-clockwise seen from outside

// x(u, v) = sum w_i x_i with w = ((1-u)(1-v), u(1-v), uv, (1-u)v), 0 <= u, v <= 1.
struct ClosestPoint {
  Vector3 point;                   // m, from the query point; sum w_i x_i to round-off
  std::array<double, 4> weights{}; // w_0 + w_1 + w_2 + w_3 = 1 exactly, added in this order
  double u = 0, v = 0;
  double distance_squared = 0; // m^2
  Feature feature = Feature::face;
  // Edge k joins corners k and k + 1; vertex k is corner k; 0 for the face.
  int local = 0;
};

// Global minimum. Exact to round-off for parallelograms (one linear solve) and for edges and corners of any
// quad; otherwise by Newton's method, safeguarded, to round-off. Quads with coincident corners, without area
// or of a single point are legal. No NaN for finite corners.
ClosestPoint closest_point(const Quad &corners);

// Largest distance (m) of the corners from the mean plane of a quad, with the unit normal of that plane, for
// which the query point has a single closest point on it; negative where the quad is not convex.
double single_closest_within(const Quad &corners, const Vector3 &normal);

// Orders candidates: the smallest comes first. Near an edge, the closest point on one face and the edge point
// of its neighbour are at the same distance to round-off, although their directions may differ by the root of
// it (1e-8); so a face goes before an edge and an edge before a vertex when squared distances agree to 1e-14.
double preference(const ClosestPoint &point); // m^2

// Weights at (u, v); their sum is exactly 1.
std::array<double, 4> bilinear_weights(double u, double v);

// Unit outward normal at (u, v); zero where the quad has no area.
Vector3 bilinear_normal(const Quad &corners, double u, double v);

// Derivatives of sum w_i f_i with respect to u and v.
Vector3 derivative_u(const Quad &values, double v);
Vector3 derivative_v(const Quad &values, double u);

} // namespace platen::coupling
