#include "dem/contact_search.h"

#include <algorithm>

namespace platen::dem {
namespace {

bool is_bonded(const Bonds &bonds, IndexPair pair) {
  for (int e = bonds.incidence_offset[pair.first]; e < bonds.incidence_offset[pair.first + 1]; ++e) {
    const int row = bonds.incidence[e] / 2;
    if (bonds.normal_stiffness[row] == 0.0) continue;
    if (bonds.first[row] == pair.second || bonds.second[row] == pair.second) return true;
  }
  return false;
}

bool before(const ContactSearch::RestDistance &a, const IndexPair &b) {
  return a.pair < b;
}

} // namespace

void ContactSearch::moved(double distance) {
  moved_since_wide_ += distance;
  moved_since_close_ += distance;
}

bool ContactSearch::update(const Particles &particles, const Bonds *bonds) {
  // Both partners may have moved towards each other.
  if (!wide_valid_ || 2 * moved_since_wide_ + close_skin_ >= wide_skin_)
    rebuild_wide(particles, bonds);
  else if (close_valid_ && 2 * moved_since_close_ < close_skin_)
    return false;
  rebuild_close(particles);
  return true;
}

void ContactSearch::rebuild_wide(const Particles &particles, const Bonds *bonds) {
  wide_ = near_pairs(particles.position.data(), particles.radius.data(), particles.size(), wide_skin_);
  if (bonds != nullptr)
    wide_.erase(std::remove_if(wide_.begin(), wide_.end(), [&](IndexPair p) { return is_bonded(*bonds, p); }),
                wide_.end());
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

void ContactSearch::add_pair(IndexPair pair) {
  if (!wide_valid_) return; // the next build finds it
  const auto at = std::lower_bound(wide_.begin(), wide_.end(), pair);
  if (at == wide_.end() || !(*at == pair)) wide_.insert(at, pair);
  close_valid_ = false;
}

void ContactSearch::set_rest_distance(IndexPair pair, double distance) {
  const auto at = std::lower_bound(rest_.begin(), rest_.end(), pair, before);
  if (at != rest_.end() && at->pair == pair)
    at->distance = distance;
  else
    rest_.insert(at, {pair, distance});
}

double ContactSearch::rest_distance(IndexPair pair, const Particles &particles) const {
  const auto at = std::lower_bound(rest_.begin(), rest_.end(), pair, before);
  if (at != rest_.end() && at->pair == pair) return at->distance;
  return particles.radius[pair.first] + particles.radius[pair.second];
}

std::size_t ContactSearch::bytes() const {
  return (wide_.capacity() + close_.capacity()) * sizeof(IndexPair) + rest_.capacity() * sizeof(RestDistance);
}

} // namespace platen::dem
