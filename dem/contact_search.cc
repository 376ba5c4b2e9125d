#include "dem/contact_search.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/state.h"

namespace platen::dem {
namespace {

// Drops pairs with an intact bond, and all pairs that ever had a bond with history, which after failure is
// also their contact. Both are sorted by (first, second).
void drop_bonded(std::vector<IndexPair> &pairs, const Bonds &bonds) {
  const bool of_records = has_history(bonds.law);
  const Column<int> &first = of_records ? bonds.record_first : bonds.first,
                    &second = of_records ? bonds.record_second : bonds.second;
  std::size_t row = 0;
  const auto bonded = [&](IndexPair p) {
    while (row < first.size() && IndexPair{first[row], second[row]} < p)
      ++row;
    return row < first.size() && IndexPair{first[row], second[row]} == p &&
           (of_records || bonds.normal_stiffness[row] != 0.0);
  };
  std::size_t kept = 0;
  for (const IndexPair p : pairs)
    if (!bonded(p)) pairs[kept++] = p;
  pairs.resize(kept);
}

} // namespace

void ContactSearch::moved(double distance) {
  moved_since_wide_ += distance;
  moved_since_close_ += distance;
}

// Both partners may have moved towards each other.
bool ContactSearch::wide_due() const {
  return !wide_valid_ || 2 * moved_since_wide_ + close_skin_ >= wide_skin_;
}

bool ContactSearch::update(const Particles &particles, const Bonds *bonds, const BlockList *listed) {
  if (wide_due())
    rebuild_wide(particles, bonds, listed);
  else if (close_valid_ && 2 * moved_since_close_ < close_skin_)
    return false;
  rebuild_close(particles);
  return true;
}

void ContactSearch::rebuild_wide(const Particles &particles, const Bonds *bonds, const BlockList *listed) {
  std::vector<IndexPair> pairs = near_pairs(particles.position.data(), particles.radius.data(),
                                            particles.size(), wide_skin_, nullptr, listed);
  if (bonds != nullptr) drop_bonded(pairs, *bonds);
  wide_.assign(pairs);
  moved_since_wide_ = 0;
  wide_valid_ = true;
}

void ContactSearch::rebuild_close(const Particles &particles) {
  close_.assign(wide_.rows_if([&](const IndexPair &p) {
    const double reach = particles.radius[p.first] + particles.radius[p.second] + close_skin_;
    return norm_squared(particles.position[p.second] - particles.position[p.first]) < reach * reach;
  }));
  moved_since_close_ = 0;
  close_valid_ = true;
}

bool ContactSearch::add_pair(IndexPair pair) {
  if (!wide_valid_) return false; // the next build finds it
  wide_.insert(pair);
  return close_.insert(pair);
}

void ContactSearch::keep_blocks(const std::vector<char> &marked) {
  visit_lists([&](auto &list) {
    const auto elsewhere = [&](IndexPair p) {
      return !marked[static_cast<std::size_t>(p.first) / block_rows];
    };
    list.erase(std::remove_if(list.begin(), list.end(), elsewhere), list.end());
  });
}

void ContactSearch::set_rest_distance(IndexPair pair, double distance) {
  if (!rest_.insert({pair, distance})) rest_.find(pair)->distance = distance;
}

double ContactSearch::rest_distance(IndexPair pair, const Particles &particles) const {
  const RestDistance *own = rest_.find(pair);
  return own != nullptr ? own->distance : particles.radius[pair.first] + particles.radius[pair.second];
}

void ContactSearch::describe(Archive &archive) {
  archive.version(1);
  archive("moved_since_wide", moved_since_wide_, "m", at_least(0));
  archive("moved_since_close", moved_since_close_, "m", at_least(0));
  archive("wide_valid", wide_valid_);
  archive("close_valid", close_valid_);
  std::vector<IndexPair> wide = wide_.rows(), close = close_.rows(), pairs;
  std::vector<double> distances;
  for (const RestDistance &rest : rest_.rows())
    pairs.push_back(rest.pair), distances.push_back(rest.distance);
  archive.rows("wide", wide);
  archive.rows("close", close);
  archive.rows("rest_pairs", pairs);
  archive.rows("rest_distances", distances, "m", above(0));
  if (const StateSource *state = archive.looks_at())
    require_as_many(*state, archive.path("rest_pairs"), archive.path("rest_distances"));
  if (!archive.reads()) return;
  std::vector<RestDistance> rest;
  for (std::size_t k = 0; k < pairs.size(); ++k)
    rest.push_back({pairs[k], distances[k]});
  wide_.assign(wide), close_.assign(close), rest_.assign(rest);
}

} // namespace platen::dem
