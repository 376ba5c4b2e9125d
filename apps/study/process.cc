#include "apps/study/process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

constexpr int cannot_start = 127;      // exit status, as shells have it
constexpr off_t longest_errors = 8192; // bytes told of a program's last words

// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char *const *arguments, pid_t parent, int errors, Process::Output output) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(cannot_start); // it died before it was watched
  const int nothing = open("/dev/null", O_RDWR);
  if (nothing < 0 || dup2(nothing, 0) < 0 || dup2(errors, 2) < 0) _exit(cannot_start);
  if (output == Process::Output::dropped && dup2(nothing, 1) < 0) _exit(cannot_start);
  execv(arguments[0], arguments);
  _exit(cannot_start);
}

} // namespace

Process::Process(const std::vector<std::string> &command, Output output) {
  std::vector<char *> arguments;
  for (const std::string &argument : command)
    arguments.push_back(const_cast<char *>(argument.c_str())); // execv promises to leave them alone
  arguments.push_back(nullptr);
  errors_ = memfd_create("errors", MFD_CLOEXEC);
  if (errors_ < 0) throw OutputError(command.front() + ": cannot be started: " + std::strerror(errno));
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become(arguments.data(), parent, errors_, output);
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

} // namespace platen::apps
