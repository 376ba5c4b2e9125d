#include "dem/packing/soft_walls.h"

#include <algorithm>
#include <cmath>

namespace platen::dem {

using kernels::SoftRow;

template <class Wall>
const Wall *SoftWalls::begin(const std::vector<Wall> &walls, std::size_t row) {
  return std::lower_bound(walls.data(), walls.data() + walls.size(), static_cast<int>(row),
                          [](const Wall &w, int r) { return w.row < r; });
}
template const SoftWalls::Plane *SoftWalls::begin(const std::vector<Plane> &, std::size_t);
template const SoftWalls::Round *SoftWalls::begin(const std::vector<Round> &, std::size_t);

void SoftWalls::clear(const Shape &shape) {
  shape_ = shape;
  flat_.clear(), round_.clear(), wide_.clear();
}

void SoftWalls::add(int row, const Vector3 &centre, double radius, double reach) {
  const auto plane = [&](double gap, float x, float y, float z) {
    if (gap < reach) flat_.push_back({row, x, y, z, gap});
  };
  plane(centre.z - radius, 0, 0, 1);
  plane(shape_.height - centre.z - radius, 0, 0, -1);
  if (shape_.kind == ShapeKind::box) {
    plane(0.5 * shape_.width_x + centre.x - radius, 1, 0, 0);
    plane(0.5 * shape_.width_x - centre.x - radius, -1, 0, 0);
    plane(0.5 * shape_.width_y + centre.y - radius, 0, 1, 0);
    plane(0.5 * shape_.width_y - centre.y - radius, 0, -1, 0);
    return;
  }
  const double across = centre.x * centre.x + centre.y * centre.y, inner = shape_.radius - radius;
  if (inner - reach > 0 && across < (inner - reach) * (inner - reach)) return;
  (inner > 0 ? round_ : wide_)
      .push_back({row, static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(inner),
                  static_cast<float>(across - inner * inner)});
}

namespace {

constexpr std::size_t at_once = 64;
constexpr float tiny = 1e-30F; // keeps the push on a sphere at the axis finite (zero)

void touch(double overlap, WallSums &sums) {
  sums.overlap += overlap, sums.contacts += overlap > 0 ? 1 : 0;
  sums.largest = std::max(sums.largest, overlap);
}

} // namespace

// Without branches: half of the spheres near a wall touch it, in no order.
void SoftWalls::add_flat(std::size_t first, std::size_t last, const SoftRow *displacement, SoftRow *force,
                         WallSums &sums) const {
  for (const Plane *p = begin(flat_, first), *end = begin(flat_, last); p != end; ++p) {
    const SoftRow &u = displacement[p->row];
    const double overlap =
        std::max(0.0, -(p->gap + static_cast<double>(p->x * u.x + p->y * u.y + p->z * u.z)));
    touch(overlap, sums);
    const float size = static_cast<float>(overlap);
    SoftRow &f = force[p->row];
    f.x += size * p->x, f.y += size * p->y, f.z += size * p->z;
  }
}

// Roots and quotients of several entries at once, in vectors, then their sums in order.
void SoftWalls::add_round(std::size_t first, std::size_t last, const SoftRow *displacement, SoftRow *force,
                          WallSums &sums) const {
  float x[at_once], y[at_once], inner[at_once], outside[at_once], overlap[at_once];
  const Round *r = begin(round_, first), *end = begin(round_, last);
  while (r != end) {
    const std::size_t count = std::min(at_once, static_cast<std::size_t>(end - r));
    for (std::size_t k = 0; k < count; ++k) {
      const SoftRow &u = displacement[r[k].row];
      x[k] = r[k].x + u.x, y[k] = r[k].y + u.y, inner[k] = r[k].inner;
      outside[k] = r[k].outside + (r[k].x + x[k]) * u.x + (r[k].y + y[k]) * u.y;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const float distance = std::sqrt(x[k] * x[k] + y[k] * y[k]);
      const float inside = outside[k] > 0 ? outside[k] : 0.0F;
      const float weight = inside / ((distance + inner[k]) * (distance + tiny));
      x[k] *= weight, y[k] *= weight, overlap[k] = weight * distance;
    }
    for (std::size_t k = 0; k < count; ++k) {
      touch(static_cast<double>(overlap[k]), sums);
      SoftRow &f = force[r[k].row];
      f.x -= x[k], f.y -= y[k];
    }
    r += count;
  }
}

WallSums SoftWalls::add_forces(std::size_t first, std::size_t last, const SoftRow *displacement,
                               SoftRow *force) const {
  WallSums sums;
  add_flat(first, last, displacement, force, sums);
  add_round(first, last, displacement, force, sums);
  for (const Round *r = begin(wide_, first), *end = begin(wide_, last); r != end; ++r) {
    const SoftRow &u = displacement[r->row];
    touch(static_cast<double>(-r->inner), sums);
    SoftRow &f = force[r->row];
    f.x -= 2 * (r->x + u.x), f.y -= 2 * (r->y + u.y);
  }
  return sums;
}

} // namespace platen::dem
