#include "apps/io/output_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <regex>
#include <thread>

#include "apps/io/checkpoint_folder.h"
#include "apps/io/run_log.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

constexpr const char *frames_folder = "frames", *checkpoint_folder = "checkpoint",
                     *packings_folder = "packings", *runs_folder = "runs";
constexpr const char *inner_folders[] = {frames_folder, checkpoint_folder, packings_folder, runs_folder};
constexpr std::chrono::seconds patience_of_run{5};
constexpr std::chrono::milliseconds glance{20}; // between two tries to lock

// What the earlier run left, relative to the folder, in the order of names. Links count by their own name.
std::vector<fs::path> outputs_in(const fs::path &folder) {
  std::vector<fs::path> found;
  for (const char *part : {"", frames_folder, checkpoint_folder, packings_folder, runs_folder}) {
    std::error_code error;
    for (const auto &entry : fs::directory_iterator(folder / part, error)) {
      const fs::path relative = fs::path(part) / entry.path().filename();
      if (is_output_name(relative)) found.push_back(relative);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

[[noreturn]] void fail(const fs::path &folder, const std::string &what) {
  throw FolderError(fmt::format("output folder {}: {}", folder.string(), what));
}

// The nearest folder above (or the folder itself) that exists must let us in.
void check_writable(const fs::path &folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder);
  if (!there.lexically_normal().has_relative_path())
    fail(folder, "is the root of the file system; choose another folder with --output");
  if (!fs::exists(there, error) && error == std::errc::filename_too_long) fail(folder, error.message());
  while (!fs::exists(fs::symlink_status(there, error)) && there.has_relative_path())
    there = there.parent_path();
  if (!fs::is_directory(there, error)) fail(folder, fmt::format("{} is not a folder", there.string()));
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    fail(folder, fmt::format("no permission to write into {}", there.string()));
}

void check_inputs(const fs::path &folder, const std::vector<fs::path> &inputs) {
  std::error_code error;
  const fs::path home = fs::weakly_canonical(folder, error);
  for (const fs::path &input : inputs) {
    // The folder of the input is resolved, its own name is not: a link there would be replaced too.
    const fs::path file = fs::weakly_canonical(fs::absolute(input).parent_path(), error) / input.filename();
    if (is_output_name(file.lexically_relative(home)))
      fail(folder,
           fmt::format("the run would replace {}, which it reads; choose another folder with --output",
                       input.string()));
  }
}

} // namespace

std::string OutputPaths::frame_name(const std::string &series, int index) {
  return fmt::format("{}/{}_{:06}.vtu", frames_folder, series, index);
}

std::string OutputPaths::frame_of_pieces(const std::string &series, int index) {
  return fmt::format("{}/{}_{:06}.pvtu", frames_folder, series, index);
}

bool is_output_name(const fs::path &relative) {
  static const std::regex top(
      "((scene|found)(\\.part)?\\.prm"
      "|(history|cracks|events|bonds|bond_stress|directions|specimen|study|plan|costs|accuracy|comparisons|"
      "trials|abacus"
      "|packing_([a-z0-9_.]+_)?[0-9]+)(\\.part)?\\.csv"
      "|packings(\\.part)?\\.sha256"
      "|(summary|study|plan)(\\.part)?\\.json|run\\.log|(specimen|cracks)(\\.part)?\\.vtu"
      "|view(\\.part)?\\.py|(specimen|bonds|platens|sleeve|contacts|fields)(\\.part)?\\.pvd)");
  static const std::regex frame(
      "((specimen|bonds|platens|sleeve|contacts)_[0-9]{6,}(\\.part)?\\.vtu"
      "|(specimen|bonds)_[0-9]{6,}(_[0-9]{4,}(\\.part)?\\.vtu|(\\.part)?\\.pvtu)"
      "|fields_[0-9]{6,}(\\.part)?\\.vti)");
  static const std::regex packing(R"([0-9a-f]{16}(\.[^/]+\.part)?\.csv|in_use)");
  static const std::regex record(R"([^/]+\.run(\.part)?\.json)");
  const std::string name = relative.filename().string();
  const fs::path parent = relative.parent_path();
  if (parent.empty()) return std::regex_match(name, top);
  if (parent == frames_folder) return std::regex_match(name, frame);
  if (parent == packings_folder) return std::regex_match(name, packing);
  if (parent == runs_folder) return std::regex_match(name, record);
  return parent == checkpoint_folder && is_checkpoint_name(name);
}

void check_output_folder(const fs::path &folder, FolderUse use, const std::vector<fs::path> &inputs) {
  if (this_rank().is_silent()) return;
  check_writable(folder);
  const std::vector<fs::path> earlier = outputs_in(folder);
  if (use == FolderUse::resume) {
    const bool any = std::any_of(earlier.begin(), earlier.end(), [](const fs::path &file) {
      return file.parent_path() == checkpoint_folder;
    });
    if (!any) fail(folder, "holds no checkpoint to resume from; leave out --resume to start anew");
    return;
  }
  check_inputs(folder, inputs);
  if (use == FolderUse::fresh && !earlier.empty())
    fail(folder,
         fmt::format("holds an earlier run ({}{}); choose another folder with --output, replace the run "
                     "with --overwrite, or go on with --resume",
                     earlier.front().string(), earlier.size() > 1 ? ", ..." : ""));
}

void open_output_folder(const fs::path &folder, FolderUse use, const std::vector<fs::path> &inputs) {
  if (this_rank().is_silent()) return;
  check_output_folder(folder, use, inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "cannot be created: " + error.message());
  if (use != FolderUse::overwrite) return;
  for (const fs::path &file : outputs_in(folder)) {
    if (fs::is_directory(fs::symlink_status(folder / file, error)))
      fail(folder, fmt::format("{} is a folder, not a file of a run", file.string()));
    fs::remove(folder / file, error);
    if (error) fail(folder, fmt::format("{} cannot be removed: {}", file.string(), error.message()));
  }
  for (const char *part : inner_folders)
    fs::remove(folder / part, error); // only where nothing of the user's is left in it
}

// Not closed on exec: what is started inherits the lock.
FolderLock::FolderLock(const fs::path &folder, std::chrono::milliseconds patience,
                       const std::function<void()> &tell_that_it_waits, Hold hold)
    : file_(open(folder.c_str(), O_RDONLY | O_DIRECTORY)) {
  if (file_ < 0) fail(folder, std::strerror(errno));
  const auto end = std::chrono::steady_clock::now() + patience;
  const int kind = hold == Hold::alone ? LOCK_EX : LOCK_SH;
  for (bool told = false; flock(file_, kind | LOCK_NB) != 0; told = true) {
    if (errno != EWOULDBLOCK && errno != EINTR) return; // a file system without locks
    if (std::chrono::steady_clock::now() > end) {
      close(file_);
      fail(folder,
           "another run is at work in it; wait for it, stop it, or choose another folder with --output");
    }
    if (!told) tell_that_it_waits();
    std::this_thread::sleep_for(glance);
  }
}

FolderLock::~FolderLock() {
  close(file_);
}

std::unique_ptr<FolderLock> lock_of_run(const fs::path &folder, RunLog &log) {
  if (this_rank().is_silent()) return nullptr;
  std::error_code none;
  if (!fs::is_directory(folder, none)) return nullptr;
  return std::make_unique<FolderLock>(folder, patience_of_run,
                                      [&] { log.info("waits for a run at work in {}", folder.string()); });
}

void open_locked(std::unique_ptr<FolderLock> &lock, const fs::path &folder, FolderUse use,
                 const std::vector<fs::path> &inputs, RunLog &log) {
  if (this_rank().is_silent()) return;
  check_output_folder(folder, use, inputs);
  std::error_code told_below;
  fs::create_directories(folder, told_below);
  if (lock == nullptr) lock = lock_of_run(folder, log);
  open_output_folder(folder, use, inputs); // what was there before the lock is checked again
}

} // namespace platen::apps
