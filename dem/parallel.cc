#include "dem/parallel.h"

#include <thread>

#ifndef PLATEN_SERIAL
#include <tbb/global_control.h>
#endif

namespace platen::dem {

ThreadLimit::ThreadLimit(int threads) {
#ifndef PLATEN_SERIAL
  if (threads > 0)
    control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                       static_cast<std::size_t>(threads));
#else
  (void)threads;
#endif
}

ThreadLimit::~ThreadLimit() {
#ifndef PLATEN_SERIAL
  delete static_cast<tbb::global_control *>(control_);
#endif
}

int hardware_threads() {
  const unsigned n = std::thread::hardware_concurrency();
  return n == 0 ? 1 : static_cast<int>(n);
}

} // namespace platen::dem
