#include "apps/output/output_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <regex>

#include "apps/output/file.h"
#include "apps/output/run_log.h"
#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// What apps write: names without the ".part" of a file that is not whole yet, by the folder that they are in.
struct Names {
  const char *folder, *pattern;
};
constexpr std::array<Names, 5> output_names{{
    {"",
     "(scene|found)\\.prm|run\\.log|view\\.py|packings\\.sha256|(summary|study|plan)\\.json"
     "|(history|cracks|crack_state|events|bonds|bond_stress|directions|specimen|study|plan|costs|accuracy|"
     "comparisons"
     "|envelope|trials|abacus|packing_([a-z0-9_.]+_)?[0-9]+)\\.csv"
     "|(specimen|cracks)\\.vtu|(specimen|bonds|platens|sleeve|contacts|fields)\\.pvd"},
    {"frames",
     "(specimen|bonds|platens|sleeve|contacts)_[0-9]{6,}\\.vtu|fields_[0-9]{6,}\\.vti"
     "|(specimen|bonds)_[0-9]{6,}(_[0-9]{4,}\\.vtu|\\.pvtu)"}, // pieces of earlier versions
    {"checkpoint", "step_[0-9]{12,18}\\.platen"},
    {"packings", "[0-9a-f]{16}(\\.[^/]+)?\\.csv|in_use"},
    {"runs", "[^/]+\\.run\\.json"},
}};

// What the earlier run left, relative to the folder, in the order of names. Links count by their own name.
std::vector<fs::path> outputs_in(const fs::path &folder) {
  std::vector<fs::path> found;
  for (const Names &names : output_names) {
    std::error_code error;
    for (const auto &entry : fs::directory_iterator(folder / names.folder, error)) {
      const fs::path relative = fs::path(names.folder) / entry.path().filename();
      if (is_output_name(relative)) found.push_back(relative);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

bool is_empty_log(const fs::path &folder, const fs::path &file) {
  std::error_code error;
  return folder / file == OutputPaths(folder).log() && fs::is_empty(folder / file, error);
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
  return fmt::format("frames/{}_{:06}.vtu", series, index);
}

bool is_output_name(const fs::path &relative) {
  static const std::vector<std::regex> patterns = [] {
    std::vector<std::regex> all;
    for (const Names &names : output_names)
      all.emplace_back(names.pattern);
    return all;
  }();
  const auto names = std::find_if(output_names.begin(), output_names.end(),
                                  [&](const Names &one) { return relative.parent_path() == one.folder; });
  if (names == output_names.end()) return false;
  const std::string whole = whole_path(relative).filename().string();
  return std::regex_match(whole, patterns[static_cast<std::size_t>(names - output_names.begin())]);
}

void check_output_folder(const fs::path &folder, FolderUse use, const std::vector<fs::path> &inputs) {
  if (this_rank().is_silent()) return;
  check_writable(folder);
  std::vector<fs::path> earlier = outputs_in(folder);
  if (use == FolderUse::resume) {
    if (std::none_of(earlier.begin(), earlier.end(),
                     [](const fs::path &file) { return file.parent_path() == "checkpoint"; }))
      fail(folder, "holds no checkpoint to resume from; leave out --resume to start anew");
    return;
  }
  check_inputs(folder, inputs);
  if (use != FolderUse::fresh || earlier.empty()) return;
  if (earlier.size() == 1 && is_empty_log(folder, earlier.front())) return;
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
    if (folder / file == OutputPaths(folder).log() && !fs::is_symlink(folder / file, error))
      fs::resize_file(folder / file, 0, error);
    else
      fs::remove(folder / file, error);
    if (error) fail(folder, fmt::format("{} cannot be removed: {}", file.string(), error.message()));
  }
  for (const Names &names : output_names)
    if (*names.folder != '\0')
      fs::remove(folder / names.folder, error); // only if nothing of the user's is left in it
}

std::unique_ptr<FileLock> lock_folder(const fs::path &folder, std::chrono::milliseconds patience,
                                      RunLog &log) {
  if (this_rank().is_silent()) return nullptr;
  auto lock = FileLock::take(OutputPaths(folder).log(), whole_file, patience,
                             [&] { log.info("waits for a run at work in {}", folder.string()); });
  if (lock == nullptr)
    fail(folder,
         "another run is at work in it; wait for it, stop it, or choose another folder with --output");
  return lock;
}

void open_locked(std::unique_ptr<FileLock> &lock, const fs::path &folder, FolderUse use,
                 const std::vector<fs::path> &inputs, RunLog &log) {
  if (this_rank().is_silent()) return;
  check_output_folder(folder, use, inputs);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail(folder, "cannot be created: " + error.message());
  if (lock == nullptr) lock = lock_folder(folder, patience_of_run, log);
  open_output_folder(folder, use, inputs); // what was there before the lock is checked again
}

} // namespace platen::apps
