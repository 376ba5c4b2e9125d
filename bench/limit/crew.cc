#include "limit/crew.h"

namespace platen::bench {

namespace {

// Looks at the barrier before a thread gives its core away: some tens of microseconds, longer than threads
// with equal shares wait for each other, short where there are more threads than cores.
constexpr int looks_before_yield = 2000;

inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

} // namespace

Crew::Crew(int threads) : size_(threads) {
  for (int k = 1; k < threads; ++k)
    threads_.emplace_back([this, k] { serve(k); });
}

Crew::~Crew() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_ = nullptr;
    ++calls_;
  }
  called_.notify_all();
  for (std::thread &thread : threads_)
    thread.join();
}

void Crew::run(const std::function<void(int)> &work) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    work_ = &work;
    ++calls_;
  }
  called_.notify_all();
  work(0);
  meet();
}

void Crew::serve(int thread) {
  for (long call = 1;; ++call) {
    const std::function<void(int)> *work = nullptr;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      called_.wait(lock, [&] { return calls_ >= call; });
      work = work_;
    }
    if (!work) return;
    (*work)(thread);
    meet();
  }
}

void Crew::meet() {
  const unsigned round = round_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    round_.store(round + 1, std::memory_order_release);
    return;
  }
  for (int looks = 0; round_.load(std::memory_order_acquire) == round; ++looks)
    if (looks < looks_before_yield)
      pause();
    else
      std::this_thread::yield();
}

} // namespace platen::bench
