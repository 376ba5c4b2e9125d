// Computations of every step for a cell at finite strain: its forces (rubber, or metal that yields), and a
// check of its next position. All eight Gauss points are processed as one vector, compiled for each vector
// width of processors; the program chooses one when it starts, with the same bits from each (no contraction).
#include <cmath>
#include <cstddef>

#include "fem/hyperelastic_cell.h"
#include "fem/points.h"
#include "fem/widths.h"

namespace platen::fem {
namespace {

struct TensorOfPoints {
  Points of[9];
  PLATEN_INTO_CALLER Points &operator[](int k) { return of[k]; }
  PLATEN_INTO_CALLER const Points &operator[](int k) const { return of[k]; }
};

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

// Forces at the corners from the first Piola-Kirchhoff stress times the weight of each point.
PLATEN_INTO_CALLER void add_up_forces(const ReferenceCell &cell, const TensorOfPoints &p, CellForce &result) {
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
      force[3 * a + i] += sum;
    }
  }
}

// Elastic strain (logarithmic, shape only) of a deformation f that has yielded before: half the logarithm of
// F M F^T over J^(2/3), with the metric M of what has yielded.
PLATEN_INTO_CALLER void elastic_strain(const TensorOfPoints &f, const Points &root, const double *metric,
                                       Symmetric<Points> &e) {
  Symmetric<Points> m, b;
  for (int k = 0; k < 6; ++k)
    read(metric + 8 * k, m[k]);
  TensorOfPoints fm;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      fm[3 * i + k] = f[3 * i] * m[symmetric_index[0][k]] + f[3 * i + 1] * m[symmetric_index[1][k]] +
                      f[3 * i + 2] * m[symmetric_index[2][k]];
  const Points scale = 1 / (root * root);
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k)
      b[symmetric_index[i][k]] =
          scale * (fm[3 * i] * f[3 * k] + fm[3 * i + 1] * f[3 * k + 1] + fm[3 * i + 2] * f[3 * k + 2]);
  half_logarithm(b, e);
  const Points third = (e[0] + e[1] + e[2]) / 3; // of round-off
  for (int k = 0; k < 3; ++k)
    e[k] -= third;
}

// The metric after yielding: F^-1 exp(2 e) F^-T times J^(2/3), at the points that yielded.
PLATEN_INTO_CALLER void keep_metric(const TensorOfPoints &cof, const Points &j, const Points &root,
                                    const Symmetric<Points> &e, const bool *yields, double *metric) {
  Symmetric<Points> b;
  exponential_of_twice(e, b);
  const Points scale = root * root / (j * j);
  TensorOfPoints bc; // exp(2 e) times the cofactors
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      bc[3 * i + k] = b[symmetric_index[i][0]] * cof[k] + b[symmetric_index[i][1]] * cof[3 + k] +
                      b[symmetric_index[i][2]] * cof[6 + k];
  for (int i = 0; i < 3; ++i)
    for (int k = i; k < 3; ++k) {
      const Points value = scale * (cof[i] * bc[k] + cof[3 + i] * bc[3 + k] + cof[6 + i] * bc[6 + k]);
      for (int q = 0; q < 8; ++q)
        if (yields[q]) metric[8 * symmetric_index[i][k] + q] = value[q];
    }
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
  add_up_forces(cell, p, result);
  return result;
}

PLATEN_WIDTHS CellForce cell_force(const NeoHookean &law, const J2Plasticity &plastic,
                                   const ReferenceCell &cell, const Corners &displacement,
                                   const PlasticPoints &before, PlasticPoints &after) {
  TensorOfPoints f, cof;
  Points weight, j, root;
  read(cell.weight.data(), weight);
  deformation_gradient(cell, displacement, f);
  cofactors(f, cof);
  determinants(f, cof, j);
  double volume = 0; // m^3
  for (int q = 0; q < 8; ++q) {
    volume += weight[q] * j[q];
    root[q] = std::cbrt(j[q]);
  }
  Symmetric<Points> e;
  elastic_strain(f, root, &before.metric[0][0], e);
  const Points norm2 =
      e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + 2 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  after = before;
  Points share = 1 - Points{};
  bool yields[8], any = false;
  for (std::size_t q = 0; q < 8; ++q) {
    const auto returned = plastic(std::sqrt(2.0 / 3.0 * norm2[q]), before.plastic_strain[q]);
    share[q] = returned.share;
    after.plastic_strain[q] = returned.plastic_strain;
    yields[q] = returned.plastic_strain > before.plastic_strain[q];
    any = any || yields[q];
  }
  for (int k = 0; k < 6; ++k)
    e[k] = share * e[k];
  if (any) keep_metric(cof, j, root, e, yields, &after.metric[0][0]);
  const double ratio = volume / cell.volume, along = law.volume_stress(ratio);
  const Points energy = weight * law.shear_modulus * share * share * norm2;
  CellForce result;
  result.energy = cell.volume * law.volume_energy(ratio);
  for (int q = 0; q < 8; ++q)
    result.energy += energy[q];
  const Points stress = 2 * law.shear_modulus * weight / j, uniform = along * weight;
  TensorOfPoints p;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      p[3 * i + k] = stress * (e[symmetric_index[i][0]] * cof[k] + e[symmetric_index[i][1]] * cof[3 + k] +
                               e[symmetric_index[i][2]] * cof[6 + k]) +
                     uniform * cof[3 * i + k];
  add_up_forces(cell, p, result);
  return result;
}

PLATEN_WIDTHS double add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                                const Corners &displacement, CellForce &result) {
  if (own.share == 0) {
    result.energy *= Fibres::rest_of_torn;
    for (Vector3 &force : result.force)
      force = Fibres::rest_of_torn * force;
  }
  TensorOfPoints f, p;
  Points weight;
  read(cell.weight.data(), weight);
  deformation_gradient(cell, displacement, f);
  for (int k = 0; k < 9; ++k)
    p[k] = Points{};
  double mean = 0;
  for (std::size_t family = 0; family < 2; ++family) {
    const Vector3 &d = own.direction[family];
    Points along[3], stretch, squared = Points{};
    for (int i = 0; i < 3; ++i) {
      along[i] = f[3 * i] * d.x + f[3 * i + 1] * d.y + f[3 * i + 2] * d.z;
      squared += along[i] * along[i];
    }
    for (int q = 0; q < 8; ++q)
      stretch[q] = std::sqrt(squared[q]);
    const double modulus = own.share * law.modulus[family];
    const Points strain = stretch - 1, force = modulus * weight * strain;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        p[3 * i + k] += force / stretch * along[i] * d[static_cast<std::size_t>(k)];
    for (int q = 0; q < 8; ++q) {
      result.energy += 0.5 * force[q] * strain[q];
      if (family == 0) mean += weight[q] * strain[q];
    }
  }
  add_up_forces(cell, p, result);
  return mean / cell.volume;
}

} // namespace platen::fem
