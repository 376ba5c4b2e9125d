// Persistent threads that share out the parts of a loop: a step is some loops of some hundred microseconds
// one after the other, so that a thread that waits for the next loop checks for it rather than sleep.
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

  // Every part of both loops once, on up to `threads` threads, the caller's among them; returns when all are
  // done. Each thread starts with runs of neighbouring parts, first of one loop and then of the other, the
  // same whenever the loops have as many parts, so that what a core has in its caches stays there. When it
  // has none left it takes from others, the second loop's first: of two loops, the one of smaller parts is
  // worth to be the second. Every other thread begins with its last part, and parts are taken from others at
  // the end that these have not come to: two threads meet in the middle, and what changes hands from call to
  // call is the parts there. No thread is waited for that has not begun. A call inside a part, or beside one
  // that another thread has made, runs on its caller alone. What a part throws reaches the caller once no
  // thread is at work; of several, what the lowest part of the first loop threw, or else of the second.
  // Throws std::length_error for 2^32 parts or more.
  void run(const Loop &first, const Loop &second, int threads);

private:
  // Parts of a loop that a thread starts with, [first, last) of them left: both in one number, so that none
  // is taken at both ends at once.
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
  std::vector<Shares> shares_;       // one for each thread, the caller's first
  int checks_ = 0;                   // for the next call, before a thread sleeps
  std::array<Loop, 2> loops_;        // of the open call
  unsigned calls_ = 0;

  std::mutex in_use_; // by a caller
  std::mutex mutex_;  // of what follows
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
