// Threads of the finite elements' library.
#pragma once

namespace platen::fem {

// Loops over cells use at most `threads` threads from now on; 0: all that the process may have.
void limit_threads(int threads);

// deal.II copies the geometry of a cell from the one before where both are alike, but only on one thread, and
// the last bits are others then. While one of these lives it does not, so that matrices do not depend on the
// number of threads.
class NoCellReuse {
public:
  NoCellReuse();
  ~NoCellReuse();
  NoCellReuse(const NoCellReuse &) = delete;
  NoCellReuse &operator=(const NoCellReuse &) = delete;

private:
  bool alone_;
};

} // namespace platen::fem
