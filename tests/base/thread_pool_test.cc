// Threads that share out loops: every part once, whoever calls, whatever is thrown.
#include "base/thread_pool.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace platen::thread_pool_test {
namespace {

template <class Part>
void run(ThreadPool &pool, int threads, std::size_t parts, const Part &part) {
  pool.run(loop_of(parts, part), {}, threads);
}

// Counts who is here and waits for so many, for at most twenty seconds.
void meet(std::atomic<int> &here, int wanted, bool comes = true) {
  if (comes) ++here;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (here < wanted && std::chrono::steady_clock::now() < patience)
    std::this_thread::yield();
}

TEST(thread_pool, does_every_part_once_on_any_number_of_threads) {
  ThreadPool pool;
  for (const int threads : {1, 2, 3, 8, 2})
    for (const std::size_t parts : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<int> done(parts, 0); // no thread shares a part
      for (int loop = 0; loop < 20; ++loop)
        run(pool, threads, parts, [&](std::size_t p) { ++done[p]; });
      for (std::size_t p = 0; p < parts; ++p)
        ASSERT_EQ(done[p], 20) << threads << " threads, part " << p << " of " << parts;
    }
}

// Loops so short that threads come late to most of them; what one writes the next reads.
TEST(thread_pool, loops_follow_each_other_without_mixing) {
  ThreadPool pool;
  for (const int threads : {2, 4}) {
    std::vector<long> row(13, 0), other(5, 0);
    long loop = 0;
    const auto count_up = [&](long &r) { r = r == loop ? loop + 1 : -1; };
    const auto first = [&](std::size_t p) { count_up(row[p]); };
    const auto second = [&](std::size_t p) { count_up(other[p]); };
    for (; loop < 20000; ++loop)
      pool.run(loop_of(row.size(), first), loop_of(other.size(), second), threads);
    EXPECT_EQ(row, std::vector<long>(13, 20000)) << threads;
    EXPECT_EQ(other, std::vector<long>(5, 20000)) << threads;
  }
}

TEST(thread_pool, does_every_part_of_two_loops_once) {
  ThreadPool pool;
  for (const int threads : {1, 2, 3, 8, 2})
    for (const std::size_t parts : {0u, 1u, 2u, 5u, 1000u})
      for (const std::size_t others : {0u, 1u, 2u, 40u}) {
        std::vector<int> done(parts, 0), more(others, 0);
        const auto first = [&](std::size_t p) { ++done[p]; };
        const auto second = [&](std::size_t p) { more[p] += 2; };
        for (int loop = 0; loop < 20; ++loop)
          pool.run(loop_of(parts, first), loop_of(others, second), threads);
        ASSERT_EQ(done, std::vector<int>(parts, 20)) << threads << ", " << parts << " and " << others;
        ASSERT_EQ(more, std::vector<int>(others, 40)) << threads << ", " << parts << " and " << others;
      }
}

// The caller takes parts up from the first, the other thread down from the last, whichever is quicker: what
// the slower one leaves is next to what the quicker one has.
TEST(thread_pool, two_threads_meet_in_the_middle_of_both_loops) {
  const std::thread::id caller = std::this_thread::get_id();
  for (const bool caller_is_slow : {false, true}) {
    ThreadPool pool;
    std::vector<char> by_caller(40, 0), other_by_caller(30, 0);
    std::atomic<int> here{0};
    const auto take = [&](std::vector<char> &by, std::size_t p) {
      const bool is_caller = std::this_thread::get_id() == caller;
      by[p] = is_caller;
      meet(here, 2, p == 0 || p + 1 == by_caller.size()); // neither goes on before both have a part
      std::this_thread::sleep_for(std::chrono::microseconds(is_caller == caller_is_slow ? 2000 : 200));
    };
    const auto first = [&](std::size_t p) { take(by_caller, p); };
    const auto second = [&](std::size_t p) { take(other_by_caller, p); };
    pool.run(loop_of(by_caller.size(), first), loop_of(other_by_caller.size(), second), 2);
    ASSERT_GE(here, 2);
    for (const std::vector<char> *by : {&by_caller, &other_by_caller}) {
      const auto split = std::count(by->begin(), by->end(), 1);
      for (std::size_t p = 0; p < by->size(); ++p)
        EXPECT_EQ((*by)[p] != 0, static_cast<std::ptrdiff_t>(p) < split)
            << "part " << p << " of " << by->size() << ", " << split << " by the caller";
    }
    const auto of_first = std::count(by_caller.begin(), by_caller.end(), 1);
    if (caller_is_slow)
      EXPECT_LT(of_first, 20) << "what the slower one had left is taken over";
    else
      EXPECT_GT(of_first, 20) << "what the slower one had left is taken over";
  }
}

TEST(thread_pool, more_parts_than_can_be_counted_are_refused) {
  ThreadPool pool;
  const auto never = [](std::size_t) { throw std::logic_error("a part was made"); };
  const std::size_t most = std::size_t{1} << 32;
  EXPECT_THROW(pool.run(loop_of(most, never), {}, 2), std::length_error);
  EXPECT_THROW(pool.run({}, loop_of(most, never), 2), std::length_error);
}

TEST(thread_pool, threads_work_at_the_same_time) {
  ThreadPool pool;
  std::atomic<int> here{0}, met{0};
  run(pool, 2, 2, [&](std::size_t) {
    meet(here, 2);
    if (here == 2) ++met;
  });
  EXPECT_EQ(met, 2);
}

TEST(thread_pool, wakes_after_a_sleep) {
  ThreadPool pool;
  std::atomic<int> here{0};
  for (int loop = 1; loop <= 3; ++loop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    run(pool, 2, 2, [&](std::size_t) { meet(here, 2 * loop); });
    ASSERT_EQ(here, 2 * loop);
  }
}

// A trial of minutes on one thread must not keep another from a core that it only waits on.
TEST(thread_pool, a_caller_sleeps_while_others_work_on) {
  const auto processor_seconds = [] {
    timespec used{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
  };
  ThreadPool pool;
  std::atomic<bool> begun{false};
  const auto caller = std::this_thread::get_id();
  const double before = processor_seconds();
  run(pool, 2, 2, [&](std::size_t) {
    if (std::this_thread::get_id() != caller) {
      begun = true;
      return std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
    while (!begun)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  EXPECT_LT(processor_seconds() - before, 0.25);
}

TEST(thread_pool, a_loop_inside_a_loop_runs_on_its_caller) {
  ThreadPool pool;
  std::vector<int> strangers(8, -1);
  run(pool, 4, strangers.size(), [&](std::size_t outer) {
    const auto self = std::this_thread::get_id();
    int count = 0, other = 0;
    run(pool, 4, 10, [&](std::size_t) { ++count, other += std::this_thread::get_id() != self; });
    strangers[outer] = other + (10 - count);
  });
  for (const int s : strangers)
    EXPECT_EQ(s, 0);
}

TEST(thread_pool, two_callers_at_once_are_both_served) {
  ThreadPool pool;
  std::vector<long> one(50, 0), other(50, 0);
  const auto call = [&pool](std::vector<long> &row) {
    for (int loop = 0; loop < 2000; ++loop)
      run(pool, 3, row.size(), [&](std::size_t p) { ++row[p]; });
  };
  std::thread second([&] { call(other); });
  call(one);
  second.join();
  EXPECT_EQ(one, std::vector<long>(50, 2000));
  EXPECT_EQ(other, one);
}

TEST(thread_pool, the_lowest_part_that_throws_reaches_the_caller) {
  ThreadPool pool;
  for (const int threads : {1, 2, 4})
    for (int loop = 0; loop < 50; ++loop) {
      std::string what;
      try {
        run(pool, threads, 64, [&](std::size_t p) {
          if (p == 5 || p == 6 || p == 60) throw std::runtime_error(std::to_string(p));
        });
      } catch (const std::runtime_error &e) {
        what = e.what();
      }
      ASSERT_EQ(what, "5") << threads;
      std::atomic<int> after{0};
      run(pool, threads, 64, [&](std::size_t) { ++after; });
      ASSERT_EQ(after, 64) << threads;
    }
}

TEST(thread_pool, at_once_does_each_piece_once) {
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    std::vector<int> one(3000, 0), other(3000, 0);
    for (int k = 0; k < 100; ++k)
      at_once(2, [&](std::size_t piece) {
        if (piece == 0)
          for_each(one.size(), [&](std::size_t i) { ++one[i]; });
        else
          for_each(other.size(), [&](std::size_t i) { other[i] += 2; });
      });
    EXPECT_EQ(one, std::vector<int>(3000, 100));
    EXPECT_EQ(other, std::vector<int>(3000, 200));
  }
}

// As `taskset` and batch systems limit it.
TEST(hardware_threads, are_those_that_the_process_may_run_on) {
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  EXPECT_EQ(hardware_threads(), CPU_COUNT(&before));
  CPU_ZERO(&one);
  for (int core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
    if (CPU_ISSET(core, &before)) CPU_SET(core, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  EXPECT_EQ(hardware_threads(), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}

} // namespace
} // namespace platen::thread_pool_test
