#include "dem/measure/stress.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/pi.h"
#include "dem/eigen.h"
#include "dem/measure/bond_network.h"

namespace platen::dem {
namespace {

void add(std::array<double, 9> &s, const Vector3 &arm, const Vector3 &force) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      s[3 * r + c] += 0.5 * (arm[r] * force[c] + arm[c] * force[r]);
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// The part [low, high] of the path along one axis that lies between `bottom` and `top`.
void clip(double from, double to, double bottom, double top, double &low, double &high) {
  const double path = to - from;
  if (path == 0) {
    if (from < bottom || from > top) high = low;
    return;
  }
  const double a = (bottom - from) / path, b = (top - from) / path;
  low = std::max(low, std::min(a, b));
  high = std::min(high, std::max(a, b));
}

void clip_to_circle(const Vector3 &from, const Vector3 &path, double radius, double &low, double &high) {
  const double a = path.x * path.x + path.y * path.y, b = from.x * path.x + from.y * path.y,
               c = from.x * from.x + from.y * from.y - radius * radius;
  if (a == 0) {
    if (c > 0) high = low;
    return;
  }
  const double square = b * b - a * c;
  if (square <= 0) {
    high = low;
    return;
  }
  low = std::max(low, (-b - std::sqrt(square)) / a);
  high = std::min(high, (-b + std::sqrt(square)) / a);
}

struct Sum {
  Eigen::Matrix3d t = Eigen::Matrix3d::Zero();
  Sum &operator+=(const Sum &b) {
    t += b.t;
    return *this;
  }
};

Tensor symmetric(const Eigen::Matrix3d &t) {
  Tensor s;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      s[r][c] = 0.5 * (t(r, c) + t(c, r));
  return s;
}

// Components xx, yy, zz, yz, zx, xy; shear strains doubled.
Eigen::Matrix<double, 6, 1> vector(const Tensor &t, double shear) {
  Eigen::Matrix<double, 6, 1> v;
  v << t[0][0], t[1][1], t[2][2], shear * t[1][2], shear * t[0][2], shear * t[0][1];
  return v;
}

} // namespace

std::vector<std::array<double, 9>> particle_stress(const Particles &p, const Bonds *bonds,
                                                   const Contacts *contacts, double packing_fraction) {
  std::vector<std::array<double, 9>> stress(p.size(), std::array<double, 9>{});
  const auto pair = [&](int i, int j, const Vector3 &force) {
    const Vector3 d = p.position[j] - p.position[i];
    const double lever = p.radius[i] / (p.radius[i] + p.radius[j]);
    add(stress[i], lever * d, force);
    add(stress[j], (lever - 1) * d, -force);
  };
  if (bonds != nullptr)
    for (std::size_t k = 0; k < bonds->size(); ++k) {
      const Triple<double> force = bonds->response(k, p).force;
      pair(bonds->first[k], bonds->second[k], {force.x, force.y, force.z});
    }
  if (contacts != nullptr)
    for (std::size_t block = 0; block < number_of_blocks(p.size()); ++block)
      contacts->for_rows_of_block(block, [&](std::size_t k) {
        if (contacts->touching[k]) pair(contacts->first[k], contacts->second[k], contacts->force[k]);
      });
  for (std::size_t i = 0; i < p.size(); ++i) {
    const double volume = sphere_volume(p.radius[i]) / packing_fraction;
    for (double &s : stress[i])
      s /= volume;
  }
  return stress;
}

std::vector<DirectionClass> bond_stress_by_direction(const Particles &p, const Bonds &b, int classes) {
  std::vector<DirectionClass> all(static_cast<std::size_t>(classes));
  const double width = 0.5 * pi / classes;
  for (int c = 0; c < classes; ++c)
    all[c].low = c * width, all[c].high = (c + 1) * width;
  for (std::size_t k = 0; k < b.size(); ++k) {
    if (b.normal_stiffness[k] == 0.0) continue;
    const Vector3 d = p.position[b.second[k]] - p.position[b.first[k]];
    const double angle = std::asin(std::min(1.0, std::abs(d.z) / norm(d)));
    DirectionClass &to = all[std::min(all.size() - 1, static_cast<std::size_t>(angle / width))];
    const double area = pi * b.bond_radius[k] * b.bond_radius[k];
    const double stress = -b.response(k, p).normal_force / area;
    ++to.bonds;
    to.mean += stress;
    if (stress > 0) ++to.pressed, to.mean_pressed += stress;
  }
  for (DirectionClass &c : all) {
    c.mean = c.bonds > 0 ? c.mean / c.bonds : none;
    c.mean_pressed = c.pressed > 0 ? c.mean_pressed / c.pressed : none;
  }
  return all;
}

bool Region::holds(const Vector3 &x) const {
  if (x.z < bottom || x.z > bottom + shape.height) return false;
  if (shape.kind == ShapeKind::cylinder) return x.x * x.x + x.y * x.y <= shape.radius * shape.radius;
  return std::abs(x.x) <= 0.5 * shape.width_x && std::abs(x.y) <= 0.5 * shape.width_y;
}

double Region::fraction_inside(const Vector3 &from, const Vector3 &to) const {
  double low = 0, high = 1;
  clip(from.z, to.z, bottom, bottom + shape.height, low, high);
  if (shape.kind == ShapeKind::cylinder) {
    clip_to_circle(from, to - from, shape.radius, low, high);
  } else {
    clip(from.x, to.x, -0.5 * shape.width_x, 0.5 * shape.width_x, low, high);
    clip(from.y, to.y, -0.5 * shape.width_y, 0.5 * shape.width_y, low, high);
  }
  return std::max(0.0, high - low);
}

Tensor mean_stress(const Region &region, const Particles &p, const Bonds &b,
                   const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn) {
  const Sum sum = ordered_sum<Sum>(b.size(), [&](std::size_t first, std::size_t last) {
    Sum part;
    for (std::size_t row = first; row < last; ++row) {
      const Vector3 &from = p.reference_position[b.first[row]], d = b.reference[row];
      const double fraction = region.fraction_inside(from, from + d);
      if (fraction == 0) continue;
      const Vector3 force = small_force(b, row, small_strain(p, b, row, displacement, turn));
      part.t += fraction * eigen(d) * eigen(force).transpose();
    }
    return part;
  });
  Tensor stress = symmetric(sum.t);
  for (auto &row : stress)
    for (double &s : row)
      s /= region.shape.volume();
  return stress;
}

Tensor mean_strain(const Region &region, const Particles &p, const std::vector<Vector3> &displacement,
                   const std::vector<char> &counted) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), mean = Eigen::Vector3d::Zero();
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (!region.holds(p.reference_position[i]) || (!counted.empty() && !counted[i])) continue;
    rows.push_back(i);
    centre += eigen(p.reference_position[i]);
    mean += eigen(displacement[i]);
  }
  constexpr Tensor unknown{{{none, none, none}, {none, none, none}, {none, none, none}}};
  if (rows.size() < 4) return unknown;
  centre /= static_cast<double>(rows.size());
  mean /= static_cast<double>(rows.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero(), product = Eigen::Matrix3d::Zero();
  for (const std::size_t i : rows) {
    const Eigen::Vector3d x = eigen(p.reference_position[i]) - centre, u = eigen(displacement[i]) - mean;
    moments += x * x.transpose();
    product += u * x.transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(moments);
  if (!lu.isInvertible()) return unknown;
  return symmetric(product * lu.inverse());
}

Moduli isotropic_moduli(const std::array<Tensor, 6> &strain, const std::array<Tensor, 6> &stress) {
  Eigen::Matrix<double, 6, 6> e, s;
  for (std::size_t k = 0; k < 6; ++k) {
    e.col(static_cast<Eigen::Index>(k)) = vector(strain[k], 2);
    s.col(static_cast<Eigen::Index>(k)) = vector(stress[k], 1);
  }
  if (!e.allFinite() || !s.allFinite()) return {none, none, none};
  const Eigen::FullPivLU<Eigen::Matrix<double, 6, 6>> lu(e);
  if (!lu.isInvertible()) return {none, none, none};
  const Eigen::Matrix<double, 6, 6> c = s * lu.inverse();
  const double trace = c(0, 0) + c(1, 1) + c(2, 2), off = c(0, 1) + c(1, 2) + c(0, 2),
               shear = c(3, 3) + c(4, 4) + c(5, 5);
  const double off_too = c(1, 0) + c(2, 1) + c(2, 0), mixed = 0.5 * (off + off_too);
  const double bulk = (trace + 2 * mixed) / 9, rigidity = (trace - mixed + 3 * shear) / 15;
  Moduli m;
  m.youngs = 9 * bulk * rigidity / (3 * bulk + rigidity);
  m.poisson = (3 * bulk - 2 * rigidity) / (2 * (3 * bulk + rigidity));
  Eigen::Matrix<double, 6, 6> isotropic = Eigen::Matrix<double, 6, 6>::Zero();
  isotropic.topLeftCorner<3, 3>().setConstant(bulk - 2 * rigidity / 3);
  isotropic.topLeftCorner<3, 3>().diagonal().setConstant(bulk + 4 * rigidity / 3);
  isotropic.bottomRightCorner<3, 3>().diagonal().setConstant(rigidity);
  m.anisotropy = (c - isotropic).cwiseAbs().maxCoeff() / c.cwiseAbs().maxCoeff();
  return m;
}

} // namespace platen::dem
