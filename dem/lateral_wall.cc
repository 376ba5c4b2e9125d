#include "dem/lateral_wall.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::dem {
namespace {

constexpr double margin = 0.3; // of the list, mean radii

} // namespace

LateralWall::LateralWall(const Particles &p, const Shape &shape, double stiffness, double layer)
    : shape_(shape), stiffness_(stiffness), layer_(layer) {
  for (const double r : p.radius)
    skin_ += margin * r / static_cast<double>(std::max<std::size_t>(p.size(), 1));
  perimeter_ = lateral_perimeter(shape);
  make_list(p);
}

LateralWall::Gap LateralWall::gap(const Vector3 &x, double radius, int side) const {
  if (shape_.kind == ShapeKind::cylinder) {
    const double r = std::hypot(x.x, x.y);
    const Vector3 inward = r > 0 ? Vector3{-x.x / r, -x.y / r, 0} : Vector3{};
    return {shape_.radius - r - radius, inward};
  }
  const double sign = side % 2 == 0 ? 1 : -1;
  if (side < 2) return {0.5 * shape_.width_x - sign * x.x - radius, {-sign, 0, 0}};
  return {0.5 * shape_.width_y - sign * x.y - radius, {0, -sign, 0}};
}

void LateralWall::make_list(const Particles &p) {
  rows_.clear();
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int side = 0; side < sides(); ++side) {
      const double at_first = gap(p.reference_position[i], p.radius[i], side).gap;
      const double rest = at_first <= layer_ ? at_first : 0.0;
      if (gap(p.position[i], p.radius[i], side).gap - rest < skin_)
        rows_.push_back({static_cast<int>(i), side, rest});
    }
  moved_ = 0;
  valid_ = true;
  ++lists_made_;
}

std::vector<int> LateralWall::particles() const {
  std::vector<int> rows;
  for (const Row &row : rows_)
    if (rows.empty() || rows.back() != row.particle) rows.push_back(row.particle);
  return rows;
}

void LateralWall::add_forces(Particles &p, double distance) {
  const bool anew = lists_anew(distance);
  moved_ += distance;
  if (anew) make_list(p);
  force_ = elastic_energy_ = 0;
  for (const Row &row : rows_) {
    const int i = row.particle;
    const Gap g = gap(p.position[i], p.radius[i], row.side);
    const double overlap = row.rest - g.gap;
    if (overlap <= 0) continue;
    const double normal = stiffness_ * overlap;
    p.force[i] += normal * g.inward;
    force_ += normal;
    elastic_energy_ += 0.5 * normal * overlap;
  }
}

std::size_t LateralWall::seats() const {
  return static_cast<std::size_t>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row &row) { return row.rest != 0; }));
}

std::vector<GroundSpring> LateralWall::ground_springs(const Particles &p) const {
  std::vector<GroundSpring> springs;
  for (const Row &row : rows_) {
    const int i = row.particle;
    const Gap g = gap(p.position[i], p.radius[i], row.side);
    GroundSpring s;
    s.particle = row.particle;
    s.normal = g.inward;
    s.arm = -p.radius[i] * g.inward;
    s.normal_stiffness = stiffness_;
    s.gap = g.gap - row.rest;
    springs.push_back(s);
  }
  return springs;
}

// The list is rebuilt from the positions; with older states, force and energy are known after the next step.
void LateralWall::describe(Archive &archive) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  archive.version(1);
  archive("force", force_, "N", unknown, or_nan());
  archive("elastic_energy", elastic_energy_, "J", unknown, or_nan());
  if (archive.reads()) valid_ = false;
}

} // namespace platen::dem
