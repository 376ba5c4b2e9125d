// Persistent threads that share the parts of a loop. A step has several loops of some hundred microseconds
// each, so a thread that waits for the next loop spins at first and does not sleep.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "base/loop.h"

namespace platen {

class ThreadPool {
public:
  ThreadPool() = default;
  ~ThreadPool();
  ThreadPool(const ThreadPool &) = delete;
  ThreadPool &operator=(const ThreadPool &) = delete;

  // Runs every part of both loops once, on up to `threads` threads including the caller's; returns when all
  // are done. Each thread starts with runs of neighbouring parts, first of one loop and then of the other,
  // always the same for equal numbers of parts, so that data stays in the caches of a core. A thread without
  // parts takes parts from others, of the second loop first: the loop with smaller parts should be the
  // second. Every other thread begins with its last part, and others take parts from the opposite end: two
  // threads meet in the middle, and only the parts there change threads from call to call. The call does not
  // wait for a thread that has not begun. A call inside a part, or during a call by another thread, runs on
  // its caller alone. An exception of a part reaches the caller when no thread is at work; of several, that
  // of the lowest part of the first loop, or else of the second. Throws std::length_error for 2^32 parts or
  // more.
  void run(const Loop &first, const Loop &second, int threads);

private:
  // Initial parts of a thread in a loop, [first, last) of them left: both in one number, so that no part is
  // taken from both ends at once.
  class alignas(64) Share {
  public:
    void set(std::size_t first, std::size_t last);
    bool take(bool lowest, std::size_t &part); // false: none is left

  private:
    static constexpr int bits = 32; // of the first, below the last
    std::atomic<std::uint64_t> left_{0};
  };
  using Shares = std::array<Share, 2>; // of each loop

  void resize(int threads);
  void divide_parts();
  void open_call();
  void close_call();
  void serve(std::size_t thread);
  void count_out();
  bool wait_for_call(unsigned done);
  void do_parts(std::size_t thread);
  void do_share(std::size_t thread, int loop, bool own);
  void do_part(int loop, std::size_t part);

  std::vector<std::thread> threads_; // all but the caller's
  std::vector<Shares> shares_;       // one per thread, the caller's first
  int checks_ = 0;                   // number of checks for the next call before a thread sleeps
  std::array<Loop, 2> loops_;        // of the open call
  unsigned calls_ = 0;

  std::mutex in_use_; // locked by a caller
  std::mutex mutex_;  // protects the next members
  std::condition_variable called_, done_;
  std::exception_ptr thrown_;
  std::pair<int, std::size_t> thrown_by_; // loop and part

  alignas(64) std::atomic<unsigned> open_call_{0}; // number of the call that may be joined; 0: none
  std::atomic<bool> stopping_{false};
  std::atomic<int> sleeping_{0}; // threads
  std::atomic<bool> caller_sleeps_{false};
  alignas(64) std::atomic<int> joined_{0}; // threads that may be at work for the caller
};

} // namespace platen
