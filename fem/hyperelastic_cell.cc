#include "fem/hyperelastic_cell.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/portable.h"
#include "fem/materials/logarithmic_strain.h"

namespace platen::fem {

namespace {

using TensorAtPoints = std::array<AtPoints, 9>;

TensorAtPoints deformation_gradient(const ReferenceCell &cell, const Corners &displacement) {
  TensorAtPoints f;
  for (std::size_t k = 0; k < 9; ++k) {
    f[k].fill(identity_tensor[k]);
    for (std::size_t a = 0; a < 8; ++a) {
      const double u = displacement[a][k / 3];
      for (std::size_t q = 0; q < 8; ++q)
        f[k][q] += u * cell.gradient[a][k % 3][q];
    }
  }
  return f;
}

Tensor tensor_at(const TensorAtPoints &f, std::size_t q) {
  return {f[0][q], f[1][q], f[2][q], f[3][q], f[4][q], f[5][q], f[6][q], f[7][q], f[8][q]};
}

// F times the metric, for the elastic left Cauchy-Green tensor.
Tensor times_metric(const Tensor &f, const PlasticPoints &points, std::size_t q) {
  Tensor product{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < 3; ++l)
        product[3 * i + k] +=
            f[3 * i + l] * points.metric[static_cast<std::size_t>(symmetric_index[l][k])][q];
  return product;
}

Symmetric<double> elastic_left_tensor(const Tensor &f, const PlasticPoints &points, std::size_t q) {
  const Tensor fm = times_metric(f, points, q);
  Symmetric<double> b;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = i; k < 3; ++k)
      b[symmetric_index[i][k]] =
          fm[3 * i] * f[3 * k] + fm[3 * i + 1] * f[3 * k + 1] + fm[3 * i + 2] * f[3 * k + 2];
  return b;
}

// All points of a deformed cell.
struct Deformed {
  TensorAtPoints f, cof;
  AtPoints j;
  double volume = 0; // m^3, v

  Deformed(const ReferenceCell &cell, const Corners &displacement)
      : f(deformation_gradient(cell, displacement)) {
    for (std::size_t q = 0; q < 8; ++q) {
      const Tensor own = tensor_at(f, q), cofactors = cofactor(own);
      for (std::size_t k = 0; k < 9; ++k)
        cof[k][q] = cofactors[k];
      j[q] = determinant(own, cofactors);
    }
    for (std::size_t q = 0; q < 8; ++q)
      volume += cell.weight[q] * j[q];
  }
};

constexpr std::array<double, 4> s_of = {-1, 1, 1, -1}, t_of = {-1, -1, 1, 1};

struct Bilinear {
  Vector3 a{}, b{}, c{};
  explicit Bilinear(const FaceCorners &x)
      : a(0.25 * ((x[1] + x[2]) - (x[0] + x[3]))),
        b(0.25 * ((x[2] + x[3]) - (x[0] + x[1]))),
        c(0.25 * ((x[0] + x[2]) - (x[1] + x[3]))) {}
};

} // namespace

std::array<double, 8> corner_volumes(const Corners &x) {
  std::array<double, 8> volumes;
  for (std::size_t c = 0; c < 8; ++c)
    volumes[c] = dot(cross(x[c | 1u] - x[c & 6u], x[c | 2u] - x[c & 5u]), x[c | 4u] - x[c & 3u]);
  return volumes;
}

