#include "fem/threads.h"

#include <deal.II/base/multithread_info.h>

#include <mutex>

namespace platen::fem {

namespace {

// Bodies may be made on several threads at once.
void count(int more) {
  static std::mutex mutex;
  static int alive = 0;
  const std::lock_guard<std::mutex> lock(mutex);
  const int before = alive;
  alive += more;
  if (before == 0 || alive == 0) dealii::MultithreadInfo::set_thread_limit(alive == 0 ? 1 : 2);
}

} // namespace

NoCellReuse::NoCellReuse() {
  count(1);
}

NoCellReuse::~NoCellReuse() {
  count(-1);
}

} // namespace platen::fem
