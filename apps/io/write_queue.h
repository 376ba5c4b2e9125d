// Files that are written beside the computation, in the order in which they were told, by one thread.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace platen::apps {

class WriteQueue {
public:
  using Work = std::function<void()>;

  // So many works may wait while one is done. 0: there is no thread, add() does the work itself.
  explicit WriteQueue(std::size_t most_waiting);
  // Does first what waits. What fails then is lost: call finish() where it matters.
  ~WriteQueue();
  WriteQueue(const WriteQueue &) = delete;
  WriteQueue &operator=(const WriteQueue &) = delete;

  // Returns once there is room. Throws what an earlier work threw; nothing that follows a failure is done.
  void add(Work work);
  // Returns once all is done. Throws what one of them threw.
  void finish();

private:
  void serve();
  void throw_failure(); // the lock is held

  const std::size_t most_waiting_;
  std::mutex mutex_; // of all below
  std::condition_variable changed_;
  std::deque<Work> waiting_;
  bool busy_ = false, ending_ = false, failed_ = false;
  std::exception_ptr failure_; // not thrown yet
  std::thread thread_;
};

} // namespace platen::apps
