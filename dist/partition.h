// Assignment of blocks to ranks: about the same work for each rank, few ghosts between ranks.
#pragma once

#include <mpi.h>

#include <cstddef>
#include <string>
#include <vector>

#include "dist/block_graph.h"

namespace platen::dist {

enum class PartitionMethod {
  graph,     // Zoltan PHG: few ghosts between ranks
  bisection, // Zoltan RCB: planes across the longest side
  curve      // consecutive blocks; cannot fail
};

struct Partition {
  std::vector<int> rank; // of each block; ranks are numbered by their first block
  // Ranks with blocks are the first `useful_ranks`: fewer than all where there are fewer blocks than ranks.
  int useful_ranks = 0;
  PartitionMethod method = PartitionMethod::curve;
  double imbalance = 1;      // largest weight of a rank over the mean of the useful ones
  std::size_t cut_edges = 0; // pairs of neighbours on two ranks
  double cut_weight = 0;     // and the sum of their weights: ghosts between ranks
  std::size_t edges = 0;     // pairs of neighbours in all
};

struct PartitionLimits {
  double imbalance = 1.1; // up to this the cut with fewer ghosts wins, above it the better balanced one
  // Methods in addition to consecutive blocks, which are always tried.
  std::vector<PartitionMethod> methods = {PartitionMethod::graph, PartitionMethod::bisection};
};

// Cuts the graph by all methods and returns the best that leaves no useful rank without a block. The result
// depends only on graph, limits and `ranks`, not on the number of running ranks (but MPI must be
// initialised). Throws std::invalid_argument where the graph is not consistent (require_consistent) or ranks
// < 1.
Partition partition(const BlockGraph &graph, int ranks, const PartitionLimits &limits = {});

// The same for the running ranks: rank 0 computes the cut and sends it. Collective; every rank passes the
// same graph and limits.
Partition partition(const BlockGraph &graph, MPI_Comm ranks, const PartitionLimits &limits = {});

// Assigns consecutive blocks to `parts` ranks with the smallest possible maximum weight, at least one block
// each; returns the rank of each block. Needs 1 <= parts <= number of weights.
std::vector<int> cut_in_order(const std::vector<double> &weight, int parts);

// One line for a log: "graph: 64 blocks on 4 ranks, largest work 1.02 of the mean, 32 of 144 neighbours
// apart, 3200 ghosts".
std::string describe(const Partition &partition);

} // namespace platen::dist
