// The partition of pairs (bonds, contacts) by space: every block of particles owns the pairs whose first
// particle it holds.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// A pair that leaves its block adds to a ghost, a copy of the particle that it reaches; ghosts are returned
// to their particles in the order of the blocks that they come from. So blocks can be computed by any number
// of threads, without locks, to the same last bit.
struct PairBlocks {
  struct Return {
    int particle = 0; // row
    int ghost = 0;    // index into the ghosts
  };
  // Rows of a pair's particles in its block, its ghosts counted after its own, times `row_size` of rebuild.
  struct Ends {
    int first = 0, second = 0;
  };
  struct AddedReturn {
    Return to;
    int from = 0; // block
  };
  // A ghost of a block that is computed elsewhere, on another rank: what comes from there is put behind the
  // own ghosts' forces, in this order.
  struct Remote {
    int particle = 0, block = 0; // row, and where it comes from
  };
  std::vector<std::size_t> first_pair;                 // of each block, and the end
  std::vector<Ends> ends;                              // of each pair
  std::vector<std::size_t> first_ghost;                // of each block, and the end
  std::vector<int> ghost_particle;                     // row of each ghost's particle
  std::vector<Vector3> ghost_force, ghost_torque;      // N, N m; torque only with rotation
  std::vector<Remote> remote;                          // kept by rebuild()
  std::vector<std::vector<int>> added_ghosts;          // of each block: ghosts of pairs that were added to it
  std::vector<std::size_t> first_return;               // of each block, and the end
  std::vector<Return> returns;                         // to the particles of each block, ascending
  std::vector<std::vector<AddedReturn>> added_returns; // to those of each block: of added ghosts, in order

  // From columns of `pairs` rows, those of one block of first particles together, blocks ascending.
  // `changed`: the blocks whose pairs are others than at the last call; of all where it is null.
  void rebuild(const int *first, const int *second, std::size_t pairs, std::size_t particles, bool rotation,
               int row_size = 1, const std::vector<char> *changed = nullptr);
  // One more pair of a block, behind all others until the next rebuild(). Costs what two blocks hold, however
  // many there are. Not while there are `remote` ghosts.
  void add(int first, int second, std::size_t particles);
  // Pair begin + k becomes the former pair begin + order[k], all of them of one block.
  void permute_pairs(std::size_t begin, const std::vector<int> &order);
  std::size_t blocks() const { return first_pair.empty() ? 0 : first_pair.size() - 1; }
  std::size_t own_ghosts() const { return ghost_particle.size(); }
  // Sets the forces in all ghosts of a block to zero.
  void clear_ghosts(std::size_t block);
  // The block of a ghost that was there at the last rebuild().
  int block_of_ghost(int ghost) const;
  // Index of the ghost of a particle in a block; -1 where there is none.
  int ghost_of(int block, int particle) const;
  unsigned cut_number() const { return cut_number_; } // another one after each rebuild(), never 0
  std::size_t bytes() const;

private:
  // What rebuild() makes of the pairs.
  struct Cut {
    std::vector<std::size_t> first_pair;
    std::vector<Ends> ends;
    std::vector<std::size_t> first_ghost;
    std::vector<int> ghost_particle;
    std::size_t copy_block(std::size_t block, Ends *to, std::vector<int> &ghosts) const;
  };
  void order_returns(std::size_t blocks);
  int new_ghost(int block, int particle);
  unsigned cut_number_ = 0;
  bool rotation_ = false;
  int row_size_ = 1;
};

struct Particles;

// Adds to the particles of one block what pairs of other blocks exert on them.
void return_ghosts(Particles &particles, const PairBlocks &blocks, std::size_t block);

} // namespace platen::dem
