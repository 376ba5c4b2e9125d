#include "fem/threads.h"

#include <deal.II/base/multithread_info.h>

namespace platen::fem {

void limit_threads(int threads) {
  dealii::MultithreadInfo::set_thread_limit(threads > 0 ? static_cast<unsigned>(threads)
                                                        : dealii::numbers::invalid_unsigned_int);
}

} // namespace platen::fem
