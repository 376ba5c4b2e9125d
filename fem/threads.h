// Threads of deal.II. Loops over cells and nodes use the pool of the process instead (base/parallel.h).
#pragma once

namespace platen::fem {

// deal.II copies the geometry of a cell from the one before where both are alike, but only where it may have
// one thread, and the last bits are others then. While any of these lives it may have two, so that matrices
// do not depend on what a program allows it; afterwards one: a process has no second pool.
class NoCellReuse {
public:
  NoCellReuse();
  ~NoCellReuse();
  NoCellReuse(const NoCellReuse &) = delete;
  NoCellReuse &operator=(const NoCellReuse &) = delete;
};

} // namespace platen::fem