CellStiffness cell_stiffness(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement,
                             const PlasticPoints *yielded) {
  const Deformed at(cell, displacement);
  const double ratio = at.volume / cell.volume, along = law.volume_stress(ratio);
  CellStiffness k{};
  Corners swelling{}; // m^2, derivative of the volume by each corner's position
  for (std::size_t q = 0; q < 8; ++q) {
    const double w = cell.weight[q], j = at.j[q], shape = w * law.shape_factor(j);
    const Tensor f = tensor_at(at.f, q), cof = tensor_at(at.cof, q);
    const Tensor fm = yielded ? times_metric(f, *yielded, q) : f;
    double third = squared_norm(f) / 3;
    if (yielded) {
      const Symmetric<double> b = elastic_left_tensor(f, *yielded, q);
      third = (b[0] + b[1] + b[2]) / 3;
    }
    const double push = w * along * j, back = shape * third - push;
    Corners reference, g, h; // gradient in reference and current position; F (times M) times the first
    Corners to_metric;       // M times the first
    for (std::size_t a = 0; a < 8; ++a) {
      reference[a] = cell.gradient_at(q, a);
      to_metric[a] = reference[a];
      if (yielded)
        for (int i = 0; i < 3; ++i) {
          to_metric[a][i] = 0;
          for (int l = 0; l < 3; ++l)
            to_metric[a][i] +=
                yielded->metric[static_cast<std::size_t>(symmetric_index[i][l])][q] * reference[a][l];
        }
      g[a] = (1 / j) * (cof * reference[a]);
      h[a] = fm * reference[a];
      swelling[a] = swelling[a] + w * j * g[a];
    }
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 8; ++b) {
        const double direct = shape * dot(reference[a], to_metric[b]);
        for (std::size_t i = 0; i < 3; ++i) {
          double *row = &k[24 * (3 * a + i) + 3 * b];
          row[i] += direct;
          for (std::size_t l = 0; l < 3; ++l)
            row[l] += push * g[a][i] * g[b][l] + back * g[b][i] * g[a][l] +
                      shape * (-2.0 / 3.0) * (g[b][l] * (h[a][i] - third * g[a][i]) + h[b][l] * g[a][i]);
        }
      }
  }
  const double c = law.volume_modulus(ratio) / cell.volume;
  for (std::size_t m = 0; m < 24; ++m)
    for (std::size_t n = 0; n < 24; ++n)
      k[24 * m + n] += c * swelling[m / 3][m % 3] * swelling[n / 3][n % 3];
  return k;
}

CellStress cell_stress(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement) {
  const Deformed at(cell, displacement);
  CellStress result;
  result.volume_ratio = at.volume / cell.volume;
  for (std::size_t q = 0; q < 8; ++q) {
    const Tensor f = tensor_at(at.f, q);
    const double factor = cell.weight[q] * law.shape_factor(at.j[q]) / at.volume, third = squared_norm(f) / 3;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        result.cauchy[3 * i + k] += factor * (f[3 * i] * f[3 * k] + f[3 * i + 1] * f[3 * k + 1] +
                                              f[3 * i + 2] * f[3 * k + 2] - (i == k ? third : 0.0));
  }
  for (std::size_t i = 0; i < 3; ++i)
    result.cauchy[4 * i] += law.volume_stress(result.volume_ratio);
  return result;
}

CellStress cell_stress(const NeoHookean &law, const ReferenceCell &cell, const Corners &displacement,
                       const PlasticPoints &points) {
  const Deformed at(cell, displacement);
  CellStress result;
  result.volume_ratio = at.volume / cell.volume;
  for (std::size_t q = 0; q < 8; ++q) {
    Symmetric<double> b = elastic_left_tensor(tensor_at(at.f, q), points, q), e;
    const double root = std::cbrt(at.j[q]), factor = 2 * law.shear_modulus * cell.weight[q] / at.volume;
    for (double &x : b.of)
      x /= root * root;
    half_logarithm(b, e);
    const double third = (e[0] + e[1] + e[2]) / 3;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        result.cauchy[3 * i + k] += factor * (e[symmetric_index[i][k]] - (i == k ? third : 0.0));
  }
  for (std::size_t i = 0; i < 3; ++i)
    result.cauchy[4 * i] += law.volume_stress(result.volume_ratio);
  return result;
}

// With v = F d and c the gradient of a corner's shape function along d, its force is w E (1 - 1/l) c v.
void add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                const Corners &displacement, CellStiffness &result) {
  if (own.share == 0)
    for (double &k : result)
      k *= Fibres::rest_of_torn;
  const TensorAtPoints f = deformation_gradient(cell, displacement);
  for (std::size_t q = 0; q < 8; ++q)
    for (std::size_t family = 0; family < 2; ++family) {
      const Vector3 along = tensor_at(f, q) * own.direction[family];
      const double stretch = norm(along), spring = own.share * law.modulus[family] * cell.weight[q];
      std::array<double, 8> c;
      for (std::size_t a = 0; a < 8; ++a)
        c[a] = dot(cell.gradient_at(q, a), own.direction[family]);
      for (std::size_t m = 0; m < 24; ++m)
        for (std::size_t n = 0; n < 24; ++n) {
          const double across = m % 3 == n % 3 ? 1 - 1 / stretch : 0.0;
          result[24 * m + n] += spring * c[m / 3] * c[n / 3] *
                                (across + along[m % 3] * along[n % 3] / (stretch * stretch * stretch));
        }
    }
}

