// Spatial partition of pairs (bonds, contacts): every block of particles owns the pairs whose first particle
// is in the block.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// A pair whose second particle is in another block adds its force to a ghost, a copy of that particle. Ghosts
// are returned to their particles in the order of the blocks that they come from, so that any number of
// threads can compute blocks, without locks, to the same last bit.
struct PairBlocks {
  struct Return {
    int particle = 0; // row
    int ghost = 0;    // index into the ghosts
  };
  // Rows of a pair's particles in its block, ghosts after own particles, times `row_size` of rebuild().
  struct Ends {
    int first = 0, second = 0;
  };
  struct AddedReturn {
    Return to;
    int from = 0; // block
  };
  // A ghost of a block that another rank computes: its forces are put behind those of the own ghosts, in this
  // order.
  struct Remote {
    int particle = 0, block = 0; // row; block that the force comes from
  };
  std::vector<std::size_t> first_pair;                 // of each block, and the end
  std::vector<Ends> ends;                              // of each pair
  std::vector<std::size_t> first_ghost;                // of each block, and the end
  std::vector<int> ghost_particle;                     // row of each ghost's particle
  std::vector<Vector3> ghost_force, ghost_torque;      // N, N m; torque only with rotation
  std::vector<Remote> remote;                          // kept by rebuild()
  std::vector<std::vector<int>> added_ghosts;          // of each block: ghosts of pairs added to it
  std::vector<std::size_t> first_return;               // of each block, and the end
  std::vector<Return> returns;                         // to the particles of each block, ascending
  std::vector<std::vector<AddedReturn>> added_returns; // the same for added ghosts, in order

  // From columns of `pairs` rows, grouped by the block of the first particle, blocks ascending. `changed`
  // marks the blocks whose pairs differ from the last call; null: all blocks.
  void rebuild(const int *first, const int *second, std::size_t pairs, std::size_t particles, bool rotation,
               int row_size = 1, const std::vector<char> *changed = nullptr);
  // Adds a pair behind all others until the next rebuild(). The cost depends on the size of two blocks, not
  // on their number. Not allowed while there are `remote` ghosts.
  void add(int first, int second, std::size_t particles);
  // Pair begin + k becomes the former pair begin + order[k]; all of them belong to one block.
  void permute_pairs(std::size_t begin, const std::vector<int> &order);
  std::size_t blocks() const { return first_pair.empty() ? 0 : first_pair.size() - 1; }
  std::size_t own_ghosts() const { return ghost_particle.size(); }
  // Sets the forces in all ghosts of a block to zero.
  void clear_ghosts(std::size_t block);
  // The block of a ghost that existed at the last rebuild().
  int block_of_ghost(int ghost) const;
  // Index of the ghost of a particle in a block; -1 if there is none.
  int ghost_of(int block, int particle) const;
  unsigned cut_number() const { return cut_number_; } // changes with each rebuild(); 0 before the first
  std::size_t bytes() const;

private:
  // Results of rebuild() for the pairs.
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

// Adds the forces of pairs of other blocks to the particles of one block.
void return_ghosts(Particles &particles, const PairBlocks &blocks, std::size_t block);

} // namespace platen::dem
