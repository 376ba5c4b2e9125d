// Computations of every step for a cell of rubber: its forces, and a check of its next position. All eight
// Gauss points are processed as one vector, compiled for each vector width of processors; the program chooses
// one when it starts, with the same bits from each (no contraction).
#include <cmath>
#include <cstddef>
#include <cstring>

#include "fem/hyperelastic_cell.h"
#include "fem/widths.h"

#define PLATEN_INTO_CALLER inline __attribute__((always_inline))

namespace platen::fem {
namespace {

typedef double Points __attribute__((vector_size(64)));

struct TensorOfPoints {
  Points of[9];
  PLATEN_INTO_CALLER Points &operator[](int k) { return of[k]; }
  PLATEN_INTO_CALLER const Points &operator[](int k) const { return of[k]; }
};

PLATEN_INTO_CALLER void read(const double *from, Points &to) {
  std::memcpy(&to, from, sizeof to);
}

PLATEN_INTO_CALLER void deformation_gradient(const ReferenceCell &cell, const Corners &displacement,
                                             TensorOfPoints &f) {
  const double *gradient = &cell.gradient[0][0][0], *u = &displacement[0].x;
  for (int k = 0; k < 9; ++k)
    f[k] = identity_tensor[static_cast<std::size_t>(k)] - Points{};
  for (int a = 0; a < 8; ++a) {
    Points g[3];
    for (int c = 0; c < 3; ++c)
      read(gradient + 8 * (3 * a + c), g[c]);
    for (int k = 0; k < 9; ++k)
      f[k] += u[3 * a + k / 3] * g[k % 3];
  }
}

// Formulas of neo_hookean.h.
PLATEN_INTO_CALLER void cofactors(const TensorOfPoints &f, TensorOfPoints &cof) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const int i1 = 3 * ((i + 1) % 3), i2 = 3 * ((i + 2) % 3), k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      cof[3 * i + k] = f[i1 + k1] * f[i2 + k2] - f[i1 + k2] * f[i2 + k1];
    }
}
PLATEN_INTO_CALLER void determinants(const TensorOfPoints &f, const TensorOfPoints &cof, Points &j) {
  j = f[0] * cof[0] + f[1] * cof[1] + f[2] * cof[2];
}

} // namespace

PLATEN_WIDTHS double smallest_volume_ratio(const ReferenceCell &cell, const Corners &displacement,
                                           const Corners &place) {
  const std::array<double, 8> corners = corner_volumes(place);
  double smallest = corners[0] / cell.corner_volume[0];
  const auto take = [&](double ratio) {
    if (!(ratio >= smallest)) smallest = ratio; // passes on NaN
  };
  for (std::size_t c = 1; c < 8; ++c)
    take(corners[c] / cell.corner_volume[c]);
  TensorOfPoints f, cof;
  Points j;
  deformation_gradient(cell, displacement, f);
  cofactors(f, cof);
  determinants(f, cof, j);
  for (int q = 0; q < 8; ++q)
    take(j[q]);
  return smallest;
}

PLATEN_WIDTHS CellForce cell_force(const NeoHookean &law, const ReferenceCell &cell,
                                   const Corners &displacement) {
  TensorOfPoints f, cof;
  Points weight, j, shape;
  read(cell.weight.data(), weight);
  deformation_gradient(cell, displacement, f);
  cofactors(f, cof);
  determinants(f, cof, j);
  double volume = 0; // m^3
  for (int q = 0; q < 8; ++q) {
    volume += weight[q] * j[q];
    shape[q] = weight[q] * law.shape_factor(j[q]);
  }
  const double ratio = volume / cell.volume, along = law.volume_stress(ratio);
  Points norm2 = f[0] * f[0];
  for (int k = 1; k < 9; ++k)
    norm2 += f[k] * f[k];
  const Points of_cofactors = weight * along - shape * norm2 / (3 * j);
  const Points energy = 0.5 * (shape * norm2 - 3 * law.shear_modulus * weight);
  CellForce result;
  result.energy = cell.volume * law.volume_energy(ratio);
  for (int q = 0; q < 8; ++q)
    result.energy += energy[q];
  TensorOfPoints p; // first Piola-Kirchhoff stress times weight
  for (int k = 0; k < 9; ++k)
    p[k] = shape * f[k] + of_cofactors * cof[k];
  const double *gradient = &cell.gradient[0][0][0];
  double *force = &result.force[0].x;
  for (int a = 0; a < 8; ++a) {
    Points g[3];
    for (int c = 0; c < 3; ++c)
      read(gradient + 8 * (3 * a + c), g[c]);
    for (int i = 0; i < 3; ++i) {
      const Points contribution = p[3 * i] * g[0] + p[3 * i + 1] * g[1] + p[3 * i + 2] * g[2];
      double sum = 0;
      for (int q = 0; q < 8; ++q)
        sum += contribution[q];
      force[3 * a + i] = sum;
    }
  }
  return result;
}

} // namespace platen::fem
