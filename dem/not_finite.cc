#include "dem/not_finite.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace platen::dem {
namespace {

// A contact of two or a sphere with its neighbours is named whole.
constexpr std::size_t most_named = 16;

// By the bits of the exponent, which the compiler can do in lanes.
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
