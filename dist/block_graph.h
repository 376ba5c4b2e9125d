// Graph of blocks of particles and their bonds, from which the cut of a specimen over ranks is computed.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::dem {
struct PairBlocks;
struct Particles;
} // namespace platen::dem

namespace platen::dist {

// The same on every rank. Block b contains the rows of block b of base/parallel.h; edges of a block ascend.
struct BlockGraph {
  std::vector<double> weight;          // of each block: work of a step, in bonds
  std::vector<Vector3> centre;         // of each block: mean of its reference positions, m
  std::vector<std::size_t> first_edge; // of each block, and the end
  std::vector<int> neighbour;          // of each edge: a block; each edge is listed in both blocks
  std::vector<double> edge_weight;     // ghosts between the two blocks, the same in both

  std::size_t blocks() const { return weight.size(); }
};

// Cost of kicks and drift of a particle, in bonds: 15 ns of 21 (bench/results/step.md).
constexpr double work_of_a_particle = .7;

// Graph from the particles and their bonds.
BlockGraph graph_of(const dem::PairBlocks &bonds, const dem::Particles &particles);

// Adds further pairs (contacts) of the same particles: weight 1 for each, and their ghosts.
void add_pairs(BlockGraph &graph, const dem::PairBlocks &pairs);

// Throws std::invalid_argument where lengths do not match, weights are negative or not finite, or an edge
// does not join two blocks, or is in one of its two blocks alone, or with another weight.
void require_consistent(const BlockGraph &graph);

} // namespace platen::dist
