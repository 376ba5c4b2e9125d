#include "dem/particles.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "base/pi.h"
#include "base/rows.h"
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

// Enough to name both particles of a contact, or a sphere with its neighbours.
constexpr std::size_t most_named = 16;

// Tests the bits of the exponent, which the compiler can vectorise.
bool finite(const double *numbers, std::size_t count) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000;
  std::uint64_t bad = 0;
  for (std::size_t k = 0; k < count; ++k) {
    std::uint64_t bits;
    std::memcpy(&bits, numbers + k, sizeof bits);
    bad |= static_cast<std::uint64_t>((bits & exponent) == exponent);
  }
  return bad == 0;
}

std::size_t doubles_per_row(const ColumnBase &column) {
  return column.bytes_per_row() % sizeof(double) == 0 ? column.bytes_per_row() / sizeof(double) : 0;
}

bool finite(const ColumnBase &column) {
  return finite(static_cast<const double *>(column.bytes()), column.size() * doubles_per_row(column));
}

std::string listed(std::vector<int> ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::string text = ids.size() == 1 ? " of particle " : " of particles ";
  for (std::size_t k = 0; k < std::min(ids.size(), most_named); ++k)
    text += (k > 0 ? ", " : "") + std::to_string(ids[k]);
  if (ids.size() > most_named) text += " and " + std::to_string(ids.size() - most_named) + " more";
  return text;
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
  require_rows(specimen.size());
  table.resize(specimen.size());
  id.allow(row_of(specimen.size()));
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
  orientation = &table.add<Quaternion>("orientation", "1", unit_length());
  angular_velocity = &table.add<Vector3>("angular_velocity", "rad/s");
  torque = &table.add<Vector3>("torque", "N m");
  inertia = &table.add<double>("inertia", "kg m^2", above(0));
}

void Particles::add_excess() {
  excess_velocity = &table.add<Vector3>("excess_velocity", "m/s");
  if (has_rotation()) excess_spin = &table.add<Vector3>("excess_spin", "rad/s");
}

bool motion_is_finite(const Particles &p) {
  return finite(p.position) && finite(p.velocity) &&
         (!p.has_rotation() || (finite(*p.orientation) && finite(*p.angular_velocity)));
}

std::string not_finite(const Particles &p) {
  std::string names;
  std::vector<int> ids;
  for (const auto &column : p.table.columns()) {
    if (finite(*column)) continue;
    names += (names.empty() ? "" : ", ") + column->name();
    const std::size_t width = doubles_per_row(*column);
    const double *numbers = static_cast<const double *>(column->bytes());
    for (std::size_t i = 0; i < p.size(); ++i)
      if (!finite(numbers + i * width, width)) ids.push_back(p.id[i]);
  }
  return names.empty() ? "" : names + listed(ids);
}

} // namespace platen::dem
