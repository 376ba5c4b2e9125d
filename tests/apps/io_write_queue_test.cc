// Files written beside the computation: in order, not too many at once, no failure lost.
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <thread>
#include <vector>

#include "apps/io/write_queue.h"

namespace platen::apps {
namespace {

TEST(io_write_queue, works_are_done_in_their_order_by_another_thread) {
  std::vector<int> done;
  std::thread::id by;
  WriteQueue queue(3);
  for (int k = 0; k < 100; ++k)
    queue.add([&, k] { done.push_back(k), by = std::this_thread::get_id(); });
  queue.finish();
  ASSERT_EQ(done.size(), 100u);
  for (int k = 0; k < 100; ++k)
    EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
  EXPECT_NE(by, std::this_thread::get_id());
}

TEST(io_write_queue, without_room_to_wait_the_caller_does_the_work) {
  std::thread::id by;
  WriteQueue queue(0);
  queue.add([&] { by = std::this_thread::get_id(); });
  EXPECT_EQ(by, std::this_thread::get_id());
  EXPECT_THROW(queue.add([] { throw std::runtime_error("full"); }), std::runtime_error);
  queue.finish();
}

TEST(io_write_queue, one_is_done_and_so_many_wait_and_no_more) {
  std::promise<void> gate;
  const std::shared_future<void> open = gate.get_future().share();
  std::atomic<int> added{0};
  WriteQueue queue(2);
  std::thread caller([&] {
    for (int k = 0; k < 4; ++k) {
      queue.add([open] { open.wait(); });
      ++added;
    }
  });
  while (added < 3) // one at work, two that wait
    std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(added, 3) << "a fourth found room";
  gate.set_value();
  caller.join();
  EXPECT_EQ(added, 4);
  queue.finish();
}

TEST(io_write_queue, a_failure_reaches_the_caller_and_nothing_follows_it) {
  bool followed = false;
  {
    WriteQueue queue(4);
    queue.add([] { throw std::runtime_error("the disk is full"); });
    try {
      queue.finish();
      ADD_FAILURE() << "a failure was lost";
    } catch (const std::runtime_error &e) {
      EXPECT_STREQ(e.what(), "the disk is full");
    }
    queue.add([&] { followed = true; });
    queue.finish(); // told once
  }
  EXPECT_FALSE(followed);
}

TEST(io_write_queue, the_next_call_tells_of_a_failure_even_where_there_is_no_room) {
  std::promise<void> gate;
  WriteQueue queue(1);
  queue.add([open = gate.get_future().share()] {
    open.wait();
    throw std::runtime_error("the disk is full");
  });
  std::thread opens([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    gate.set_value();
  });
  EXPECT_THROW(
      {
        for (int k = 0; k < 3; ++k)
          queue.add([] {});
        queue.finish();
      },
      std::runtime_error);
  opens.join();
}

TEST(io_write_queue, what_waits_is_done_when_the_queue_goes) {
  int done = 0;
  {
    WriteQueue queue(8);
    for (int k = 0; k < 5; ++k)
      queue.add([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ++done;
      });
  }
  EXPECT_EQ(done, 5);
}

} // namespace
} // namespace platen::apps
