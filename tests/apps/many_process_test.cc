// Programs and functions run as processes of their own.
#include "apps/many/process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <thread>

namespace platen::apps {
namespace {

int status_of(Process &process) {
  while (process.running())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return process.status();
}

int status_of_body(const Process::Body &body, const std::vector<std::string> &words = {"name"}) {
  Process process(words, body);
  return status_of(process);
}

TEST(StudyProcess, a_program_is_run_with_its_words) {
  Process process({"/bin/sh", "-c", "echo \"$0 $1\" >&2; exit 7", "first", "second word"});
  EXPECT_EQ(status_of(process), 7);
  EXPECT_EQ(process.errors(), "first second word\n");
}

TEST(StudyProcess, a_function_is_run_with_its_words_in_a_process_of_its_own) {
  int here = 0;
  Process process({"/somewhere/name", "second word"}, [&](int argc, char **argv) {
    here = 1;
    std::cerr << argc << ": " << argv[0] << ", " << argv[1] << (argv[2] == nullptr ? "" : "?");
    return 7;
  });
  EXPECT_EQ(status_of(process), 7);
  EXPECT_EQ(process.errors(), "2: /somewhere/name, second word");
  EXPECT_EQ(here, 0);
}

// As `ps` and `pkill` know it.
TEST(StudyProcess, a_function_has_the_name_of_the_program_that_it_is) {
  const auto told = [](int, char **) {
    char name[32] = "";
    std::FILE *file = std::fopen("/proc/self/comm", "r");
    const bool read = file != nullptr && std::fgets(name, sizeof name, file) != nullptr;
    return read && std::string(name) == "platen-compress\n" ? 0 : 1;
  };
  EXPECT_EQ(status_of_body(told, {"/some/where/platen-compress"}), 0);
}

TEST(StudyProcess, a_function_stands_in_a_group_of_its_own_without_input) {
  EXPECT_EQ(status_of_body([](int, char **) {
              char byte = 0;
              return getpgrp() == getpid() && read(0, &byte, 1) == 0 ? 0 : 1;
            }),
            0);
}

extern "C" void handled(int) {}

class Handled {
public:
  Handled(int number, void (*handler)(int)) : number_(number) {
    struct sigaction action {};
    action.sa_handler = handler;
    sigaction(number, &action, &before_);
  }
  ~Handled() { sigaction(number_, &before_, nullptr); }

private:
  int number_;
  struct sigaction before_ {};
};

void (*handler_of(int number))(int) {
  struct sigaction action {};
  sigaction(number, nullptr, &action);
  return action.sa_handler;
}

TEST(StudyProcess, signals_that_are_handled_here_are_not_in_a_function_and_those_ignored_are) {
  const Handled term(SIGTERM, handled), user(SIGUSR2, handled), pipe(SIGPIPE, SIG_IGN);
  EXPECT_EQ(status_of_body([](int, char **) {
              return (handler_of(SIGTERM) == SIG_DFL) + 2 * (handler_of(SIGUSR2) == SIG_DFL) +
                     4 * (handler_of(SIGPIPE) == SIG_IGN);
            }),
            7);
  EXPECT_EQ(handler_of(SIGTERM), handled); // of this process they are as they were
}

TEST(StudyProcess, signals_are_held_back_in_neither_but_where_they_were) {
  sigset_t one, before, after;
  sigemptyset(&one), sigaddset(&one, SIGUSR1);
  sigprocmask(SIG_BLOCK, &one, &before);
  EXPECT_EQ(status_of_body([](int, char **) {
              sigset_t now;
              sigprocmask(SIG_SETMASK, nullptr, &now);
              return sigismember(&now, SIGUSR1) + 2 * sigismember(&now, SIGTERM);
            }),
            1);
  sigprocmask(SIG_SETMASK, nullptr, &after);
  EXPECT_EQ(sigismember(&after, SIGUSR1), 1);
  EXPECT_EQ(sigismember(&after, SIGTERM), 0);
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

TEST(StudyProcess, a_function_that_is_asked_to_end_ends) {
  const Handled term(SIGTERM, handled);
  Process process({"name"}, [](int, char **) { return pause(); });
  process.send(SIGTERM);
  EXPECT_EQ(status_of(process), -SIGTERM);
}

TEST(StudyProcess, what_a_function_throws_ends_its_process_alone) {
  EXPECT_EQ(status_of_body([](int, char **) -> int { throw std::runtime_error("lost"); }), -SIGABRT);
}

// What this process has not written yet is written once, and what a function has not, too.
TEST(StudyProcess, nothing_is_written_twice_or_lost) {
  std::FILE *file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  std::fputs("before ", file);
  EXPECT_EQ(status_of_body([&](int, char **) {
              std::fputs("function ", file);
              return 0;
            }),
            0);
  std::fputs("after", file);
  std::rewind(file);
  char text[64] = "";
  ASSERT_NE(std::fgets(text, sizeof text, file), nullptr);
  EXPECT_STREQ(text, "before function after");
  std::fclose(file);
}

// In a copy, which begins with one whatever libraries have started here.
TEST(StudyProcess, threads_are_counted) {
  EXPECT_EQ(status_of_body([](int, char **) {
              const bool alone = has_one_thread();
              bool with_another = true;
              std::thread([&] { with_another = !has_one_thread(); }).join();
              return alone && with_another ? 0 : 1;
            }),
            0);
}

} // namespace
} // namespace platen::apps
