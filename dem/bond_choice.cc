#include "dem/bond_choice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "dem/packing/specimen.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

struct Candidate {
  IndexPair pair;
  double strength_factor = 1;
};

std::vector<Candidate> given_pairs(const Particles &particles, const std::vector<GivenBond> &given) {
  const auto count = static_cast<int>(particles.size());
  std::vector<int> row_of_id(particles.size());
  for (int row = 0; row < count; ++row)
    row_of_id[static_cast<std::size_t>(particles.id[row])] = row;
  std::vector<Candidate> pairs;
  for (const GivenBond &bond : given) {
    for (const int id : {bond.first, bond.second})
      if (id < 0 || id >= count)
        throw std::invalid_argument("bonds: there is no sphere " + std::to_string(id));
    const auto [low, high] = std::minmax(row_of_id[static_cast<std::size_t>(bond.first)],
                                         row_of_id[static_cast<std::size_t>(bond.second)]);
    pairs.push_back({{low, high}, bond.strength_factor});
  }
  const auto less = [](const Candidate &a, const Candidate &b) {
    return std::pair(a.pair.first, a.pair.second) < std::pair(b.pair.first, b.pair.second);
  };
  std::sort(pairs.begin(), pairs.end(), less);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    if (pairs[k].pair.first == pairs[k].pair.second || (k > 0 && !less(pairs[k - 1], pairs[k])))
      throw std::invalid_argument("bonds: a pair of one sphere, or one that is there twice");
  return pairs;
}

std::vector<Candidate> near_pairs_of(const Particles &particles, const BondLayout &layout) {
  std::vector<Candidate> pairs;
  for (const IndexPair &pair :
       pairs_in_range(particles.position.data(), particles.radius.data(), particles.size(), layout))
    pairs.push_back({pair});
  return pairs;
}

} // namespace

bool Flaw::crosses(const Vector3 &a, const Vector3 &b) const {
  const double from = dot(a - centre, normal), to = dot(b - centre, normal);
  if ((from < 0) == (to < 0)) return false;
  if (form == Form::plane) return true;
  const Vector3 point = a + from / (from - to) * (b - a) - centre; // in the plane
  if (form == Form::disc) return norm(point) <= radius;
  const Vector3 level{-normal.y, normal.x, 0};
  const double size = norm(level);
  constexpr double flat = 1e-9; // of a normal along z, which has no horizontal of its own
  const Vector3 along = size > flat ? (1 / size) * level : Vector3{1, 0, 0};
  return std::abs(dot(point, along)) <= 0.5 * width &&
         std::abs(dot(point, cross(normal, along))) <= 0.5 * breadth;
}

std::vector<IndexPair> pairs_in_range(const Vector3 *position, const double *radius, std::size_t n,
                                      const BondLayout &layout) {
  const double largest = n > 0 ? *std::max_element(radius, radius + n) : 0;
  // Slightly wider than the reach, so that only the test below decides.
  const double margin = layout.reach(largest, largest) * (1 + 1e-9) + 1e-9 * largest;
  std::vector<IndexPair> pairs = near_pairs(position, radius, n, margin);
  const auto out_of_range = [&](const IndexPair &p) {
    const double ri = radius[p.first], rj = radius[p.second];
    const double gap = norm(position[p.second] - position[p.first]) - ri - rj;
    return gap > layout.reach(ri, rj) || -gap > layout.largest_overlap(ri, rj);
  };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), out_of_range), pairs.end());
  return pairs;
}

BondedPairs bonded_pairs(const Particles &particles, const BondLayout &layout, const Notch &notch,
                         const BondChoice &choice) {
  BondedPairs chosen;
  chosen.in_flaw.resize(choice.flaws.size());
  for (auto [pair, factor] :
       choice.given ? given_pairs(particles, *choice.given) : near_pairs_of(particles, layout)) {
    const Vector3 &a = particles.position[pair.first], &b = particles.position[pair.second];
    if (notch.is_there() && notch.parts(a, b)) continue;
    for (std::size_t k = 0; k < choice.flaws.size(); ++k) {
      if (!choice.flaws[k].crosses(a, b)) continue;
      factor *= choice.flaws[k].strength_factor;
      ++chosen.in_flaw[k];
    }
    if (!(factor > 0)) continue;
    chosen.pairs.push_back(pair);
    chosen.strength_factor.push_back(factor);
  }
  return chosen;
}

} // namespace platen::dem