void add_fibres(const Fibres &law, const FibreCell &own, const ReferenceCell &cell,
                const Corners &displacement, CellStress &result) {
  if (own.share == 0)
    for (double &stress : result.cauchy)
      stress *= Fibres::rest_of_torn;
  const TensorAtPoints f = deformation_gradient(cell, displacement);
  for (std::size_t q = 0; q < 8; ++q)
    for (std::size_t family = 0; family < 2; ++family) {
      const Vector3 along = tensor_at(f, q) * own.direction[family];
      const double stretch = norm(along);
      const double factor = own.share * law.modulus[family] * cell.weight[q] * (1 - 1 / stretch) /
                            (cell.volume * result.volume_ratio);
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          result.cauchy[3 * i + k] += factor * along[i] * along[k];
    }
}

double plastic_work(const J2Plasticity &plastic, const ReferenceCell &cell, const PlasticPoints &points) {
  double work = 0;
  for (std::size_t q = 0; q < 8; ++q)
    work += cell.weight[q] * plastic.hardening.at(points.plastic_strain[q]).work;
  return work;
}

double eigenvalue_bound(const CellStiffness &stiffness, const std::array<double, 8> &mass) {
  CellStiffness a, b;
  double size = 0;
  for (std::size_t m = 0; m < 24; ++m)
    for (std::size_t n = 0; n < 24; ++n) {
      a[24 * m + n] =
          0.5 * (stiffness[24 * m + n] + stiffness[24 * n + m]) / std::sqrt(mass[m / 3] * mass[n / 3]);
      size = std::max(size, std::abs(a[24 * m + n]));
    }
  if (!(size > 0)) return size;
  for (double &x : a)
    x /= size;
  double power = 1, logarithm = 0; // the 2^n-th power is exp(logarithm) times a
  for (int squaring = 0; squaring < 3; ++squaring) {
    double largest = 0;
    for (std::size_t m = 0; m < 24; ++m) {
      double *row = &b[24 * m];
      std::fill(row, row + 24, 0.0);
      for (std::size_t l = 0; l < 24; ++l)
        for (std::size_t n = 0; n < 24; ++n)
          row[n] += a[24 * m + l] * a[24 * l + n];
      for (std::size_t n = 0; n < 24; ++n)
        largest = std::max(largest, std::abs(row[n]));
    }
    for (std::size_t m = 0; m < b.size(); ++m)
      a[m] = b[m] / largest;
    power *= 2;
    logarithm = 2 * logarithm + portable::log(largest);
  }
  double trace = 0; // of the squared matrix: the 16th power
  for (const double x : a)
    trace += x * x;
  return size * portable::exp((2 * logarithm + portable::log(trace)) / (2 * power));
}

FaceCorners corner_areas(const FaceCorners &place) {
  const Bilinear face(place);
  const Vector3 middle = cross(face.a, face.b), along = (1.0 / 3) * cross(face.a, face.c),
                across = (1.0 / 3) * cross(face.c, face.b);
  FaceCorners areas;
  for (std::size_t k = 0; k < 4; ++k)
    areas[k] = middle + s_of[k] * along + t_of[k] * across;
  return areas;
}

double swept_volume(const FaceCorners &from, const FaceCorners &to) {
  const double off = 0.5 / std::sqrt(3.0);
  double volume = 0;
  for (const double fraction : {0.5 - off, 0.5 + off}) {
    FaceCorners place;
    for (std::size_t k = 0; k < 4; ++k)
      place[k] = (1 - fraction) * from[k] + fraction * to[k];
    const FaceCorners areas = corner_areas(place);
    for (std::size_t k = 0; k < 4; ++k)
      volume += 0.5 * dot(areas[k], to[k] - from[k]);
  }
  return volume;
}

std::array<double, 144> corner_area_gradient(const FaceCorners &place) {
  const Bilinear face(place);
  std::array<double, 144> gradient;
  for (std::size_t m = 0; m < 4; ++m)
    for (std::size_t n = 0; n < 4; ++n) {
      const double s = s_of[n], t = t_of[n], st = s * t, third_s = s_of[m] / 3, third_t = t_of[m] / 3;
      // The change of n_m for a displacement d of corner n is d x w.
      const Vector3 w = 0.25 * ((s * face.b - t * face.a) + third_s * (s * face.c - st * face.a) +
                                third_t * (st * face.b - t * face.c));
      const std::array<double, 9> block = {0, w[2], -w[1], -w[2], 0, w[0], w[1], -w[0], 0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
          gradient[12 * (3 * m + i) + 3 * n + k] = block[3 * i + k];
    }
  return gradient;
}

} // namespace platen::fem
