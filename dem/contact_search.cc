#include "dem/contact_search.h"

#include <algorithm>

#include "base/parallel.h"
#include "base/state.h"

namespace platen::dem {
namespace {

// Drops the pairs that an intact bond holds together, or that one that remembers is the contact of: those
// stay as long as there are records. Both are sorted by (first, second).
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

template <class RestDistance>
bool before(const RestDistance &a, const IndexPair &b) {
  return a.pair < b;
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
  wide_ = near_pairs(particles.position.data(), particles.radius.data(), particles.size(), wide_skin_,
                     nullptr, listed);
  if (bonds != nullptr) drop_bonded(wide_, *bonds);
  wide_.shrink_to_fit();
  moved_since_wide_ = 0;
  wide_valid_ = true;
}

void ContactSearch::rebuild_close(const Particles &particles) {
  close_.clear();
  for (const IndexPair &p : wide_) {
    const double reach = particles.radius[p.first] + particles.radius[p.second] + close_skin_;
    if (norm_squared(particles.position[p.second] - particles.position[p.first]) < reach * reach)
      close_.push_back(p);
  }
  moved_since_close_ = 0;
  close_valid_ = true;
}

bool ContactSearch::add_pair(IndexPair pair) {
  if (!wide_valid_) return false; // the next build finds it
  bool added = false;
  for (std::vector<IndexPair> *list : {&wide_, &close_}) {
    const auto at = std::lower_bound(list->begin(), list->end(), pair);
    added = at == list->end() || !(*at == pair);
    if (added) list->insert(at, pair);
  }
  return added;
}

void ContactSearch::keep_blocks(const std::vector<char> &marked) {
  visit_lists([&](auto &list) {
    const auto elsewhere = [&](IndexPair p) {
      return !marked[static_cast<std::size_t>(p.first) / block_rows];
    };
    list.erase(std::remove_if(list.begin(), list.end(), elsewhere), list.end());
    list.shrink_to_fit();
  });
}

void ContactSearch::set_rest_distance(IndexPair pair, double distance) {
  const auto at = std::lower_bound(rest_.begin(), rest_.end(), pair, before<RestDistance>);
  if (at != rest_.end() && at->pair == pair)
    at->distance = distance;
  else
    rest_.insert(at, {pair, distance});
}

double ContactSearch::rest_distance(IndexPair pair, const Particles &particles) const {
  const auto at = std::lower_bound(rest_.begin(), rest_.end(), pair, before<RestDistance>);
  if (at != rest_.end() && at->pair == pair) return at->distance;
  return particles.radius[pair.first] + particles.radius[pair.second];
}

std::size_t ContactSearch::bytes() const {
  return (wide_.capacity() + close_.capacity()) * sizeof(IndexPair) + rest_.capacity() * sizeof(RestDistance);
}

void ContactSearch::describe(Archive &archive) {
  archive.version(1);
  archive("moved_since_wide", moved_since_wide_, "m", at_least(0));
  archive("moved_since_close", moved_since_close_, "m", at_least(0));
  archive("wide_valid", wide_valid_);
  archive("close_valid", close_valid_);
  archive.rows("wide", wide_);
  archive.rows("close", close_);
  std::vector<IndexPair> pairs;
  std::vector<double> distances;
  for (const RestDistance &rest : rest_)
    pairs.push_back(rest.pair), distances.push_back(rest.distance);
  archive.rows("rest_pairs", pairs);
  archive.rows("rest_distances", distances, "m", above(0));
  if (const StateSource *state = archive.looks_at())
    require_as_many(*state, archive.path("rest_pairs"), archive.path("rest_distances"));
  if (!archive.reads()) return;
  rest_.clear();
  for (std::size_t k = 0; k < pairs.size(); ++k)
    rest_.push_back({pairs[k], distances[k]});
}

} // namespace platen::dem
