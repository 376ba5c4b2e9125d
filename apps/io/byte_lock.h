// Bytes of a file that one process at a time holds, on this machine or another that sees the same file: locks
// of folders (FolderLock) are not passed on by network file systems, those of files are.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

namespace platen::apps {

// Held by this process and by every program that it starts from then on, until all of them have ended,
// however they end. The bytes need not be there, and are not touched.
class ByteLock {
public:
  static constexpr std::uint64_t to_the_end = 0; // as `count`: all bytes from the first on

  // Waits for who holds any of the bytes, after telling so once, for `patience` at most; null then. A file
  // system without locks gives one that holds nothing. Throws FolderError where the file cannot be opened for
  // writing.
  static std::unique_ptr<ByteLock> take(const std::filesystem::path &file, std::uint64_t first,
                                        std::uint64_t count, std::chrono::milliseconds patience,
                                        const std::function<void()> &tell_that_it_waits);
  // Whether another process holds the byte; false where there is no such file, and where nothing can be held.
  static bool is_taken(const std::filesystem::path &file, std::uint64_t byte);

  ~ByteLock();
  ByteLock(const ByteLock &) = delete;
  ByteLock &operator=(const ByteLock &) = delete;

  bool holds() const { return holds_; }

private:
  ByteLock(int file, bool holds) : file_(file), holds_(holds) {}
  int file_;
  bool holds_; // else the file system knows no locks
};

} // namespace platen::apps
