// Loops over rows on several threads, and sums whose order does not depend on the number of threads.
// thread_pool.h describes how threads share a loop.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/loop.h"

namespace platen {

// Rows of one block. Blocks are cut by row number alone, never by thread, so that sums over blocks repeat
// bitwise.
constexpr std::size_t block_rows = 512;

inline std::size_t number_of_blocks(std::size_t rows, std::size_t per_block = block_rows) {
  return (rows + per_block - 1) / per_block;
}

// Threads that loops use now: those of the innermost ThreadLimit, or all that the process may have.
int loop_threads();

// Runs every part of both loops on the threads of loop_threads() (see thread_pool.h).
void run_loops(const Loop &first, const Loop &second = {});

// body(first, last, block) for every block of `per_block` rows of [0, rows), and at the same time another
// loop.
template <class Body>
void for_each_block(std::size_t rows, const Body &body, std::size_t per_block = block_rows,
                    const Loop &parallel_loop = {}) {
  const auto part = [&](std::size_t b) { body(b * per_block, std::min(rows, (b + 1) * per_block), b); };
  run_loops(loop_of(number_of_blocks(rows, per_block), part), parallel_loop);
}

// Block numbers, ascending.
using BlockList = std::vector<int>;

// The same for the listed blocks; without a list, for all.
template <class Body>
void for_listed_blocks(const BlockList *listed, std::size_t rows, const Body &body,
                       const Loop &parallel_loop = {}) {
  if (listed == nullptr) return for_each_block(rows, body, block_rows, parallel_loop);
  const auto part = [&](std::size_t k) {
    const std::size_t b = static_cast<std::size_t>((*listed)[k]);
    body(b * block_rows, std::min(rows, (b + 1) * block_rows), b);
  };
  run_loops(loop_of(listed->size(), part), parallel_loop);
}

// body(row) for every row. Use smaller blocks for expensive rows.
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

// Independent pieces of work; each may contain loops of its own. With at most as many threads as pieces, the
// pieces run in parallel; more threads are used better by the loops inside.
template <class Piece>
void at_once(std::size_t pieces, const Piece &piece) {
  if (pieces > 1 && static_cast<std::size_t>(loop_threads()) <= pieces)
    return run_loops(loop_of(pieces, piece));
  for (std::size_t p = 0; p < pieces; ++p)
    piece(p);
}

// Sum of body(first, last) over blocks, added in the order of the blocks. T needs T{} = 0 and +=.
template <class T, class Body>
T ordered_sum(std::size_t rows, const Body &body, std::size_t per_block = block_rows) {
  std::vector<T> partial(number_of_blocks(rows, per_block));
  for_each_block(
      rows, [&](std::size_t first, std::size_t last, std::size_t b) { partial[b] = body(first, last); },
      per_block);
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
};

// Cores that this process may run on (its affinity), at least 1.
int hardware_threads();

} // namespace platen
