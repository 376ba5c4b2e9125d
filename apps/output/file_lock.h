// Bytes of a file that one process at a time holds, on this machine or on another that sees the same file:
// the locks of fcntl on open file descriptions, which network file systems pass on.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace platen::apps {

// Which bytes: `count` from the first on. They need not exist, and they are not touched.
struct Bytes {
  std::uint64_t first = 0;
  std::uint64_t count = 0; // 0: all from the first on
};
constexpr Bytes whole_file{};

// Held by this process and by every program that it starts from then on, until all of them have ended,
// however they end.
class FileLock {
public:
  // Creates the file if it does not exist. If another process holds any of the bytes, calls `report_waiting`
  // once and waits up to `patience`; returns null after that. On a file system without locks the result holds
  // nothing. Throws OutputError on a full disk, FolderError if the file cannot be opened for writing,
  // or is a link.
  static std::unique_ptr<FileLock> take(const std::filesystem::path &file, Bytes bytes,
                                        std::chrono::milliseconds patience,
                                        const std::function<void()> &report_waiting);
  // Whether another process holds the byte; false if there is no such file, or no lock on its file system.
  static bool is_taken(const std::filesystem::path &file, std::uint64_t byte);

  ~FileLock();
  FileLock(const FileLock &) = delete;
  FileLock &operator=(const FileLock &) = delete;

  bool holds() const { return holds_; }

private:
  explicit FileLock(int file) : file_(file) {}
  int file_;
  bool holds_ = false; // else the file system has no locks
};

} // namespace platen::apps
