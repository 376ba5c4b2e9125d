#include "apps/io/write_queue.h"

#include <utility>

namespace platen::apps {

WriteQueue::WriteQueue(std::size_t most_waiting) : most_waiting_(most_waiting) {
  if (most_waiting_ > 0) thread_ = std::thread([this] { serve(); });
}

WriteQueue::~WriteQueue() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void WriteQueue::add(Work work) {
  if (most_waiting_ == 0) return work();
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < most_waiting_ || failed_; });
  throw_failure();
  waiting_.push_back(std::move(work));
  changed_.notify_all();
}

void WriteQueue::finish() {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return (waiting_.empty() && !busy_) || failed_; });
  throw_failure();
}

void WriteQueue::throw_failure() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void WriteQueue::serve() {
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return !waiting_.empty() || ending_; });
    if (waiting_.empty()) return;
    const Work work = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all(); // there is room
    if (failed_) continue;
    busy_ = true;
    lock.unlock();
    std::exception_ptr thrown;
    try {
      work();
    } catch (...) {
      thrown = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (thrown) failed_ = true, failure_ = thrown;
    changed_.notify_all();
  }
}

} // namespace platen::apps
