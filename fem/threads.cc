#include "fem/threads.h"

#include <deal.II/base/multithread_info.h>

namespace platen::fem {

void limit_threads(int threads) {
  dealii::MultithreadInfo::set_thread_limit(threads > 0 ? static_cast<unsigned>(threads)
                                                        : dealii::numbers::invalid_unsigned_int);
}

NoCellReuse::NoCellReuse() : alone_(dealii::MultithreadInfo::n_threads() == 1) {
  if (alone_) dealii::MultithreadInfo::set_thread_limit(2);
}
NoCellReuse::~NoCellReuse() {
  if (alone_) dealii::MultithreadInfo::set_thread_limit(1);
}

} // namespace platen::fem
