#include "base/parallel.h"

#include <sched.h>

#include <thread>

#include "base/thread_pool.h"

namespace platen {

namespace {

int &threads_of_loops() {
  static int threads = hardware_threads();
  return threads;
}

ThreadPool &pool() {
  static ThreadPool threads;
  return threads;
}

} // namespace

int loop_threads() {
  return threads_of_loops();
}

void run_loops(const Loop &first, const Loop &second) {
  pool().run(first, second, loop_threads());
}

ThreadLimit::ThreadLimit(int threads) : before_(loop_threads()) {
  threads_of_loops() = threads > 0 ? threads : hardware_threads();
}

ThreadLimit::~ThreadLimit() {
  threads_of_loops() = before_;
}

int hardware_threads() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
  const unsigned n = std::thread::hardware_concurrency();
  return n == 0 ? 1 : static_cast<int>(n);
}

} // namespace platen
