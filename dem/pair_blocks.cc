#include "dem/pair_blocks.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "dem/particles.h"

namespace platen::dem {
namespace {

// Index of each particle among the ghosts of a block.
class GhostPlaces {
public:
  explicit GhostPlaces(std::size_t particles) : block_(particles, -1), place_(particles) {}
  // Collects the rows of particles outside a block that its pairs reach, ascending, each once.
  void put(int block, const int *second, std::size_t from, std::size_t to, std::size_t end_row,
           std::vector<int> &outside) {
    outside.clear();
    for (std::size_t k = from; k < to; ++k) {
      const int row = second[k];
      if (static_cast<std::size_t>(row) < end_row || block_[static_cast<std::size_t>(row)] == block) continue;
      block_[static_cast<std::size_t>(row)] = block;
      outside.push_back(row);
    }
    std::sort(outside.begin(), outside.end());
    for (std::size_t g = 0; g < outside.size(); ++g)
      place_[static_cast<std::size_t>(outside[g])] = static_cast<int>(g);
  }
  int operator[](int row) const { return place_[static_cast<std::size_t>(row)]; }

private:
  std::vector<int> block_, place_;
};

} // namespace

void PairBlocks::rebuild(const int *first, const int *second, std::size_t pairs, std::size_t particles,
                         bool rotation, int row_size, const std::vector<char> *changed) {
  const std::size_t count = number_of_blocks(particles);
  const PairBlocks::Cut before{std::move(first_pair), std::move(ends), std::move(first_ghost),
                               std::move(ghost_particle)};
  added_ghosts.assign(count, {});
  added_returns.assign(count, {});
  first_pair.assign(1, 0);
  first_ghost.assign(1, 0);
  ends.resize(pairs);
  ghost_particle.clear();
  ghost_particle.reserve(before.ghost_particle.size());
  GhostPlaces places(particles);
  std::vector<int> outside;
  std::size_t k = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t from = k;
    if (changed != nullptr && !(*changed)[b]) {
      k += before.copy_block(b, ends.data() + from, ghost_particle);
    } else {
      const std::size_t first_row = b * block_rows, end_row = std::min(particles, first_row + block_rows);
      while (k < pairs && static_cast<std::size_t>(first[k]) < end_row)
        ++k;
      places.put(static_cast<int>(b), second, from, k, end_row, outside);
      const int begin = static_cast<int>(first_row), own = static_cast<int>(end_row - first_row);
      for (std::size_t n = from; n < k; ++n) {
        const bool inside = static_cast<std::size_t>(second[n]) < end_row;
        ends[n] = {row_size * (first[n] - begin),
                   row_size * (inside ? second[n] - begin : own + places[second[n]])};
      }
      ghost_particle.insert(ghost_particle.end(), outside.begin(), outside.end());
    }
    first_pair.push_back(k);
    first_ghost.push_back(ghost_particle.size());
  }
  ++cut_number_;
  rotation_ = rotation, row_size_ = row_size;
  const std::size_t ghosts = own_ghosts() + remote.size();
  ghost_force.assign(ghosts, Vector3{});
  ghost_torque.assign(rotation ? ghosts : 0, Vector3{});
  order_returns(count);
}

// Returns the number of pairs.
std::size_t PairBlocks::Cut::copy_block(std::size_t block, Ends *to, std::vector<int> &ghosts) const {
  const auto part = [block](const auto &of, const std::vector<std::size_t> &from) {
    const auto at = [&](std::size_t k) { return of.begin() + static_cast<std::ptrdiff_t>(from[k]); };
    return std::pair{at(block), at(block + 1)};
  };
  const auto [first, last] = part(ends, first_pair);
  const auto [ghost, end] = part(ghost_particle, first_ghost);
  std::copy(first, last, to);
  ghosts.insert(ghosts.end(), ghost, end);
  return static_cast<std::size_t>(last - first);
}

void PairBlocks::permute_pairs(std::size_t begin, const std::vector<int> &order) {
  std::vector<Ends> moved(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    moved[k] = ends[begin + static_cast<std::size_t>(order[k])];
  std::copy(moved.begin(), moved.end(), ends.begin() + static_cast<std::ptrdiff_t>(begin));
}

// Sorted by particle, and for one particle by the block that the return comes from.
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
  if (!remote.empty()) // own ghosts are in the order of blocks already
    std::stable_sort(all.begin(), all.end(), [](const From &a, const From &b) { return a.block < b.block; });
  std::vector<std::size_t> next(count * block_rows + 1, 0); // of each particle: where its returns begin
  for (const From &from : all)
    ++next[static_cast<std::size_t>(from.particle) + 1];
  for (std::size_t i = 0; i + 1 < next.size(); ++i)
    next[i + 1] += next[i];
  first_return.resize(count + 1);
  for (std::size_t b = 0; b <= count; ++b)
    first_return[b] = next[b * block_rows];
  returns.resize(all.size());
  for (const From &from : all)
    returns[next[static_cast<std::size_t>(from.particle)]++] = {from.particle, from.ghost};
}

