// The partition of the bonds by space: every block of particles owns the bonds whose first particle it holds.
#pragma once

#include <cstddef>
#include <vector>

#include "dem/vector3.h"

namespace platen::dem {

// A bond that leaves its block adds to a ghost, a copy of the particle that it reaches; ghosts are returned
// to their particles in a fixed order. So blocks can be computed by any number of threads, without locks, to
// the same last bit.
struct BondBlocks {
  struct Return {
    int particle = 0; // row
    int ghost = 0;    // index into the ghosts
  };
  std::vector<std::size_t> first_bond;  // of each block, and the end
  std::vector<int> local;               // of each bond: row of its second particle among its block's sums
  std::vector<std::size_t> first_ghost; // of each block, and the end
  std::vector<Vector3> ghost_force, ghost_torque; // N, N m; torque only with rotation
  std::vector<std::size_t> first_return;          // of each block, and the end
  std::vector<Return> returns;                    // to the particles of each block, ascending
  std::size_t most_ghosts = 0;                    // of one block

  // From columns of `bonds` rows, sorted by first.
  void rebuild(const int *first, const int *second, std::size_t bonds, std::size_t particles, bool rotation);
  std::size_t blocks() const { return first_bond.empty() ? 0 : first_bond.size() - 1; }
  std::size_t bytes() const;
};

} // namespace platen::dem
