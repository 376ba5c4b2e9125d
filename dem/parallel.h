// Loops over rows on several threads, and sums whose order does not depend on the number of threads: the only
// header that names a threading backend (TBB; PLATEN_SERIAL leaves it out, for ThreadSanitizer and tiny
// builds).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#ifndef PLATEN_SERIAL
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#endif

namespace platen::dem {

// Rows of one block. Blocks are cut by row number alone, never by thread, so that sums over blocks repeat
// bitwise.
constexpr std::size_t block_rows = 1024;

inline std::size_t number_of_blocks(std::size_t rows) {
  return (rows + block_rows - 1) / block_rows;
}

// body(first, last, block) for every block of rows [0, rows).
template <class Body>
void for_each_block(std::size_t rows, const Body &body) {
  const std::size_t blocks = number_of_blocks(rows);
  const auto run = [&](std::size_t b) { body(b * block_rows, std::min(rows, (b + 1) * block_rows), b); };
#ifndef PLATEN_SERIAL
  if (blocks > 1) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, blocks, 1),
        [&](const tbb::blocked_range<std::size_t> &range) {
          for (std::size_t b = range.begin(); b != range.end(); ++b)
            run(b);
        },
        tbb::static_partitioner());
    return;
  }
#endif
  for (std::size_t b = 0; b < blocks; ++b)
    run(b);
}

// body(row) for every row.
template <class Body>
void for_each(std::size_t rows, const Body &body) {
  for_each_block(rows, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t k = first; k < last; ++k)
      body(k);
  });
}

// Sum of body(first, last) over blocks, added in the order of the blocks. T needs T{} = 0 and +=.
template <class T, class Body>
T ordered_sum(std::size_t rows, const Body &body) {
  std::vector<T> partial(number_of_blocks(rows));
  for_each_block(rows,
                 [&](std::size_t first, std::size_t last, std::size_t b) { partial[b] = body(first, last); });
  T sum{};
  for (const T &p : partial)
    sum += p;
  return sum;
}

// Limits the threads of all loops until it is destroyed; 0 leaves the choice to the backend.
class ThreadLimit {
public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit &) = delete;
  ThreadLimit &operator=(const ThreadLimit &) = delete;

private:
  void *control_ = nullptr;
};

int hardware_threads();

} // namespace platen::dem