void PairBlocks::add(int first, int second, std::size_t particles) {
  const std::size_t block = static_cast<std::size_t>(first) / block_rows, begin = block * block_rows,
                    end = std::min(particles, begin + block_rows);
  int to = second - static_cast<int>(begin);
  if (static_cast<std::size_t>(second) >= end) {
    int ghost = ghost_of(static_cast<int>(block), second);
    if (ghost < 0) ghost = new_ghost(static_cast<int>(block), second);
    to = static_cast<int>(end - begin) + ghost - static_cast<int>(first_ghost[block]);
  }
  ends.push_back({row_size_ * (first - static_cast<int>(begin)), row_size_ * to});
}

// Adds a ghost behind those of all blocks.
int PairBlocks::new_ghost(int block, int particle) {
  const int ghost = static_cast<int>(ghost_particle.size());
  ghost_particle.push_back(particle);
  ghost_force.emplace_back();
  if (rotation_) ghost_torque.emplace_back();
  added_ghosts[static_cast<std::size_t>(block)].push_back(ghost);
  std::vector<AddedReturn> &added = added_returns[static_cast<std::size_t>(particle) / block_rows];
  const auto place = std::partition_point(added.begin(), added.end(), [&](const AddedReturn &r) {
    return r.to.particle != particle ? r.to.particle < particle : r.from < block;
  });
  added.insert(place, {{particle, ghost}, block});
  return ghost;
}

int PairBlocks::block_of_ghost(int ghost) const {
  const auto after =
      std::upper_bound(first_ghost.begin(), first_ghost.end(), static_cast<std::size_t>(ghost));
  return static_cast<int>(after - first_ghost.begin()) - 1;
}

void PairBlocks::clear_ghosts(std::size_t block) {
  const auto clear = [&](std::size_t from, std::size_t count) {
    std::fill_n(ghost_force.begin() + static_cast<std::ptrdiff_t>(from), count, Vector3{});
    if (rotation_) std::fill_n(ghost_torque.begin() + static_cast<std::ptrdiff_t>(from), count, Vector3{});
  };
  clear(first_ghost[block], first_ghost[block + 1] - first_ghost[block]);
  for (const int ghost : added_ghosts[block])
    clear(static_cast<std::size_t>(ghost), 1);
}

int PairBlocks::ghost_of(int block, int particle) const {
  const auto at = [&](std::size_t k) { return ghost_particle.begin() + static_cast<std::ptrdiff_t>(k); };
  const auto first = at(first_ghost[static_cast<std::size_t>(block)]),
             end = at(first_ghost[static_cast<std::size_t>(block) + 1]);
  const auto found = std::lower_bound(first, end, particle);
  if (found != end && *found == particle) return static_cast<int>(found - ghost_particle.begin());
  for (const int ghost : added_ghosts[static_cast<std::size_t>(block)])
    if (ghost_particle[static_cast<std::size_t>(ghost)] == particle) return ghost;
  return -1;
}

// Ghosts of one particle are added in the order of the blocks that they come from.
void return_ghosts(Particles &p, const PairBlocks &blocks, std::size_t block) {
  if (blocks.ghost_force.empty()) return;
  const bool turning = p.has_rotation();
  const auto give = [&](const PairBlocks::Return &from) {
    p.force[from.particle] += blocks.ghost_force[from.ghost];
    if (turning) (*p.torque)[from.particle] += blocks.ghost_torque[from.ghost];
  };
  std::size_t r = blocks.first_return[block];
  const std::size_t end = blocks.first_return[block + 1];
  for (const PairBlocks::AddedReturn &added : blocks.added_returns[block]) {
    const auto comes_before = [&](const PairBlocks::Return &one) {
      return one.particle != added.to.particle ? one.particle < added.to.particle
                                               : blocks.block_of_ghost(one.ghost) < added.from;
    };
    for (; r < end && comes_before(blocks.returns[r]); ++r)
      give(blocks.returns[r]);
    give(added.to);
  }
  for (; r < end; ++r)
    give(blocks.returns[r]);
}

std::size_t PairBlocks::bytes() const {
  return ends.capacity() * sizeof(Ends) + ghost_particle.capacity() * sizeof(int) +
         returns.capacity() * sizeof(Return) +
         (ghost_force.capacity() + ghost_torque.capacity()) * sizeof(Vector3) +
         (first_pair.capacity() + first_ghost.capacity() + first_return.capacity()) * sizeof(std::size_t);
}

} // namespace platen::dem
