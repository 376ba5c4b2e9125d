// Instructions that a piece of work takes, exactly, on any Linux: processors count them too, but not where
// they are shared out to guests.
#pragma once

#include <csignal>
#include <functional>

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

namespace platen::dem::examples {

// Of one thread. A child process does the work twice, so that memory and libraries are ready, and this one
// lets it go on one instruction at a time: some microseconds each. What the work changes is the child's. -1
// where the system does not allow that.
inline long instructions_of(const std::function<void()> &work) {
  const pid_t child = fork();
  if (child == 0) {
    if (ptrace(PTRACE_TRACEME, 0, nullptr, nullptr) != 0) _exit(1);
    work();
    raise(SIGSTOP);
    work();
    raise(SIGSTOP);
    _exit(0);
  }
  long count = -1;
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP) do {
      ++count;
      ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
      waitpid(child, &status, 0);
    } while (WIFSTOPPED(status) && WSTOPSIG(status) == SIGTRAP);
  const bool done = WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP;
  if (WIFSTOPPED(status)) {
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
  }
  return done ? count : -1;
}

} // namespace platen::dem::examples
