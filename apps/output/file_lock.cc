#include "apps/output/file_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "apps/output/errors.h"
#include "apps/scene/regular_file.h"

namespace platen::apps {
namespace {

constexpr std::chrono::milliseconds between_tries{20};

struct flock write_lock(Bytes bytes) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(bytes.first);
  lock.l_len = static_cast<off_t>(bytes.count);
  return lock;
}

} // namespace

// Locks of a process would end with the first descriptor that it closes, and programs that it starts would
// not inherit them. The descriptor stays open on exec, so that they do.
std::unique_ptr<FileLock> FileLock::take(const std::filesystem::path &file, Bytes bytes,
                                         std::chrono::milliseconds patience,
                                         const std::function<void()> &report_waiting) {
  if (is_pipe_or_device(file)) throw FolderError(file.string() + ": is no file");
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW, 0666);
  if (descriptor < 0) {
    const std::string reason = file.string() + ": cannot be opened for writing: " + std::strerror(errno);
    if (errno == ENOSPC || errno == EDQUOT) throw OutputError(reason);
    throw FolderError(reason);
  }
  std::unique_ptr<FileLock> lock(new FileLock(descriptor));
  const auto end = std::chrono::steady_clock::now() + patience;
  for (bool waits = false;; waits = true) {
    struct flock wanted = write_lock(bytes);
    lock->holds_ = ::fcntl(descriptor, F_OFD_SETLK, &wanted) == 0;
    if (lock->holds_ || (errno != EAGAIN && errno != EACCES && errno != EINTR)) return lock;
    if (std::chrono::steady_clock::now() > end) return nullptr;
    if (!waits) report_waiting();
    std::this_thread::sleep_for(between_tries);
  }
}

bool FileLock::is_taken(const std::filesystem::path &file, std::uint64_t byte) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock found = write_lock({byte, 1});
  const bool known = ::fcntl(descriptor, F_OFD_GETLK, &found) == 0;
  ::close(descriptor);
  return known && found.l_type != F_UNLCK;
}

FileLock::~FileLock() {
  ::close(file_);
}

} // namespace platen::apps
