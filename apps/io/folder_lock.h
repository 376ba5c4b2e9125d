// One run at a time in a folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "apps/io/output_folder.h"

namespace platen::apps {

// Held by this process and by every program that it starts from then on, until all of them have ended: the
// runs of a study that was killed may still be writing their last checkpoints when it is taken up again. The
// end of a process, however it comes, gives the folder free; nothing is left behind in it.
class FolderLock {
public:
  // Waits for who holds the folder, after telling so once, for `patience` at most. Throws FolderError then,
  // and where the folder cannot be opened. A file system without locks is not locked.
  FolderLock(const std::filesystem::path &folder, std::chrono::milliseconds patience,
             const std::function<void()> &tell_that_it_waits);
  ~FolderLock();
  FolderLock(const FolderLock &) = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  int file_ = -1;
};

class RunLog;

// For a run or a calibration, which waits five seconds, as one that was asked to end may need for its last
// checkpoint; null where the folder is not there yet.
std::unique_ptr<FolderLock> lock_of_run(const std::filesystem::path &folder, RunLog &log);

// open_output_folder in a folder that `lock` holds from then on, where it does not yet.
void open_locked(std::unique_ptr<FolderLock> &lock, const std::filesystem::path &folder, FolderUse use,
                 const std::vector<std::filesystem::path> &inputs, RunLog &log);

} // namespace platen::apps
