#include "fem/loop.h"

#include <deal.II/base/multithread_info.h>
#include <deal.II/base/parallel.h>

namespace platen::fem {

void run_parts(std::size_t parts, const std::function<void(std::size_t)> &work) {
  const auto range = [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
      work(p);
  };
  if (parts < 2 || dealii::MultithreadInfo::n_threads() == 1) return range(0, parts);
  dealii::parallel::apply_to_subranges(std::size_t(0), parts, range, 1);
}

} // namespace platen::fem
