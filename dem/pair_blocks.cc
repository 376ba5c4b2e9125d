#include "dem/pair_blocks.h"

#include <algorithm>

#include "base/parallel.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Rows of particles that a block's pairs reach outside it, ascending, each once.
std::vector<int> reached_outside(const int *second, std::size_t from, std::size_t to, std::size_t end_row) {
  std::vector<int> rows;
  for (std::size_t k = from; k < to; ++k)
    if (static_cast<std::size_t>(second[k]) >= end_row) rows.push_back(second[k]);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

} // namespace

void PairBlocks::rebuild(const int *first, const int *second, std::size_t pairs, std::size_t particles,
                         bool rotation, int row_size) {
  const std::size_t count = number_of_blocks(particles);
  first_pair.assign(1, 0);
  first_ghost.assign(1, 0);
  ends.resize(pairs);
  ghost_particle.clear();
  std::size_t k = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t first_row = b * block_rows, end_row = std::min(particles, first_row + block_rows);
    const std::size_t from = k;
    while (k < pairs && static_cast<std::size_t>(first[k]) < end_row)
      ++k;
    const std::vector<int> outside = reached_outside(second, from, k, end_row);
    for (std::size_t n = from; n < k; ++n) {
      const std::size_t row = static_cast<std::size_t>(second[n]);
      const auto ghost = std::lower_bound(outside.begin(), outside.end(), second[n]) - outside.begin();
      const std::size_t inside =
          row < end_row ? row - first_row : end_row - first_row + static_cast<std::size_t>(ghost);
      ends[n] = {row_size * (first[n] - static_cast<int>(first_row)), row_size * static_cast<int>(inside)};
    }
    ghost_particle.insert(ghost_particle.end(), outside.begin(), outside.end());
    first_pair.push_back(k);
    first_ghost.push_back(ghost_particle.size());
  }
  ++cut_number_;
  const std::size_t ghosts = own_ghosts() + remote.size();
  ghost_force.assign(ghosts, Vector3{});
  ghost_torque.assign(rotation ? ghosts : 0, Vector3{});
  order_returns(count);
}

void PairBlocks::permute_pairs(std::size_t begin, const std::vector<int> &order) {
  std::vector<Ends> moved(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    moved[k] = ends[begin + static_cast<std::size_t>(order[k])];
  std::copy(moved.begin(), moved.end(), ends.begin() + static_cast<std::ptrdiff_t>(begin));
}

void PairBlocks::order_returns(std::size_t count) {
  struct From {
    int particle, block, ghost;
  };
  std::vector<From> all;
  all.reserve(own_ghosts() + remote.size());
  for (std::size_t b = 0; b < count; ++b)
    for (std::size_t g = first_ghost[b]; g < first_ghost[b + 1]; ++g)
      all.push_back({ghost_particle[g], static_cast<int>(b), static_cast<int>(g)});
  for (std::size_t k = 0; k < remote.size(); ++k)
    all.push_back({remote[k].particle, remote[k].block, static_cast<int>(own_ghosts() + k)});
  std::sort(all.begin(), all.end(), [](const From &a, const From &b) {
    return a.particle != b.particle ? a.particle < b.particle : a.block < b.block;
  });
  returns.resize(all.size());
  for (std::size_t r = 0; r < all.size(); ++r)
    returns[r] = {all[r].particle, all[r].ghost};
  first_return.assign(1, 0);
  std::size_t r = 0;
  for (std::size_t b = 0; b < count; ++b) {
    while (r < returns.size() && static_cast<std::size_t>(returns[r].particle) < (b + 1) * block_rows)
      ++r;
    first_return.push_back(r);
  }
}

int PairBlocks::ghost_of(int block, int particle) const {
  const auto at = [&](std::size_t k) { return ghost_particle.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto first = at(first_ghost[static_cast<std::size_t>(block)]),
             end = at(first_ghost[static_cast<std::size_t>(block) + 1]);
  const auto found = std::lower_bound(first, end, particle);
  return found != end && *found == particle ? static_cast<int>(found - ghost_particle.begin()) : -1;
}

void return_ghosts(Particles &p, const PairBlocks &blocks, std::size_t block) {
  if (blocks.returns.empty()) return;
  const bool turning = p.has_rotation();
  for (std::size_t r = blocks.first_return[block]; r < blocks.first_return[block + 1]; ++r) {
    const PairBlocks::Return &from = blocks.returns[r];
    p.force[from.particle] += blocks.ghost_force[from.ghost];
    if (turning) (*p.torque)[from.particle] += blocks.ghost_torque[from.ghost];
  }
}

std::size_t PairBlocks::bytes() const {
  return ends.capacity() * sizeof(Ends) + ghost_particle.capacity() * sizeof(int) +
         returns.capacity() * sizeof(Return) +
         (ghost_force.capacity() + ghost_torque.capacity()) * sizeof(Vector3) +
         (first_pair.capacity() + first_ghost.capacity() + first_return.capacity()) * sizeof(std::size_t);
}

} // namespace platen::dem
