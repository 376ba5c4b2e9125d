// Loops over cells and nodes on several threads (as many as limit_threads allows). Parts are cut by number
// alone, and sums are added in the order of the parts: the same to the last bit for any number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace platen::fem {

// work(part) once for each of `parts` parts, in any order.
void run_parts(std::size_t parts, const std::function<void(std::size_t)> &work);

// body(first, last) over [0, count) in parts of `grain`.
template <class Body>
void for_each_part(std::size_t count, std::size_t grain, const Body &body) {
  run_parts((count + grain - 1) / grain,
            [&](std::size_t p) { body(p * grain, std::min(count, (p + 1) * grain)); });
}

// Sum of body(first, last) over parts of `grain`, in order. T needs T{} = 0 and +=.
template <class T, class Body>
T part_sum(std::size_t count, std::size_t grain, const Body &body) {
  std::vector<T> sums((count + grain - 1) / grain);
  for_each_part(count, grain,
                [&](std::size_t first, std::size_t last) { sums[first / grain] = body(first, last); });
  T total{};
  for (const T &sum : sums)
    total += sum;
  return total;
}

} // namespace platen::fem
