// A hexahedron of neo-Hookean rubber that does not lock: shape at 2 x 2 x 2 points, volume as one number for
// the cell (mean dilatation: Nagtegaal, Parks, Rice 1974; Simo, Taylor, Pister 1985, the three fields
// condensed). Its stored energy is
//   W = sum_q w_q mu/2 (J_q^(-2/3) tr F_q'F_q - 3) + V U(v/V),   v = sum_q w_q J_q,
// with v the exact volume of the trilinear cell (two Gauss points per axis integrate its Jacobian exactly).
// Forces and stiffness are the exact first and second derivatives, so energy balances in any scheme and the
// tangent is symmetric. Plain arrays, no deal.II, no allocation.
//
// The same hexahedron of a metal that yields: shape by its elastic logarithmic strain e and von Mises' law
// (j2_plasticity.h), sum_q w_q mu e_q:e_q, volume as above. Each point remembers the metric M, the inverse of
// the plastic right Cauchy-Green tensor, so that F M F^T is the elastic left one, and its plastic strain.
#pragma once

#include <array>
#include <cstddef>

#include "base/vector3.h"
#include "fem/materials/fibres.h"
#include "fem/materials/j2_plasticity.h"
#include "fem/materials/neo_hookean.h"

namespace platen::fem {

using Corners = std::array<Vector3, 8>; // x fastest, then y, then z
// A number at each Gauss point. The point is the last index, so that loops over it are vectorised.
using AtPoints = std::array<double, 8>;

// A cell in its stress-free state.
struct ReferenceCell {
  std::array<std::array<AtPoints, 3>, 8>
      gradient{};                        // 1/m, of each corner's shape function: corner, component
  AtPoints weight{};                     // m^3
  std::array<double, 8> corner_volume{}; // m^3, triple product of the edges at each corner
  std::array<double, 8> node_volume{};   // m^3, integral of each corner's shape function
  double volume = 0;                     // m^3

  Vector3 gradient_at(std::size_t point, std::size_t corner) const {
    const auto &of = gradient[corner];
    return {of[0][point], of[1][point], of[2][point]};
  }
};

// What the points of a cell of metal remember.
struct PlasticPoints {
  std::array<AtPoints, 6> metric{}; // 1; xx, yy, zz, yz, zx, xy; of determinant 1
  AtPoints plastic_strain{};        // 1, equivalent

  PlasticPoints() { metric[0].fill(1), metric[1].fill(1), metric[2].fill(1); }
};

struct CellForce {
  Corners force{};   // N, derivative of the stored energy by the corners' positions
  double energy = 0; // J
};

// Row 3 a + i, column 3 b + k: derivative of force a, i by position b, k; N/m. Symmetric.
using CellStiffness = std::array<double, 24 * 24>;

// Triple product of the three edges that meet at each corner, m^3: positive where the corner is not folded.
std::array<double, 8> corner_volumes(const Corners &place);

// Smallest of the volume ratios at Gauss points and corners. Check it with is_inverted() before forces are
// computed.
double smallest_volume_ratio(const ReferenceCell &cell, const Corners &displacement, const Corners &place);

CellForce cell_force(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement);
// Of metal, from the memory before the step; writes the one after it. `law`: elastic constants.
CellForce cell_force(const NeoHookean &law, const J2Plasticity &plastic, const ReferenceCell &cell,
                     const Corners &displacement, const PlasticPoints &before, PlasticPoints &after);
// Adds the forces and energy of fibres, after a torn cell's resin has been reduced to what is left of it.
// Returns the mean strain of the first direction.
double add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                  const Corners &displacement, CellForce &result);
void add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                const Corners &displacement, CellStiffness &result);
// `yielded`: of metal, the stiffness of its elastic strain, to the first order in that strain: an upper bound
// while it yields.
CellStiffness cell_stiffness(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement,
                             const PlasticPoints *yielded = nullptr);

// Mean over the cell, weighted by current volume.
struct CellStress {
  Tensor cauchy{};         // Pa
  double volume_ratio = 1; // v/V
};
CellStress cell_stress(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement);
CellStress cell_stress(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement,
                       const PlasticPoints &points);
void add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                const Corners &displacement, CellStress &result);
// J, lost since the start: the integral of the flow stress over the plastic strain.
double plastic_work(const J2Plasticity &plastic, const ReferenceCell &cell, const PlasticPoints &points);

// Upper bound of the eigenvalues of M^-1 K (1/s^2), M the diagonal of the corners' masses (kg): the 16th root
// of the trace of the 16th power, at most 24^(1/16) = 1.22 times the largest.
double eigenvalue_bound(const CellStiffness &stiffness, const std::array<double, 8> &mass);

// Follower pressure, always normal to a deforming face: forces, work and load stiffness of bilinear
// quadrilaterals, all in closed form.
//
// With x = m + a s + b t + c s t on [-1, 1]^2 the area vector is (a x b) + s (a x c) + t (c x b): linear, so
// that its products with the shape functions integrate to
//   n_A = a x b + s_A/3 a x c + t_A/3 c x b   at corner A (s_A, t_A = +-1),
// and the force there is -p n_A. The n_A of a face sum to its area vector; over a closed surface n_A is the
// exact derivative of the enclosed volume by the corner's position, whether faces are flat or warped.

using FaceCorners = std::array<Vector3, 4>; // counter-clockwise seen from outside

// Part of the area vector that belongs to each corner, m^2; the force of a pressure p there is -p times it.
FaceCorners corner_areas(const FaceCorners &place);

// Volume that a face sweeps outwards while its corners move straight from one position to another, m^3, exact
// (the rate is a quadratic polynomial along the path, two Gauss points). A constant pressure p on it does the
// work -p times that volume. Summed over a closed surface it is the change of the enclosed volume.
double swept_volume(const FaceCorners &from, const FaceCorners &to);

// Row 3 A + i, column 3 B + k: derivative of n_A, i by position B, k; m. Not symmetric, unless summed over a
// closed surface.
std::array<double, 144> corner_area_gradient(const FaceCorners &place);

} // namespace platen::fem
