#include "limit/parts.h"
#include "base/pi.h"

#include <algorithm>
#include <cmath>

namespace platen::bench {

namespace {

void set_bond(BondBlock &b, std::size_t lane, const Network &network, std::size_t bond, bool real) {
  b.first[lane] = network.first[bond];
  b.second[lane] = network.second[bond];
  const auto &xi = network.position[static_cast<std::size_t>(b.first[lane])];
  const auto &xj = network.position[static_cast<std::size_t>(b.second[lane])];
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double reference = xj[c] - xi[c];
    square += reference * reference;
    b.arm_first[c][lane] = b.arm_second[c][lane] = 0.5 * reference;
  }
  const double length = std::sqrt(square), radius2 = network.radius * network.radius;
  const double axial = real ? bond_modulus / length * pi * radius2 : 0.0;
  const double twisting = stiffness_ratio * axial * radius2 / 2;
  b.rest_length[lane] = length;
  b.normal[lane] = axial;
  b.shear[lane] = stiffness_ratio * axial;
  b.bending[lane] = axial * radius2 / 4;
  for (int k = 0; k < 3; ++k)
    b.excess[k][lane] = (twisting - b.bending[lane]) * (1 << k);
}

// Blocks of a list of bonds; the last one is filled up with bonds without stiffness.
std::vector<BondBlock> blocks_of(const Network &network, const std::vector<std::size_t> &bonds) {
  std::vector<BondBlock> blocks((bonds.size() + lanes - 1) / lanes);
  for (std::size_t k = 0; k < blocks.size() * lanes; ++k)
    set_bond(blocks[k / lanes], k % lanes, network, bonds[std::min(k, bonds.size() - 1)], k < bonds.size());
  return blocks;
}

} // namespace

std::vector<Part> cut(const Network &network, int count) {
  const std::size_t parts = static_cast<std::size_t>(count), bonds = network.first.size();
  std::vector<Part> result(parts);
  for (std::size_t k = 0; k < parts; ++k) {
    result[k].begin = k == 0 ? 0 : result[k - 1].end;
    const bool last = k + 1 == parts || bonds == 0;
    result[k].end = last ? static_cast<int>(network.position.size()) : network.first[(k + 1) * bonds / parts];
  }
  return result;
}

void fill(Part &part, const Network &network) {
  std::vector<std::size_t> inner, crossing;
  const auto low = std::lower_bound(network.first.begin(), network.first.end(), part.begin);
  const auto high = std::lower_bound(low, network.first.end(), part.end);
  for (auto at = low; at != high; ++at) {
    const std::size_t k = static_cast<std::size_t>(at - network.first.begin());
    (network.second[k] < part.end ? inner : crossing).push_back(k);
  }
  part.inner = blocks_of(network, inner);
  part.crossing = blocks_of(network, crossing);
  std::vector<int> &rows = part.ghost_rows;
  for (const std::size_t k : crossing)
    rows.push_back(network.second[k]);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  for (const BondBlock &b : part.crossing) {
    std::array<int, lanes> slots;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      slots[lane] =
          static_cast<int>(std::lower_bound(rows.begin(), rows.end(), b.second[lane]) - rows.begin());
    part.slots.push_back(slots);
  }
  part.ghosts.assign(rows.size(), Load{});
}

} // namespace platen::bench
