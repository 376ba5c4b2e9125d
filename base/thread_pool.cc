#include "base/thread_pool.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "base/parallel.h"

namespace platen {

namespace {

// About ten microseconds: longer than the time between two loops of a step, short compared with the time
// slice of a scheduler.
constexpr int checks_before_sleep = 1000;

constexpr std::size_t most_parts = std::numeric_limits<std::uint32_t>::max();

thread_local bool inside_part = false;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

} // namespace

ThreadPool::~ThreadPool() {
  resize(1);
}

void ThreadPool::run(const Loop &first, const Loop &second, int threads) {
  if (first.parts + second.parts < 2 || threads < 2 || inside_part || !in_use_.try_lock()) {
    for (const Loop *loop : {&first, &second})
      for (std::size_t part = 0; part < loop->parts; ++part)
        loop->call(loop->body, part);
    return;
  }
  const std::lock_guard<std::mutex> until_done(in_use_, std::adopt_lock);
  if (std::max(first.parts, second.parts) > most_parts)
    throw std::length_error("a loop has more than 4294967295 parts");
  if (shares_.size() != static_cast<std::size_t>(threads)) resize(threads);
  loops_ = {first, second};
  divide_parts();
  thrown_ = nullptr;
  open_call();
  inside_part = true;
  do_parts(0);
  inside_part = false;
  close_call();
  if (thrown_) std::rethrow_exception(thrown_);
}

// With more threads than cores, spinning would keep other threads from their work.
void ThreadPool::resize(int threads) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  called_.notify_all();
  for (std::thread &thread : threads_)
    thread.join();
  threads_.clear();
  stopping_ = false;
  const std::size_t size = static_cast<std::size_t>(threads);
  checks_ = threads <= hardware_threads() ? checks_before_sleep : 0;
  shares_ = std::vector<Shares>(size);
  for (std::size_t k = 1; k < size; ++k)
    threads_.emplace_back([this, k] { serve(k); });
}

void ThreadPool::divide_parts() {
  const std::size_t size = shares_.size();
  for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    for (std::size_t k = 0; k < size; ++k)
      shares_[k][loop].set(k * loops_[loop].parts / size, (k + 1) * loops_[loop].parts / size);
}

void ThreadPool::Share::set(std::size_t first, std::size_t last) {
  left_.store(first | static_cast<std::uint64_t>(last) << bits, std::memory_order_relaxed);
}

bool ThreadPool::Share::take(bool lowest, std::size_t &part) {
  constexpr std::uint64_t one_less_at_end = std::uint64_t{1} << bits;
  std::uint64_t left = left_.load();
  for (;;) {
    const std::uint64_t first = left & (one_less_at_end - 1), last = left >> bits;
    if (first == last) return false;
    part = lowest ? first : last - 1;
    if (left_.compare_exchange_weak(left, lowest ? left + 1 : left - one_less_at_end)) return true;
  }
}

// Either a thread that goes to sleep sees the call, or the caller sees that it sleeps: both write before they
// read, and all such accesses have one total order.
void ThreadPool::open_call() {
  if (++calls_ == 0) ++calls_;
  open_call_.store(calls_);
  if (sleeping_.load() == 0) return;
  { const std::lock_guard<std::mutex> lock(mutex_); }
  called_.notify_all();
}

// A thread increments joined_ before it checks whether the call is still open. So no thread works, or will
// work, when the call is closed and joined_ is 0. If the caller spun for longer, or yielded repeatedly, the
// thread that it waits for would lack a core on a machine with other users.
void ThreadPool::close_call() {
  open_call_.store(0);
  const auto done = [&] { return joined_.load() == 0; };
  for (int checks = 0; checks < checks_ && !done(); ++checks)
    pause();
  if (done()) return;
  std::unique_lock<std::mutex> lock(mutex_);
  caller_sleeps_.store(true);
  done_.wait(lock, done);
  caller_sleeps_.store(false);
}

// Either the caller that goes to sleep sees that this thread was the last, or this thread sees that the
// caller sleeps, as in open_call().
void ThreadPool::count_out() {
  if (joined_.fetch_sub(1) != 1 || !caller_sleeps_.load()) return;
  { const std::lock_guard<std::mutex> lock(mutex_); }
  done_.notify_one();
}

void ThreadPool::serve(std::size_t thread) {
  inside_part = true;
  for (unsigned done = 0; wait_for_call(done);) {
    joined_.fetch_add(1);
    const unsigned call = open_call_.load();
    if (call != 0) {
      do_parts(thread);
      done = call;
    }
    count_out();
  }
}

// Waits until a call is open that this thread has not served; false: the pool stops.
bool ThreadPool::wait_for_call(unsigned done) {
  const auto called = [&] {
    const unsigned call = open_call_.load();
    return stopping_.load() || (call != 0 && call != done);
  };
  for (int checks = 0; checks < checks_ && !called(); ++checks)
    pause();
  if (!called()) {
    std::unique_lock<std::mutex> lock(mutex_);
    ++sleeping_;
    called_.wait(lock, called);
    --sleeping_;
  }
  return !stopping_.load();
}

void ThreadPool::do_parts(std::size_t thread) {
  do_share(thread, 0, true);
  do_share(thread, 1, true);
  for (const int loop : {1, 0})
    for (std::size_t k = 1; k < shares_.size(); ++k)
      do_share((thread + k) % shares_.size(), loop, false);
}

// Runs the parts of a thread, called by this thread or another one.
void ThreadPool::do_share(std::size_t thread, int loop, bool own) {
  const bool begins_low = thread % 2 == 0;
  for (std::size_t part = 0; shares_[thread][loop].take(begins_low == own, part);)
    do_part(loop, part);
}

void ThreadPool::do_part(int loop, std::size_t part) {
  const Loop &work = loops_[loop];
  try {
    work.call(work.body, part);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::pair<int, std::size_t> by{loop, part};
    if (!thrown_ || by < thrown_by_) thrown_ = std::current_exception(), thrown_by_ = by;
  }
}

} // namespace platen
