#include "dem/measure/coarse_grain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/pi.h"

namespace platen::dem {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Of the determinant of the spheres' scatter about a node over the cube of its mean; below it they lie in a
// plane or on a line.
constexpr double flat = 1e-4;

// Sums over the spheres in reach of a node, w = V W, d from the node.
struct Sums {
  double w = 0, damage = 0;
  Vector3 d, u;
  std::array<double, 9> dd{}, ud{}, stress{};
};

std::size_t at(int r, int c) {
  return static_cast<std::size_t>(3 * r + c);
}

void add(Sums &s, const SphereColumns &spheres, std::size_t i, double w, const Vector3 &d) {
  s.w += w;
  if (!spheres.damage.empty()) s.damage += w * spheres.damage[i];
  if (!spheres.stress.empty())
    for (std::size_t c = 0; c < 9; ++c)
      s.stress[c] += w * spheres.stress[i][c];
  if (spheres.displacement.empty()) return;
  const Vector3 &u = spheres.displacement[i];
  s.d += w * d;
  s.u += w * u;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      s.dd[at(r, c)] += w * d[r] * d[c];
      s.ud[at(r, c)] += w * u[r] * d[c];
    }
}

// Nodes of one direction within `reach` of x: first, and one past the last.
std::array<int, 2> in_reach(double x, double reach, double origin, double spacing, int nodes) {
  const double first = std::ceil((x - reach - origin) / spacing),
               last = std::floor((x + reach - origin) / spacing);
  const double end = nodes;
  return {static_cast<int>(std::clamp(first, 0.0, end)), static_cast<int>(std::clamp(last + 1, 0.0, end))};
}

std::vector<Sums> sum_up(const SphereColumns &spheres, const RegularGrid &grid, double reach) {
  std::vector<Sums> sums(grid.size());
  for (std::size_t i = 0; i < spheres.position.size(); ++i) {
    const Vector3 &x = spheres.position[i];
    const double r = spheres.radius[i], volume = 4.0 / 3 * pi * r * r * r;
    std::array<std::array<int, 2>, 3> range;
    for (int d = 0; d < 3; ++d)
      range[d] = in_reach(x[d], reach, grid.origin[d], grid.spacing, grid.nodes[d]);
    for (int k = range[2][0]; k < range[2][1]; ++k)
      for (int j = range[1][0]; j < range[1][1]; ++j)
        for (int n = range[0][0]; n < range[0][1]; ++n) {
          const std::size_t node = (static_cast<std::size_t>(k) * grid.nodes[1] + j) * grid.nodes[0] + n;
          const Vector3 d = x - grid.place(node);
          const double w = volume * wendland(norm(d), reach);
          if (w > 0) add(sums[node], spheres, i, w, d);
        }
  }
  return sums;
}

// Inverse of a symmetric matrix by cofactors; false where it is as good as singular.
bool invert(const std::array<double, 9> &m, std::array<double, 9> &inverse) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      inverse[at(c, r)] = m[at(r1, c1)] * m[at(r2, c2)] - m[at(r1, c2)] * m[at(r2, c1)];
    }
  const double determinant = m[0] * inverse[0] + m[1] * inverse[3] + m[2] * inverse[6];
  const double mean = (m[0] + m[4] + m[8]) / 3;
  if (!(determinant > flat * mean * mean * mean)) return false;
  for (double &value : inverse)
    value /= determinant;
  return true;
}

// The linear field nearest to the displacements: at the node, and its gradient's symmetric part.
void fit(const Sums &s, Vector3 &displacement, std::array<double, 9> &strain) {
  const Vector3 d = (1 / s.w) * s.d, u = (1 / s.w) * s.u;
  std::array<double, 9> scatter, moved, inverse, gradient;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      scatter[at(r, c)] = s.dd[at(r, c)] / s.w - d[r] * d[c];
      moved[at(r, c)] = s.ud[at(r, c)] / s.w - u[r] * d[c];
    }
  displacement = u;
  strain.fill(nan);
  if (!invert(scatter, inverse)) return;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      double &g = gradient[at(r, c)] = 0;
      for (int k = 0; k < 3; ++k)
        g += moved[at(r, k)] * inverse[at(k, c)];
      displacement[r] -= g * d[c];
    }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      strain[at(r, c)] = 0.5 * (gradient[at(r, c)] + gradient[at(c, r)]);
}

} // namespace

Vector3 RegularGrid::place(std::size_t node) const {
  const std::size_t nx = nodes[0], ny = nodes[1];
  return origin + spacing * Vector3{static_cast<double>(node % nx), static_cast<double>(node / nx % ny),
                                    static_cast<double>(node / nx / ny)};
}

double wendland(double distance, double reach) {
  const double q = distance / reach;
  if (q >= 1) return 0;
  const double rest = (1 - q) * (1 - q);
  return 21 / (2 * pi * reach * reach * reach) * rest * rest * (1 + 4 * q);
}

CoarseFields coarse_grain(const SphereColumns &spheres, const RegularGrid &grid, double reach) {
  const std::vector<Sums> sums = sum_up(spheres, grid, reach);
  const std::size_t n = grid.size();
  std::array<double, 9> unknown;
  unknown.fill(nan);
  CoarseFields fields;
  fields.solid_share.resize(n);
  if (!spheres.stress.empty()) fields.stress.assign(n, unknown);
  if (!spheres.damage.empty()) fields.damage.assign(n, nan);
  if (!spheres.displacement.empty()) {
    fields.displacement.assign(n, {nan, nan, nan});
    fields.strain.assign(n, unknown);
  }
  for (std::size_t node = 0; node < n; ++node) {
    const Sums &s = sums[node];
    fields.solid_share[node] = s.w;
    if (s.w == 0) continue;
    if (!fields.stress.empty())
      for (std::size_t c = 0; c < 9; ++c)
        fields.stress[node][c] = s.stress[c] / s.w;
    if (!fields.damage.empty()) fields.damage[node] = s.damage / s.w;
    if (!fields.displacement.empty()) fit(s, fields.displacement[node], fields.strain[node]);
  }
  return fields;
}

} // namespace platen::dem
