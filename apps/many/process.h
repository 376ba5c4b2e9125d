// A program run beside this one, which it outlives neither unnoticed nor unasked.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace platen::apps {

// A started program: no input, its standard error kept in memory. It stands in a process group of its own, so
// that Ctrl-C reaches it only through send(), and is sent SIGTERM where this process dies.
class Process {
public:
  enum class Output { dropped, ours }; // what becomes of its standard output
  using Body = std::function<int(int argc, char **argv)>;
  // Program and arguments, no shell, in the working folder of this process. With a `body` the same of a
  // function, in a copy of this process, which has its libraries loaded already: it gets the command as the
  // main of a program does and returns the exit status. Handled signals are as a started program finds them.
  // This process may have no other thread then (has_one_thread()): a copy would be without it. Throws
  // OutputError where the system has no process to give.
  explicit Process(const std::vector<std::string> &command, const Body &body = nullptr,
                   Output output = Output::dropped);
  ~Process(); // asks a program that still runs to end, and waits for it
  Process(Process &&other) noexcept;
  Process &operator=(Process &&) = delete;

  bool running(); // until it has ended and its status is known
  void send(int signal) const;
  // Once it does not run: exit status, or minus the number of the signal that ended it.
  int status() const { return status_; }
  // Once it does not run: the end of what it wrote to standard error.
  std::string errors() const;

private:
  pid_t id_ = -1; // -1: nothing runs
  int status_ = 0, errors_ = -1;
};

bool has_one_thread();

// What work(k) returns for each k of [0, count), each in a process of its own, so that no thread that it
// starts is left in this one; at most so many at a time. Texts of some thousand bytes. What one throws is
// thrown here: InputError, OutputError, else std::runtime_error. Throws Stopped after a signal.
std::vector<std::string> answers(std::size_t count, int at_a_time,
                                 const std::function<std::string(std::size_t)> &work);

} // namespace platen::apps
