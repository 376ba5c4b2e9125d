// The two loops of the idealised step, and nothing else of it: kernels.cc alone is compiled with this
// machine's own instructions, which the product never is.
#pragma once

#include "limit/parts.h"

namespace platen::bench {

// Pointers to the columns, by row.
struct Columns {
  Pose *poses;
  Load *loads;         // what the bonds add to
  const Load *applied; // what the loads are reset to
  Motion *motions;
  const Increments *increments;
};

// Gather, compute, scatter: adds the part's bonds to loads and to the part's ghosts.
void add_bond_forces(Part &part, const Columns &columns);
// Kick and drift of the part's rows; resets their loads.
void integrate(const Part &part, const Columns &columns, double time_step);

} // namespace platen::bench
