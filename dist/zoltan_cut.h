// A graph of blocks cut by Zoltan.
#pragma once

#include <optional>
#include <vector>

#include "dist/partition.h"

namespace platen::dist {

// Part of each block; parts may be empty. Nothing where Zoltan fails. Works on this rank alone: what Zoltan
// sends to find a cut together costs more than the search, up to some 1e5 blocks (1e8 spheres), and so the
// cut does not depend on who looks for it. `method` is graph or bisection; 2 <= parts. MPI must run.
std::optional<std::vector<int>> cut_by_zoltan(const BlockGraph &graph, int parts, PartitionMethod method);

} // namespace platen::dist
