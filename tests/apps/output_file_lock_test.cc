#include "apps/output/file_lock.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/output/errors.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;
using std::chrono::milliseconds;

class BytesHeld : public ScratchFolder {
protected:
  BytesHeld() { put(file_, "run\n"); }
  std::unique_ptr<FileLock> take(std::uint64_t first, std::uint64_t count = 1) const {
    return FileLock::take(file_, {first, count}, milliseconds(0), [] {});
  }
  // A process that holds bytes until it is killed; with `starts`, what it has started does.
  pid_t holder(std::uint64_t byte, pid_t *starts = nullptr) const {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
      const auto lock = take(byte);
      const pid_t started = starts != nullptr ? fork() : 1;
      if (started == 0) {
        execl("/bin/sleep", "sleep", "60", nullptr);
        _exit(1);
      }
      if (lock != nullptr && write(ready[1], &started, sizeof(started)) == sizeof(started)) pause();
      _exit(1);
    }
    pid_t started = 0;
    EXPECT_EQ(read(ready[0], &started, sizeof(started)), static_cast<ssize_t>(sizeof(started)));
    if (starts != nullptr) *starts = started;
    close(ready[0]);
    close(ready[1]);
    return child;
  }
  static void end(pid_t process) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
  const fs::path file_ = folder_ / "plan.csv";
};

TEST_F(BytesHeld, are_refused_to_another_process_and_no_others_are) {
  const pid_t other = holder(7);
  int told = 0;
  EXPECT_EQ(FileLock::take(file_, {7, 1}, milliseconds(50), [&] { ++told; }), nullptr);
  EXPECT_EQ(told, 1);
  for (const std::uint64_t byte : {6, 8}) {
    const auto lock = take(byte);
    ASSERT_NE(lock, nullptr) << byte;
    EXPECT_TRUE(lock->holds());
  }
  EXPECT_EQ(take(0, 0), nullptr);
  EXPECT_NE(take(8, 0), nullptr);
  EXPECT_TRUE(FileLock::is_taken(file_, 7));
  EXPECT_FALSE(FileLock::is_taken(file_, 6));
  end(other);
  EXPECT_FALSE(FileLock::is_taken(file_, 7));
  EXPECT_EQ(content_of(file_), "run\n");
}

TEST_F(BytesHeld, come_after_a_wait) {
  const pid_t other = holder(3);
  const auto lock = FileLock::take(file_, {3, 1}, milliseconds(60000), [&] { end(other); });
  ASSERT_NE(lock, nullptr);
  EXPECT_TRUE(FileLock::is_taken(file_, 3)); // ours
}

// A run that was started goes on for a moment after its study is killed.
TEST_F(BytesHeld, stay_held_by_what_their_holder_has_started) {
  pid_t started = -1;
  end(holder(5, &started));
  EXPECT_EQ(take(5), nullptr);
  kill(started, SIGKILL); // not a child of ours: its end is seen by the lock
  EXPECT_NE(FileLock::take(file_, {5, 1}, milliseconds(60000), [] {}), nullptr);
}

TEST_F(BytesHeld, of_no_file_are_those_of_a_new_one_and_of_a_link_an_error) {
  EXPECT_FALSE(FileLock::is_taken(folder_ / "none", 1));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  EXPECT_TRUE(FileLock::take(folder_ / "none", {1, 1}, milliseconds(0), [] {})->holds());
  EXPECT_EQ(content_of(folder_ / "none"), "");
  fs::create_symlink(file_, folder_ / "link");
  for (const char *name : {"link", "no folder/file"})
    EXPECT_THROW(FileLock::take(folder_ / name, whole_file, milliseconds(0), [] {}), FolderError) << name;
}

} // namespace
} // namespace platen::apps
