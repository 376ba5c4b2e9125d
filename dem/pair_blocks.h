// The partition of pairs (bonds, contacts) by space: every block of particles owns the pairs whose first
// particle it holds.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {

// A pair that leaves its block adds to a ghost, a copy of the particle that it reaches; ghosts are returned
// to their particles in a fixed order. So blocks can be computed by any number of threads, without locks, to
// the same last bit.
struct PairBlocks {
  struct Return {
    int particle = 0; // row
    int ghost = 0;    // index into the ghosts
  };
  // Rows of a pair's particles in its block, its ghosts counted after its own, times `row_size` of rebuild.
  struct Ends {
    int first = 0, second = 0;
  };
  std::vector<std::size_t> first_pair;            // of each block, and the end
  std::vector<Ends> ends;                         // of each pair
  std::vector<std::size_t> first_ghost;           // of each block, and the end
  std::vector<int> ghost_particle;                // row of each ghost's particle
  std::vector<Vector3> ghost_force, ghost_torque; // N, N m; torque only with rotation
  std::vector<std::size_t> first_return;          // of each block, and the end
  std::vector<Return> returns;                    // to the particles of each block, ascending

  // From columns of `pairs` rows, sorted by first.
  void rebuild(const int *first, const int *second, std::size_t pairs, std::size_t particles, bool rotation,
               int row_size = 1);
  std::size_t blocks() const { return first_pair.empty() ? 0 : first_pair.size() - 1; }
  std::size_t bytes() const;
};

struct Particles;

// Adds to the particles of one block what pairs of other blocks exert on them.
void return_ghosts(Particles &particles, const PairBlocks &blocks, std::size_t block);

} // namespace platen::dem
