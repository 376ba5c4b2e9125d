#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <set>

#include "apps/output/checkpoint_folder.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class CheckpointFolder : public ScratchFolder {
protected:
  fs::path checkpoints_ = folder_ / "checkpoint";
  fs::path write(std::uint64_t step) const {
    return write_checkpoint(checkpoints_, step, [&](StateSink &writer) {
      add_rows(writer, "step", std::vector<std::uint64_t>{step});
      add_rows(writer, "field", std::vector<double>(20000, static_cast<double>(step)));
    });
  }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto &file : fs::directory_iterator(checkpoints_))
      names.insert(file.path().filename().string());
    return names;
  }
  static void damage(const fs::path &path) { fs::resize_file(path, fs::file_size(path) / 2); }
};

TEST_F(CheckpointFolder, keeps_the_two_newest) {
  for (const std::uint64_t step : {10, 20, 30, 40})
    write(step);
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000030.platen", "step_000000000040.platen"}));
  const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
  EXPECT_EQ(found.step, 40u);
  EXPECT_TRUE(found.remarks.empty());
  EXPECT_EQ(rows_of<std::uint64_t>(CheckpointReader(found.path), "step").front(), 40u);
}

TEST_F(CheckpointFolder, falls_back_on_the_older_one_and_says_so) {
  write(10);
  const fs::path newest = write(20);
  damage(newest);
  const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
  EXPECT_EQ(found.step, 10u);
  ASSERT_EQ(found.remarks.size(), 1u);
  EXPECT_TRUE(contains(found.remarks[0], newest.string())) << found.remarks[0];
}

TEST_F(CheckpointFolder, drops_a_damaged_later_one_when_the_run_has_gone_on) {
  write(10);
  damage(write(20));
  write(15); // the run went on from step 10
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000010.platen", "step_000000000015.platen"}));
  EXPECT_EQ(newest_whole_checkpoint(checkpoints_).step, 15u);
}

TEST_F(CheckpointFolder, names_all_that_is_wrong_where_none_is_whole) {
  EXPECT_TRUE(
      contains(message_of<CheckpointError>([&] { newest_whole_checkpoint(checkpoints_); }), "no checkpoint"));
  const fs::path first = write(10), second = write(20);
  damage(first);
  damage(second);
  const std::string text = message_of<CheckpointError>([&] { newest_whole_checkpoint(checkpoints_); });
  EXPECT_TRUE(contains(text, first.string()) && contains(text, second.string())) << text;
}

TEST_F(CheckpointFolder, drops_what_a_killed_run_left_half_written) {
  put(checkpoints_ / "step_000000000099.part.platen", "half");
  write(10);
  EXPECT_EQ(names(), std::set<std::string>{"step_000000000010.platen"});
}

TEST_F(CheckpointFolder, leaves_files_of_the_user_alone) {
  put(checkpoints_ / "notes.txt", "mine");
  put(checkpoints_ / "step_1.platen.bak", "mine");
  for (const std::uint64_t step : {10, 20, 30})
    write(step);
  EXPECT_EQ(content_of(checkpoints_ / "notes.txt"), "mine");
  EXPECT_EQ(content_of(checkpoints_ / "step_1.platen.bak"), "mine");
}

TEST_F(CheckpointFolder, on_a_full_disk_keeps_the_former_ones) {
  write(10);
  write(20);
  // The next one is written through a name that leads to a device without room.
  const fs::path next = checkpoints_ / "step_000000000030.platen";
  fs::create_symlink("/dev/full", part_path(next));
  EXPECT_TRUE(contains(message_of<OutputError>([&] { write(30); }), "No space left"));
  EXPECT_EQ(names(), (std::set<std::string>{"step_000000000010.platen", "step_000000000020.platen"}));
  EXPECT_EQ(newest_whole_checkpoint(checkpoints_).step, 20u);
}

TEST_F(CheckpointFolder, always_holds_a_whole_one_however_the_run_is_killed) {
  using clock = std::chrono::steady_clock;
  const auto start = clock::now();
  for (std::uint64_t k = 1; k <= 5; ++k)
    write(k);
  const double write_seconds = std::chrono::duration<double>(clock::now() - start).count() / 5;
  std::uint64_t step = 5;
  for (int kill_number = 0; kill_number < 200; ++kill_number) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      for (std::uint64_t k = step + 1;; ++k)
        write(k);
    }
    // From the start to the fourth write: every phase of one.
    usleep(static_cast<useconds_t>(4e6 * write_seconds * (kill_number % 50) / 50));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const FoundCheckpoint found = newest_whole_checkpoint(checkpoints_);
    ASSERT_GE(found.step, step);
    EXPECT_TRUE(found.remarks.empty()) << found.remarks[0]; // none is half written under its name
    step = found.step;
    const std::vector<double> field = rows_of<double>(CheckpointReader(found.path), "field");
    EXPECT_EQ(field, std::vector<double>(20000, static_cast<double>(step)));
  }
  EXPECT_GT(step, 20u) << "the runs were killed before they wrote anything";
  write(step + 1);
  EXPECT_EQ(names().size(), 2u); // what the killed ones left half written is gone
}

} // namespace
} // namespace platen::apps
