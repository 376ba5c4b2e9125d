#include "apps/io/byte_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "apps/io/errors.h"

namespace platen::apps {
namespace {

constexpr std::chrono::milliseconds glance{20}; // between two tries

struct flock write_lock(std::uint64_t first, std::uint64_t count) {
  struct flock bytes {};
  bytes.l_type = F_WRLCK;
  bytes.l_whence = SEEK_SET;
  bytes.l_start = static_cast<off_t>(first);
  bytes.l_len = static_cast<off_t>(count);
  return bytes;
}

} // namespace

// Locks of open file descriptions: those of processes would end with the first descriptor that is closed, and
// would not be inherited. Not closed on exec: what is started inherits the lock.
std::unique_ptr<ByteLock> ByteLock::take(const std::filesystem::path &file, std::uint64_t first,
                                         std::uint64_t count, std::chrono::milliseconds patience,
                                         const std::function<void()> &tell_that_it_waits) {
  const int descriptor = ::open(file.c_str(), O_RDWR | O_NONBLOCK);
  if (descriptor < 0)
    throw FolderError(file.string() + ": cannot be opened for writing: " + std::strerror(errno));
  std::unique_ptr<ByteLock> lock(new ByteLock(descriptor, false));
  const auto end = std::chrono::steady_clock::now() + patience;
  for (bool told = false;; told = true) {
    struct flock bytes = write_lock(first, count);
    if (::fcntl(descriptor, F_OFD_SETLK, &bytes) == 0) {
      lock->holds_ = true;
      return lock;
    }
    if (errno != EAGAIN && errno != EACCES && errno != EINTR) return lock; // a file system without locks
    if (std::chrono::steady_clock::now() > end) return nullptr;
    if (!told) tell_that_it_waits();
    std::this_thread::sleep_for(glance);
  }
}

bool ByteLock::is_taken(const std::filesystem::path &file, std::uint64_t byte) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return false;
  struct flock bytes = write_lock(byte, 1);
  const bool known = ::fcntl(descriptor, F_OFD_GETLK, &bytes) == 0;
  ::close(descriptor);
  return known && bytes.l_type != F_UNLCK;
}

ByteLock::~ByteLock() {
  ::close(file_);
}

} // namespace platen::apps
