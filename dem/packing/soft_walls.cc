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
  flat_.clear(), round_.clear();
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
  round_.push_back({row, static_cast<float>(centre.x), static_cast<float>(centre.y),
                    static_cast<float>(inner), static_cast<float>(across - inner * inner)});
}

WallSums SoftWalls::add_forces(std::size_t first, std::size_t last, const SoftRow *way,
                               SoftRow *force) const {
  WallSums sums;
  const auto touch = [&](double overlap) {
    sums.overlap += overlap, ++sums.contacts;
    sums.largest = std::max(sums.largest, overlap);
  };
  for (const Plane *p = begin(flat_, first), *end = begin(flat_, last); p != end; ++p) {
    const SoftRow &u = way[p->row];
    const double overlap = -(p->gap + static_cast<double>(p->x * u.x + p->y * u.y + p->z * u.z));
    if (!(overlap > 0)) continue;
    touch(overlap);
    const float size = static_cast<float>(overlap);
    SoftRow &f = force[p->row];
    f.x += size * p->x, f.y += size * p->y, f.z += size * p->z;
  }
  for (const Round *r = begin(round_, first), *end = begin(round_, last); r != end; ++r) {
    const SoftRow &u = way[r->row];
    const float x = r->x + u.x, y = r->y + u.y;
    const float outside = r->outside + (r->x + x) * u.x + (r->y + y) * u.y;
    SoftRow &f = force[r->row];
    if (r->inner <= 0) { // wider than the room, and pressed from both sides
      touch(static_cast<double>(-r->inner));
      f.x -= 2 * x, f.y -= 2 * y;
      continue;
    }
    if (!(outside > 0)) continue;
    const float distance = std::sqrt(x * x + y * y), weight = outside / ((distance + r->inner) * distance);
    touch(static_cast<double>(weight * distance));
    f.x -= weight * x, f.y -= weight * y;
  }
  return sums;
}

} // namespace platen::dem
