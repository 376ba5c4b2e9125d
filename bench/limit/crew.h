// Persistent threads that walk through one piece of work together and wait for each other at a spinning
// barrier: what a loop of some hundred microseconds between two barriers needs, so that waking threads is not
// what is measured.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace platen::bench {

class Crew {
public:
  explicit Crew(int threads);
  ~Crew();
  Crew(const Crew &) = delete;
  Crew &operator=(const Crew &) = delete;

  int size() const { return size_; }
  // work(k) on every thread k; the caller is thread 0. Returns when all are done. Between two calls the other
  // threads sleep, so that they take no time from what else the program measures.
  void run(const std::function<void(int)> &work);
  // Inside work: waits until all threads are here.
  void meet();

private:
  void serve(int thread);

  int size_;
  std::vector<std::thread> threads_;
  std::mutex mutex_;
  std::condition_variable called_;
  const std::function<void(int)> *work_ = nullptr; // null: the threads go home
  long calls_ = 0;
  alignas(64) std::atomic<int> arrived_{0};
  alignas(64) std::atomic<unsigned> round_{0};
};

} // namespace platen::bench
