#include "apps/output/output_folder.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "apps/output/errors.h"
#include "apps/output/run_log.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;
using std::chrono::milliseconds;

class Lock : public ScratchFolder {
protected:
  std::unique_ptr<FileLock> take(milliseconds patience) { return lock_folder(folder_, patience, log_); }
  // A process that holds the folder until it is killed.
  pid_t holder() {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
      const auto lock = take(milliseconds(0));
      if (write(ready[1], "1", 1) == 1) pause();
      _exit(1);
    }
    char one = 0;
    EXPECT_EQ(read(ready[0], &one, 1), 1);
    close(ready[0]);
    close(ready[1]);
    return child;
  }
  static void end(pid_t process) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
  std::ostringstream output_, errors_;
  RunLog log_{Loudness::normal, output_, errors_};
};

TEST_F(Lock, is_given_to_one_process_and_named_to_the_other) {
  const pid_t other = holder();
  const std::string text = message_of<FolderError>([&] { take(milliseconds(50)); });
  EXPECT_TRUE(contains(text, "another run is at work in it")) << text;
  EXPECT_TRUE(contains(text, folder_.string())) << text;
  EXPECT_EQ(output_.str(), "waits for a run at work in " + folder_.string() + "\n"); // once
  end(other);
}

TEST_F(Lock, is_free_again_however_its_process_ends) {
  end(holder());
  take(milliseconds(0));
  take(milliseconds(0));
  EXPECT_EQ(output_.str(), "");
  EXPECT_EQ(content_of(folder_ / "run.log"), ""); // all that it leaves, and no earlier run
  EXPECT_NO_THROW(check_output_folder(folder_, FolderUse::fresh));
}

TEST_F(Lock, comes_after_a_wait) {
  const pid_t other = holder();
  log_.before_printing([&] { end(other); });
  const auto lock = take(milliseconds(60000));
  log_.before_printing({});
  EXPECT_THROW(take(milliseconds(0)), FolderError); // ours, by another descriptor
}

// The next run must not get in while the first one empties the folder for its own.
TEST_F(Lock, stays_with_a_run_that_overwrites_the_folder) {
  put(folder_ / "run.log", "of an earlier run");
  put(folder_ / "history.csv", "of an earlier run");
  std::unique_ptr<FileLock> lock;
  open_locked(lock, folder_, FolderUse::overwrite, {}, log_);
  ASSERT_NE(lock, nullptr);
  EXPECT_FALSE(fs::exists(folder_ / "history.csv"));
  log_.open(folder_ / "run.log", false, {});
  EXPECT_THROW(take(milliseconds(0)), FolderError);
}

// Runs of a plan hold a byte each.
TEST_F(Lock, is_not_given_while_another_holds_a_byte_of_it) {
  const auto byte = FileLock::take(folder_ / "run.log", {3, 1}, milliseconds(0), [] {});
  EXPECT_NE(FileLock::take(folder_ / "run.log", {4, 1}, milliseconds(0), [] {}), nullptr);
  EXPECT_THROW(take(milliseconds(0)), FolderError);
}

TEST_F(Lock, of_no_folder_is_an_error) {
  EXPECT_THROW(lock_folder(folder_ / "none", milliseconds(0), log_), FolderError);
}

} // namespace
} // namespace platen::apps
