#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "apps/output/errors.h"
#include "apps/output/file.h"
#include "apps/output/stop_signal.h"
#include "scratch_folder.h"

namespace platen::apps {
namespace {

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
