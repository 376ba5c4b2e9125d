#include "dem/parallel.h"

#include <thread>

#ifndef PLATEN_SERIAL
#include <tbb/global_control.h>
#endif

namespace platen::dem {

namespace {

int &threads_of_loops() {
  static int threads = hardware_threads();
  return threads;
}

} // namespace

int loop_threads() {
  return threads_of_loops();
}

ThreadLimit::ThreadLimit(int threads) : before_(loop_threads()) {
  if (threads <= 0) threads = hardware_threads();
  threads_of_loops() = threads;
#ifndef PLATEN_SERIAL
  control_ = new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                     static_cast<std::size_t>(threads));
#endif
}

ThreadLimit::~ThreadLimit() {
  threads_of_loops() = before_;
#ifndef PLATEN_SERIAL
  delete static_cast<tbb::global_control *>(control_);
#endif
}

int hardware_threads() {
  const unsigned n = std::thread::hardware_concurrency();
  return n == 0 ? 1 : static_cast<int>(n);
}

} // namespace platen::dem
