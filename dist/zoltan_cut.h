// Cut of a graph of blocks by Zoltan.
#pragma once

#include <optional>
#include <vector>

#include "dist/partition.h"

namespace platen::dist {

// Part of each block; parts may be empty. No value where Zoltan fails. Works on this rank alone: in a
// parallel search Zoltan's communication costs more than the search, up to some 1e5 blocks (1e8 spheres). So
// the cut does not depend on the running ranks. `method` is graph or bisection; 2 <= parts. MPI must run.
std::optional<std::vector<int>> cut_by_zoltan(const BlockGraph &graph, int parts, PartitionMethod method);

} // namespace platen::dist
