#include "dem/outside.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace platen::dem {

Outside::Outside(const std::vector<Vector3> &centres, const std::vector<double> &radii,
                 const EndPlanes &planes, double edge)
    : edge_(edge) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Vector3 low{far, far, planes.low}, high{-far, -far, planes.high};
  for (std::size_t i = 0; i < centres.size(); ++i)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], centres[i][k] - radii[i]);
      high[k] = std::max(high[k], centres[i][k] + radii[i]);
    }
  if (centres.empty()) return;
  // Two cubes of free space on every side, where the flood begins.
  for (int k = 0; k < 2; ++k)
    low[k] -= 2 * edge, high[k] += 2 * edge;
  low_ = low;
  for (int k = 0; k < 3; ++k)
    n_[k] = std::max(1, static_cast<int>(std::ceil((high[k] - low[k]) / edge)));
  cubes_.assign(
      static_cast<std::size_t>(n_[0]) * static_cast<std::size_t>(n_[1]) * static_cast<std::size_t>(n_[2]),
      Cube::pore);
  for (std::size_t i = 0; i < centres.size(); ++i)
    visit_near(centres[i], radii[i], [&](std::size_t cube) {
      cubes_[cube] = Cube::held;
      return true;
    });
  flood();
}

// visit(cube) for the cubes whose centre lies within `reach`, until it says false.
template <class Visit>
void Outside::visit_near(const Vector3 &point, double reach, const Visit &visit) const {
  int first[3], last[3], at[3];
  for (int k = 0; k < 3; ++k) {
    first[k] = std::max(0, static_cast<int>(std::ceil((point[k] - reach - low_[k]) / edge_ - 0.5)));
    last[k] = std::min(n_[k] - 1, static_cast<int>(std::floor((point[k] + reach - low_[k]) / edge_ - 0.5)));
  }
  for (at[2] = first[2]; at[2] <= last[2]; ++at[2])
    for (at[1] = first[1]; at[1] <= last[1]; ++at[1])
      for (at[0] = first[0]; at[0] <= last[0]; ++at[0]) {
        Vector3 away;
        for (int k = 0; k < 3; ++k)
          away[k] = low_[k] + (at[k] + 0.5) * edge_ - point[k];
        if (norm_squared(away) <= reach * reach && !visit(index(at))) return;
      }
}

void Outside::flood() {
  std::vector<int> front; // x, y, z of cubes whose neighbours are to be looked at
  const auto take = [&](int x, int y, int z) {
    const int at[3] = {x, y, z};
    for (int k = 0; k < 3; ++k)
      if (at[k] < 0 || at[k] >= n_[k]) return;
    Cube &cube = cubes_[index(at)];
    if (cube != Cube::pore) return;
    cube = Cube::outside;
    front.insert(front.end(), {x, y, z});
  };
  for (int z = 0; z < n_[2]; ++z)
    take(0, 0, z);
  while (!front.empty()) {
    const std::size_t n = front.size();
    const int x = front[n - 3], y = front[n - 2], z = front[n - 1];
    front.resize(n - 3);
    take(x - 1, y, z), take(x + 1, y, z);
    take(x, y - 1, z), take(x, y + 1, z);
    take(x, y, z - 1), take(x, y, z + 1);
  }
}

bool Outside::within(const Vector3 &point, double reach) const {
  bool found = false;
  visit_near(point, reach, [&](std::size_t cube) {
    found = cubes_[cube] == Cube::outside;
    return !found;
  });
  return found;
}

} // namespace platen::dem
