#include "apps/many/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <list>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "apps/output/stop_signal.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

constexpr int cannot_start = 127;      // exit status, as shells have it
constexpr off_t longest_errors = 8192; // bytes told of a program's last words

// In the child, first of all: only calls that are safe between fork and exec.
void take_place(pid_t parent, int errors, Process::Output output) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(cannot_start); // it died before it was watched
  const int nothing = open("/dev/null", O_RDWR);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(errors, 2) < 0) _exit(cannot_start);
  if (output == Process::Output::dropped && dup2(nothing, 1) < 0) _exit(cannot_start);
}

// As exec leaves them: what is handled is so no more, what is ignored stays so.
void forget_signal_handlers() {
  for (int number = 1; number < NSIG; ++number) {
    struct sigaction action {};
    if (sigaction(number, nullptr, &action) != 0 || action.sa_handler == SIG_DFL ||
        action.sa_handler == SIG_IGN)
      continue;
    action = {};
    action.sa_handler = SIG_DFL;
    sigaction(number, &action, nullptr);
  }
}

// What the parent still holds in memory for its files is the parent's to write: nothing of it is closed here.
// Nor may anything thrown find its way back into what the parent was about.
[[noreturn]] void act(const Process::Body &body, std::vector<char *> &arguments) noexcept {
  prctl(PR_SET_NAME, std::filesystem::path(arguments[0]).filename().c_str());
  const int status = body(static_cast<int>(arguments.size()) - 1, arguments.data());
  std::cout.flush();
  std::fflush(nullptr);
  _exit(status);
}

// Signals wait while it lives, so that none is taken by what the child has of its parent.
class SignalsHeldBack {
public:
  SignalsHeldBack() {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before_);
  }
  ~SignalsHeldBack() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeldBack(const SignalsHeldBack &) = delete;
  SignalsHeldBack &operator=(const SignalsHeldBack &) = delete;

private:
  sigset_t before_{};
};

} // namespace

Process::Process(const std::vector<std::string> &command, const Body &body, Output output) {
  std::vector<char *> arguments;
  for (const std::string &argument : command)
    arguments.push_back(const_cast<char *>(argument.c_str())); // nobody writes there
  arguments.push_back(nullptr);
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  if (errors_ < 0) throw OutputError(command.front() + ": cannot be started: " + std::strerror(errno));
  std::cout.flush();
  std::fflush(nullptr); // or a copy would write it once more
  const pid_t parent = getpid();
  {
    const SignalsHeldBack until_told_apart;
    id_ = fork();
    if (id_ == 0) {
      take_place(parent, errors_, output);
      forget_signal_handlers();
    }
  }
  if (id_ == 0 && body) act(body, arguments);
  if (id_ == 0) {
    execv(arguments[0], arguments.data());
    _exit(cannot_start);
  }
  if (id_ > 0) return;
  const std::string reason = std::strerror(errno);
  close(errors_);
  throw OutputError(command.front() + ": cannot be started: " + reason);
}

Process::Process(Process &&other) noexcept
    : id_(std::exchange(other.id_, -1)), status_(other.status_), errors_(std::exchange(other.errors_, -1)) {}

Process::~Process() {
  if (id_ > 0) {
    send(SIGTERM);
    waitpid(id_, nullptr, 0);
  }
  if (errors_ >= 0) close(errors_);
}

bool Process::running() {
  if (id_ < 0) return false;
  int status = 0;
  const pid_t ended = waitpid(id_, &status, WNOHANG);
  if (ended == 0) return true;
  id_ = -1;
  status_ = ended < 0 ? cannot_start : WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return false;
}

void Process::send(int signal) const {
  if (id_ > 0) kill(id_, signal);
}

std::string Process::errors() const {
  const off_t length = lseek(errors_, 0, SEEK_END);
  const off_t from = length > longest_errors ? length - longest_errors : 0;
  std::string text(static_cast<std::size_t>(length > 0 ? length - from : 0), '\0');
  const ssize_t count = pread(errors_, text.data(), text.size(), from);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

bool has_one_thread() {
  std::error_code failure;
  const std::filesystem::directory_iterator tasks("/proc/self/task", failure);
  return !failure && std::distance(begin(tasks), end(tasks)) == 1;
}

std::vector<std::string> answers(std::size_t count, int at_a_time,
                                 const std::function<std::string(std::size_t)> &work) {
  std::vector<std::string> all(count);
  std::list<std::pair<std::size_t, Process>> active;
  const auto body = [&work](std::size_t k) {
    try {
      std::cerr << work(k);
      return status_done;
    } catch (const InputError &error) {
      std::cerr << error.what();
      return status_bad_input;
    } catch (const OutputError &error) {
      std::cerr << error.what();
      return status_output;
    } catch (const std::exception &error) {
      std::cerr << error.what();
      return status_numerics;
    }
  };
  for (std::size_t next = 0; next < count || !active.empty();) {
    if (stop_requested() != 0) throw Stopped{stop_requested()};
    for (; next < count && active.size() < static_cast<std::size_t>(std::max(1, at_a_time)); ++next)
      active.emplace_back(next, Process({"answer"}, [&body, next](int, char **) { return body(next); }));
    for (auto one = active.begin(); one != active.end();) {
      if (one->second.running()) {
        ++one;
        continue;
      }
      const std::string text = one->second.errors();
      const int status = one->second.status();
      if (status == status_bad_input) throw InputError(text);
      if (status == status_output) throw OutputError(text);
      if (status != status_done) throw std::runtime_error(text);
      all[one->first] = text;
      one = active.erase(one);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return all;
}

} // namespace platen::apps
