// One study at a time in a folder.
#pragma once

#include <filesystem>
#include <functional>

namespace platen::apps {

// Held by this process and by every program that it starts from then on, until all of them have ended: the
// runs of a study that was killed may still be writing their last checkpoints when it is taken up again.
class FolderLock {
public:
  // Waits for who holds the folder, after telling so once, for a minute at most. Throws FolderError then, and
  // where the folder cannot be opened.
  explicit FolderLock(const std::filesystem::path &folder, const std::function<void()> &tell_that_it_waits);
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  int file_ = -1;
};

} // namespace platen::apps
