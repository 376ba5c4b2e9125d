#include "dem/crew.h"

#include <algorithm>

namespace platen::dem {

namespace {

// Some hundred microseconds: longer than what a step does between two loops, short beside what is done
// between steps.
constexpr int looks_before_sleep = 4000;

thread_local bool at_work = false;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

} // namespace

Crew::~Crew() {
  resize(1);
}

void Crew::run(const Loop &one, const Loop &other, int threads) {
  if (one.parts + other.parts < 2 || threads < 2 || at_work || !in_use_.try_lock()) {
    for (const Loop *loop : {&one, &other})
      for (std::size_t part = 0; part < loop->parts; ++part)
        loop->call(loop->body, part);
    return;
  }
  const std::lock_guard<std::mutex> until_done(in_use_, std::adopt_lock);
  if (shares_.size() != static_cast<std::size_t>(threads)) resize(threads);
  loops_ = {one, other};
  hand_out();
  thrown_ = nullptr;
  begin_call();
  at_work = true;
  take_parts(0);
  at_work = false;
  end_call();
  if (thrown_) std::rethrow_exception(thrown_);
}

// With more threads than cores, to look is to keep others from their work.
void Crew::resize(int threads) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    leave_ = true;
  }
  called_.notify_all();
  for (std::thread &thread : threads_)
    thread.join();
  threads_.clear();
  leave_ = false;
  const std::size_t size = static_cast<std::size_t>(threads);
  looks_ = size <= std::thread::hardware_concurrency() ? looks_before_sleep : 0;
  shares_ = std::vector<Shares>(size);
  for (std::size_t k = 1; k < size; ++k)
    threads_.emplace_back([this, k] { serve(k); });
}

void Crew::hand_out() {
  const std::size_t size = shares_.size();
  for (std::size_t loop = 0; loop < loops_.size(); ++loop)
    for (std::size_t k = 0; k < size; ++k) {
      Share &share = shares_[k][loop];
      share.next.store(k * loops_[loop].parts / size, std::memory_order_relaxed);
      share.end = (k + 1) * loops_[loop].parts / size;
    }
}

// Either a thread that goes to sleep sees the call, or the caller sees that it sleeps: both write before they
// read, in the one order of all such accesses.
void Crew::begin_call() {
  if (++calls_ == 0) ++calls_;
  open_.store(calls_);
  if (sleepers_.load() == 0) return;
  { const std::lock_guard<std::mutex> lock(mutex_); }
  called_.notify_all();
}

// A thread counts itself in before it looks whether the call is still open, so that none is at work, or will
// be, once it is closed and all have counted themselves out.
void Crew::end_call() {
  open_.store(0);
  for (int looks = 0; joined_.load() != 0; ++looks)
    if (looks < looks_)
      pause();
    else
      std::this_thread::yield();
}

void Crew::serve(std::size_t thread) {
  at_work = true;
  for (unsigned done = 0; await_call(done);) {
    joined_.fetch_add(1);
    const unsigned call = open_.load();
    if (call != 0) {
      take_parts(thread);
      done = call;
    }
    joined_.fetch_sub(1);
  }
}

// Until a call is open that was not served yet; false: no more will come.
bool Crew::await_call(unsigned done) {
  const auto news = [&] {
    const unsigned call = open_.load();
    return leave_.load() || (call != 0 && call != done);
  };
  for (int looks = 0; looks < looks_ && !news(); ++looks)
    pause();
  if (!news()) {
    std::unique_lock<std::mutex> lock(mutex_);
    ++sleepers_;
    called_.wait(lock, news);
    --sleepers_;
  }
  return !leave_.load();
}

void Crew::take_parts(std::size_t thread) {
  empty(shares_[thread][0], 0);
  empty(shares_[thread][1], 1);
  for (const int loop : {1, 0})
    for (std::size_t k = 1; k < shares_.size(); ++k)
      empty(shares_[(thread + k) % shares_.size()][static_cast<std::size_t>(loop)], loop);
}

void Crew::empty(Share &share, int loop) {
  for (std::size_t part = share.next++; part < share.end; part = share.next++)
    do_part(loop, part);
}

void Crew::do_part(int loop, std::size_t part) {
  const Loop &work = loops_[static_cast<std::size_t>(loop)];
  try {
    work.call(work.body, part);
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::pair<int, std::size_t> by{loop, part};
    if (!thrown_ || by < thrown_by_) thrown_ = std::current_exception(), thrown_by_ = by;
  }
}

} // namespace platen::dem
