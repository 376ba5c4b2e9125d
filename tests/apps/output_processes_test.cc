// Bytes of files that a process holds, folders by them, and signals.
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <sstream>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/file_lock.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/output/stop_signal.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

using std::chrono::milliseconds;

class Holding : public ScratchFolder {
protected:
  // A process that holds what `take` gives until it is killed; with `starts`, what it has started does.
  template <class Take>
  static pid_t holder(const Take &take, pid_t *starts = nullptr) {
    int ready[2];
    if (pipe(ready) != 0) return -1;
    const pid_t child = fork();
    if (child == 0) {
      const auto lock = take();
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
};

class BytesHeld : public Holding {
protected:
  BytesHeld() { put(file_, "run\n"); }
  std::unique_ptr<FileLock> take(std::uint64_t first, std::uint64_t count = 1) const {
    return FileLock::take(file_, {first, count}, milliseconds(0), [] {});
  }
  pid_t holder_of(std::uint64_t byte, pid_t *starts = nullptr) const {
    return holder([&] { return take(byte); }, starts);
  }
  const fs::path file_ = folder_ / "plan.csv";
};

TEST_F(BytesHeld, are_refused_to_another_process_and_no_others_are) {
  const pid_t other = holder_of(7);
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
  const pid_t other = holder_of(3);
  const auto lock = FileLock::take(file_, {3, 1}, milliseconds(60000), [&] { end(other); });
  ASSERT_NE(lock, nullptr);
  EXPECT_TRUE(FileLock::is_taken(file_, 3)); // ours
}

// A run that was started goes on for a moment after its study is killed.
TEST_F(BytesHeld, stay_held_by_what_their_holder_has_started) {
  pid_t started = -1;
  end(holder_of(5, &started));
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

class Lock : public Holding {
protected:
  std::unique_ptr<FileLock> take(milliseconds patience) { return lock_folder(folder_, patience, log_); }
  pid_t holder_of_folder() {
    return holder([&] { return take(milliseconds(0)); });
  }
  std::ostringstream output_, errors_;
  RunLog log_{Loudness::normal, output_, errors_};
};

TEST_F(Lock, is_given_to_one_process_and_named_to_the_other) {
  const pid_t other = holder_of_folder();
  const std::string text = message_of<FolderError>([&] { take(milliseconds(50)); });
  EXPECT_TRUE(contains(text, "another run is at work in it"));
  EXPECT_TRUE(contains(text, folder_.string()));
  EXPECT_EQ(output_.str(), "waits for a run at work in " + folder_.string() + "\n"); // once
  end(other);
}

TEST_F(Lock, is_free_again_however_its_process_ends) {
  end(holder_of_folder());
  take(milliseconds(0));
  take(milliseconds(0));
  EXPECT_EQ(output_.str(), "");
  EXPECT_EQ(content_of(folder_ / "run.log"), ""); // all that it leaves, and no earlier run
  EXPECT_NO_THROW(check_output_folder(folder_, FolderUse::fresh));
}

TEST_F(Lock, comes_after_a_wait) {
  const pid_t other = holder_of_folder();
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

// Exit status of a process that runs body(), which returns it; -1 where a signal ended it.
template <class Body>
int status_of(const Body &body) {
  const pid_t child = fork();
  if (child == 0) _exit(body());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StopSignal, asks_the_run_to_stop_and_gives_its_exit_status) {
  for (const int number : {SIGINT, SIGTERM}) {
    const int status = status_of([number] {
      catch_stop_signals();
      if (stop_requested() != 0) return 1;
      raise(number);
      if (stop_requested() != number) return 2;
      return exit_status_of_signal(stop_requested());
    });
    EXPECT_EQ(status, number == SIGINT ? 130 : 143);
  }
}

TEST(StopSignal, a_request_for_a_checkpoint_that_was_held_back_is_not_lost) {
  EXPECT_EQ(status_of([] {
              sigset_t held;
              sigemptyset(&held);
              sigaddset(&held, SIGUSR1);
              sigprocmask(SIG_BLOCK, &held, nullptr);
              raise(SIGUSR1);
              catch_stop_signals();
              return take_checkpoint_request() && !take_checkpoint_request() ? 7 : 1;
            }),
            7);
}

TEST(StopSignal, given_twice_ends_the_process_at_once) {
  EXPECT_EQ(status_of([] {
              catch_stop_signals();
              raise(SIGINT);
              raise(SIGTERM);
              return 1; // not reached
            }),
            143);
}

// A terminal that closes sends its hang-up more than once: the kernel does, and the shell.
TEST(StopSignal, a_hang_up_asks_too_and_never_ends_the_process) {
  EXPECT_EQ(status_of([] {
              signal(SIGHUP, SIG_DFL); // whatever started the tests may have it ignored
              catch_stop_signals();
              raise(SIGHUP);
              raise(SIGHUP);
              if (stop_requested() != SIGHUP) return 1;
              raise(SIGTERM);
              if (stop_requested() != SIGTERM) return 2;
              raise(SIGHUP);
              return stop_requested();
            }),
            SIGTERM);
}

TEST(StopSignal, a_hang_up_that_is_ignored_stays_so) {
  EXPECT_EQ(status_of([] {
              signal(SIGHUP, SIG_IGN); // as nohup does
              catch_stop_signals();
              raise(SIGHUP);
              return stop_requested();
            }),
            0);
}

TEST(StopSignal, a_reader_that_has_left_is_a_failed_write_and_not_the_end) {
  EXPECT_EQ(status_of([] {
              signal(SIGPIPE, SIG_DFL);
              catch_stop_signals();
              int ends[2];
              if (pipe(ends) != 0) return 1;
              close(ends[0]);
              return write(ends[1], "text", 4) < 0 ? 0 : 2;
            }),
            0);
}

TEST(StopSignal, user_1_asks_for_one_checkpoint_and_lets_the_run_go_on) {
  EXPECT_EQ(status_of([] {
              catch_stop_signals();
              if (take_checkpoint_request()) return 1;
              raise(SIGUSR1);
              raise(SIGUSR1);
              if (!take_checkpoint_request()) return 2;
              if (take_checkpoint_request()) return 3;
              return stop_requested() == 0 ? 0 : 4;
            }),
            0);
}

class FileLimit : public testing::ScratchFolder {};

TEST_F(FileLimit, is_a_failed_write_and_not_the_end_of_the_process) {
  const auto name = folder_ / "limited";
  EXPECT_EQ(status_of([name] {
              signal(SIGXFSZ, SIG_DFL);
              catch_stop_signals();
              const rlimit none{0, RLIM_INFINITY};
              setrlimit(RLIMIT_FSIZE, &none);
              OutputFile file(name);
              try {
                file.write("text");
              } catch (const OutputError &) {
                return 0;
              }
              return 1;
            }),
            0);
}

} // namespace
} // namespace platen::apps
