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
#include <tbb/parallel_invoke.h>
#endif

namespace platen::dem {

// Rows of one block. Blocks are cut by row number alone, never by thread, so that sums over blocks repeat
// bitwise.
constexpr std::size_t block_rows = 512;

inline std::size_t number_of_blocks(std::size_t rows, std::size_t per_block = block_rows) {
  return (rows + per_block - 1) / per_block;
}

// Runs of blocks that a loop is cut into, so that a thread that is done early takes over from another.
constexpr std::size_t parts_per_thread = 32;

// Threads that loops use now: those of the innermost ThreadLimit, or all that the process may have.
int loop_threads();

// body(first, last, block) for every block of `per_block` rows of [0, rows). Threads take runs of
// neighbouring blocks, and further runs from each other. (TBB's static partitioner mails tasks to threads
// that may not exist, and such mail is never freed: with a limit of one thread a run of hours would eat the
// memory.)
template <class Body>
void for_each_block(std::size_t rows, const Body &body, std::size_t per_block = block_rows) {
  const std::size_t blocks = number_of_blocks(rows, per_block);
  const auto run = [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b)
      body(b * per_block, std::min(rows, (b + 1) * per_block), b);
  };
#ifndef PLATEN_SERIAL
  const std::size_t threads = static_cast<std::size_t>(loop_threads());
  const std::size_t parts = std::min(blocks, threads * parts_per_thread);
  if (threads > 1 && parts > 1) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, parts, 1),
        [&](const tbb::blocked_range<std::size_t> &range) {
          for (std::size_t p = range.begin(); p != range.end(); ++p)
            run(p * blocks / parts, (p + 1) * blocks / parts);
        },
        tbb::simple_partitioner());
    return;
  }
#endif
  run(0, blocks);
}

// body(row) for every row. Rows that cost much are worth a thread in smaller blocks.
template <class Body>
void for_each(std::size_t rows, const Body &body, std::size_t per_block = block_rows) {
  for_each_block(
      rows,
      [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t k = first; k < last; ++k)
          body(k);
      },
      per_block);
}

// Two pieces of work that touch nothing in common; each may hold loops of its own.
template <class One, class Other>
void both(const One &one, const Other &other) {
#ifndef PLATEN_SERIAL
  if (loop_threads() > 1) return tbb::parallel_invoke(one, other);
#endif
  one();
  other();
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

// Sets the threads of all loops until it is destroyed; 0: all that the process may have.
class ThreadLimit {
public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit &) = delete;
  ThreadLimit &operator=(const ThreadLimit &) = delete;

private:
  int before_;
  void *control_ = nullptr;
};

int hardware_threads();

} // namespace platen::dem
