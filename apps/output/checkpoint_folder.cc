#include "apps/output/checkpoint_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "apps/scene/rank.h"

namespace platen::apps {
namespace {

struct Entry {
  std::uint64_t step = 0;
  std::filesystem::path path;
};

std::optional<std::uint64_t> step_of(const std::string &name) {
  static const std::regex pattern("step_([0-9]{12,18})\\.platen");
  std::smatch match;
  if (!std::regex_match(name, match, pattern)) return std::nullopt;
  return std::stoull(match[1].str());
}

// Newest first.
std::vector<Entry> entries_of(const std::filesystem::path &folder) {
  std::vector<Entry> entries;
  std::error_code error;
  for (const auto &file : std::filesystem::directory_iterator(folder, error))
    if (const auto step = step_of(file.path().filename().string())) entries.push_back({*step, file.path()});
  std::sort(entries.begin(), entries.end(), [](const Entry &a, const Entry &b) { return a.step > b.step; });
  return entries;
}

} // namespace

std::filesystem::path checkpoint_path(const std::filesystem::path &folder, std::uint64_t step) {
  return folder / fmt::format("step_{:012}.platen", step);
}

void remove_other_checkpoints(const std::filesystem::path &folder, std::uint64_t step) {
  int kept = 1;
  std::error_code ignored; // a file too many does no harm
  for (const Entry &entry : entries_of(folder))
    if (entry.step > step || (entry.step < step && ++kept > kept_checkpoints))
      std::filesystem::remove(entry.path, ignored);
  for (const auto &file :
       std::filesystem::directory_iterator(folder, ignored)) { // left by runs that were killed
    const std::filesystem::path whole = whole_path(file.path());
    if (whole != file.path() && step_of(whole.filename().string()))
      std::filesystem::remove(file.path(), ignored);
  }
}

std::filesystem::path write_checkpoint(const std::filesystem::path &folder, std::uint64_t step,
                                       const std::function<void(StateSink &)> &fill) {
  if (this_rank().is_silent()) return folder;
  create_folder(folder);
  const std::filesystem::path path = checkpoint_path(folder, step);
  write_aside(path, [&](const std::filesystem::path &part) {
    CheckpointWriter writer(part);
    fill(writer);
    writer.finish();
  });
  remove_other_checkpoints(folder, step);
  return path;
}

FoundCheckpoint newest_whole_checkpoint(const std::filesystem::path &folder) {
  std::vector<std::string> remarks;
  std::string damaged;
  for (const Entry &entry : entries_of(folder)) {
    try {
      CheckpointReader whole(entry.path);
      return {entry.path, entry.step, remarks};
    } catch (const CheckpointError &error) {
      remarks.push_back(fmt::format("checkpoint not used: {}", error.what()));
      damaged += fmt::format("\n{}", error.what());
    }
  }
  if (damaged.empty()) throw CheckpointError(folder.string() + ": no checkpoint to go on from");
  throw CheckpointError(folder.string() + ": no whole checkpoint to go on from" + damaged);
}

} // namespace platen::apps
