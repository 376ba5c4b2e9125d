#include "dem/measure/coarse_grain.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/eigen.h"
#include "dem/packing/specimen.h"

namespace platen::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// Of the determinant of the spheres' scatter about a node over the cube of its mean; below it they lie in a
// plane or on a line.
constexpr double flat = 1e-4;

// Sums over the spheres in reach of a node, w = V W, d from the node.
struct Sums {
  double w = 0, damage = 0;
  std::array<double, 9> stress{};
  Vector3d d = Vector3d::Zero(), u = Vector3d::Zero();
  Matrix3d dd = Matrix3d::Zero(), ud = Matrix3d::Zero();
};

void add(Sums &s, const SphereColumns &spheres, std::size_t i, double w, const Vector3d &d) {
  s.w += w;
  if (!spheres.damage.empty()) s.damage += w * spheres.damage[i];
  if (!spheres.stress.empty())
    for (std::size_t c = 0; c < 9; ++c)
      s.stress[c] += w * spheres.stress[i][c];
  if (spheres.displacement.empty()) return;
  const Vector3d u = eigen(spheres.displacement[i]), wd = w * d, wu = w * u;
  s.d += wd;
  s.u += wu;
  s.dd += wd * d.transpose();
  s.ud += wu * d.transpose();
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
    const double volume = sphere_volume(spheres.radius[i]);
    std::array<std::array<int, 2>, 3> range;
    for (int d = 0; d < 3; ++d)
      range[d] = in_reach(x[d], reach, grid.origin[d], grid.spacing, grid.nodes[d]);
    for (int k = range[2][0]; k < range[2][1]; ++k)
      for (int j = range[1][0]; j < range[1][1]; ++j)
        for (int n = range[0][0]; n < range[0][1]; ++n) {
          const std::size_t node = (static_cast<std::size_t>(k) * grid.nodes[1] + j) * grid.nodes[0] + n;
          const Vector3 d = x - grid.place(node);
          const double w = volume * wendland(norm(d), reach);
          if (w > 0) add(sums[node], spheres, i, w, eigen(d));
        }
  }
  return sums;
}

// Inverse of a symmetric matrix by cofactors; false where it is as good as singular.
bool invert(const Matrix3d &m, Matrix3d &inverse) {
  for (int r = 0; r < 3; ++r)
    inverse.col(r) = m.row((r + 1) % 3).cross(m.row((r + 2) % 3)).transpose();
  const double determinant = m(0, 0) * inverse(0, 0) + m(0, 1) * inverse(1, 0) + m(0, 2) * inverse(2, 0);
  const double mean = (m(0, 0) + m(1, 1) + m(2, 2)) / 3;
  if (!(determinant > flat * mean * mean * mean)) return false;
  inverse /= determinant;
  return true;
}

// The linear field nearest to the displacements: at the node, and its gradient's symmetric part.
void fit(const Sums &s, Vector3 &displacement, std::array<double, 9> &strain) {
  const Vector3d d = (1 / s.w) * s.d, u = (1 / s.w) * s.u;
  const Matrix3d scatter = s.dd / s.w - d * d.transpose(), moved = s.ud / s.w - u * d.transpose();
  Matrix3d inverse, gradient = Matrix3d::Constant(nan);
  Vector3d at_node = u;
  if (invert(scatter, inverse)) {
    gradient.setZero();
    for (int k = 0; k < 3; ++k) // in this order
      gradient += moved.col(k) * inverse.row(k);
    for (int c = 0; c < 3; ++c)
      at_node -= d[c] * gradient.col(c);
  }
  displacement = {at_node.x(), at_node.y(), at_node.z()};
  Eigen::Map<Matrix3d>(strain.data()) = 0.5 * (gradient + gradient.transpose());
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
