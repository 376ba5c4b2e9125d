#include "dem/particles.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "base/pi.h"
#include "dem/packing/specimen.h"

namespace platen::dem {
namespace {

// Spreads the low 21 bits of v so that two zero bits stand between each.
std::uint64_t spread_bits(std::uint64_t v) {
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

} // namespace

std::vector<int> spatial_order(const std::vector<Vector3> &centres) {
  std::vector<int> order(centres.size());
  std::iota(order.begin(), order.end(), 0);
  if (centres.empty()) return order;
  Vector3 low = centres[0], high = centres[0];
  for (const Vector3 &c : centres)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], c[k]);
      high[k] = std::max(high[k], c[k]);
    }
  const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-300});
  const double scale = 2097151.0 / extent; // 2^21 - 1 cells along the longest side
  std::vector<std::uint64_t> key(centres.size());
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vector3 c = scale * (centres[i] - low);
    key[i] = spread_bits(static_cast<std::uint64_t>(c.x)) |
             spread_bits(static_cast<std::uint64_t>(c.y)) << 1 |
             spread_bits(static_cast<std::uint64_t>(c.z)) << 2;
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  return order;
}

Particles::Particles(const Specimen &specimen, double density, bool rotation) {
  if (rotation) add_rotation();
  table.resize(specimen.size());
  const std::vector<int> order = spatial_order(specimen.centre);
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double r = specimen.radius[order[k]];
    id[k] = order[k];
    position[k] = reference_position[k] = specimen.centre[order[k]];
    radius[k] = r;
    mass[k] = 4.0 / 3.0 * pi * density * r * r * r;
    if (rotation) {
      (*orientation)[k] = Quaternion{};
      (*inertia)[k] = 0.4 * mass[k] * r * r;
    }
  }
}

void Particles::add_rotation() {
  orientation = &table.add<Quaternion>("orientation", "1");
  angular_velocity = &table.add<Vector3>("angular_velocity", "rad/s");
  torque = &table.add<Vector3>("torque", "N m");
  inertia = &table.add<double>("inertia", "kg m^2");
}

void Particles::add_excess() {
  excess_velocity = &table.add<Vector3>("excess_velocity", "m/s");
  if (has_rotation()) excess_spin = &table.add<Vector3>("excess_spin", "rad/s");
}

} // namespace platen::dem
