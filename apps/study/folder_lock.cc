#include "apps/study/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "apps/io/errors.h"

namespace platen::apps {
namespace {

using Clock = std::chrono::steady_clock;

// A run that is asked to end finishes its step and writes a checkpoint, at most some hundred megabytes.
constexpr std::chrono::seconds patience{60};
constexpr std::chrono::milliseconds glance{20};

} // namespace

// Not closed on exec: what is started inherits the lock.
FolderLock::FolderLock(const std::filesystem::path &folder, const std::function<void()> &tell_that_it_waits)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {
  const auto fail = [&](const std::string &reason) {
    if (file_ >= 0) close(file_);
    throw FolderError("output folder " + folder.string() + ": " + reason);
  };
  if (file_ < 0) fail(std::strerror(errno));
  const auto end = Clock::now() + patience;
  for (bool told = false; flock(file_, LOCK_EX | LOCK_NB) != 0; told = true) {
    if (errno != EWOULDBLOCK && errno != EINTR) return; // a file system without locks
    if (Clock::now() > end) fail("another study is at work in it; wait for it, or choose another folder");
    if (!told) tell_that_it_waits();
    std::this_thread::sleep_for(glance);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

} // namespace platen::apps
