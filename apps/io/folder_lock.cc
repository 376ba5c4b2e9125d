#include "apps/io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "apps/io/errors.h"
#include "apps/io/run_log.h"

namespace platen::apps {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience_of_run{5};
constexpr std::chrono::milliseconds glance{20};

} // namespace

// Not closed on exec: what is started inherits the lock.
FolderLock::FolderLock(const std::filesystem::path &folder, std::chrono::milliseconds patience,
                       const std::function<void()> &tell_that_it_waits)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {
  const auto fail = [&](const std::string &reason) {
    if (file_ >= 0) close(file_);
    throw FolderError("output folder " + folder.string() + ": " + reason);
  };
  if (file_ < 0) fail(std::strerror(errno));
  const auto end = Clock::now() + patience;
  for (bool told = false; flock(file_, LOCK_EX | LOCK_NB) != 0; told = true) {
    if (errno != EWOULDBLOCK && errno != EINTR) return; // a file system without locks
    if (Clock::now() > end)
      fail("another run is at work in it; wait for it, stop it, or choose another folder with --output");
    if (!told) tell_that_it_waits();
    std::this_thread::sleep_for(glance);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

std::unique_ptr<FolderLock> lock_of_run(const std::filesystem::path &folder, RunLog &log) {
  if (!std::filesystem::is_directory(folder)) return nullptr;
  return std::make_unique<FolderLock>(folder, patience_of_run,
                                      [&] { log.info("waits for a run at work in {}", folder.string()); });
}

void open_locked(std::unique_ptr<FolderLock> &lock, const std::filesystem::path &folder, FolderUse use,
                 const std::vector<std::filesystem::path> &inputs, RunLog &log) {
  check_output_folder(folder, use, inputs);
  std::error_code told_below;
  std::filesystem::create_directories(folder, told_below);
  if (lock == nullptr) lock = lock_of_run(folder, log);
  open_output_folder(folder, use, inputs); // what was there before the lock is looked at again
}

} // namespace platen::apps
