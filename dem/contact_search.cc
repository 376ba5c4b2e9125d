#include "dem/contact_search.h"

#include <algorithm>

namespace platen::dem {
namespace {

// Drops the pairs that an intact bond holds together. Both are sorted by (first, second).
void drop_bonded(std::vector<IndexPair> &pairs, const Bonds &bonds) {
  std::size_t row = 0;
  const auto bonded = [&](IndexPair p) {
    while (row < bonds.size() && IndexPair{bonds.first[row], bonds.second[row]} < p)
      ++row;
    return row < bonds.size() && IndexPair{bonds.first[row], bonds.second[row]} == p &&
           bonds.normal_stiffness[row] != 0.0;
  };
  std::size_t kept = 0;
  for (const IndexPair p : pairs)
    if (!bonded(p)) pairs[kept++] = p;
  pairs.resize(kept);
}

template <class RestDistance>
bool before(const RestDistance &a, const IndexPair &b) {
  return a.pair < b;
}

} // namespace

void ContactSearch::moved(double distance) {
  state_.moved_since_wide += distance;
  state_.moved_since_close += distance;
}

bool ContactSearch::update(const Particles &particles, const Bonds *bonds) {
  // Both partners may have moved towards each other.
  if (!state_.wide_valid || 2 * state_.moved_since_wide + close_skin_ >= wide_skin_)
    rebuild_wide(particles, bonds);
  else if (state_.close_valid && 2 * state_.moved_since_close < close_skin_)
    return false;
  rebuild_close(particles);
  return true;
}

void ContactSearch::rebuild_wide(const Particles &particles, const Bonds *bonds) {
  state_.wide = near_pairs(particles.position.data(), particles.radius.data(), particles.size(), wide_skin_);
  if (bonds != nullptr) drop_bonded(state_.wide, *bonds);
  state_.wide.shrink_to_fit();
  state_.moved_since_wide = 0;
  state_.wide_valid = true;
}

void ContactSearch::rebuild_close(const Particles &particles) {
  state_.close.clear();
  for (const IndexPair &p : state_.wide) {
    const double reach = particles.radius[p.first] + particles.radius[p.second] + close_skin_;
    if (norm_squared(particles.position[p.second] - particles.position[p.first]) < reach * reach)
      state_.close.push_back(p);
  }
  state_.moved_since_close = 0;
  state_.close_valid = true;
}

void ContactSearch::add_pair(IndexPair pair) {
  if (!state_.wide_valid) return; // the next build finds it
  const auto at = std::lower_bound(state_.wide.begin(), state_.wide.end(), pair);
  if (at == state_.wide.end() || !(*at == pair)) state_.wide.insert(at, pair);
  state_.close_valid = false;
}

void ContactSearch::set_rest_distance(IndexPair pair, double distance) {
  const auto at = std::lower_bound(state_.rest.begin(), state_.rest.end(), pair, before<RestDistance>);
  if (at != state_.rest.end() && at->pair == pair)
    at->distance = distance;
  else
    state_.rest.insert(at, {pair, distance});
}

double ContactSearch::rest_distance(IndexPair pair, const Particles &particles) const {
  const auto at = std::lower_bound(state_.rest.begin(), state_.rest.end(), pair, before<RestDistance>);
  if (at != state_.rest.end() && at->pair == pair) return at->distance;
  return particles.radius[pair.first] + particles.radius[pair.second];
}

std::size_t ContactSearch::bytes() const {
  return (state_.wide.capacity() + state_.close.capacity()) * sizeof(IndexPair) +
         state_.rest.capacity() * sizeof(RestDistance);
}

void ContactSearch::describe(Archive &archive) {
  archive.version(1);
  archive("moved_since_wide", state_.moved_since_wide, "m");
  archive("moved_since_close", state_.moved_since_close, "m");
  archive("wide_valid", state_.wide_valid);
  archive("close_valid", state_.close_valid);
  archive.rows("wide", state_.wide);
  archive.rows("close", state_.close);
  std::vector<IndexPair> pairs;
  std::vector<double> distances;
  for (const RestDistance &rest : state_.rest)
    pairs.push_back(rest.pair), distances.push_back(rest.distance);
  archive.rows("rest_pairs", pairs);
  archive.rows("rest_distances", distances, "m");
  if (!archive.reads()) return;
  if (pairs.size() != distances.size()) throw StateError("contact search: each rest pair has one distance");
  state_.rest.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    state_.rest.push_back({pairs[k], distances[k]});
}

} // namespace platen::dem
