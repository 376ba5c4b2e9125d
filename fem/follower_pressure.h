// Pressure that stays at right angles to a deforming face: forces, work and load stiffness of bilinear
// quadrilaterals, all in closed form.
//
// With x = m + a s + b t + c s t on [-1, 1]^2 the area vector is (a x b) + s (a x c) + t (c x b): linear, so
// that its products with the shape functions integrate to
//   n_A = a x b + s_A/3 a x c + t_A/3 c x b   at corner A (s_A, t_A = +-1),
// and the force there is -p n_A. The n_A of a face sum to its area vector; over a closed surface n_A is the
// exact derivative of the enclosed volume by the corner's place, whether faces are flat or warped.
#pragma once

#include <array>

#include "base/vector3.h"

namespace platen::fem {

using FaceCorners = std::array<Vector3, 4>; // counter-clockwise seen from outside

// Share of the area vector that belongs to each corner, m^2; pressure p pushes there with -p times it.
FaceCorners corner_areas(const FaceCorners &place);

// Volume that a face sweeps outwards while its corners go straight from one place to another, m^3, exact
// (the rate is a square polynomial of the path, two Gauss points). A constant pressure p on it does the work
// -p times that. Summed over a closed surface it is the change of the enclosed volume.
double swept_volume(const FaceCorners &from, const FaceCorners &to);

// Row 3 A + i, column 3 B + k: derivative of n_A, i by place B, k; m. Not symmetric, unless summed over a
// closed surface.
std::array<double, 144> corner_area_gradient(const FaceCorners &place);

} // namespace platen::fem
