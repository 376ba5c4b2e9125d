#include "apps/run/file_marks.h"

#include <fmt/format.h>

#include <limits>

#include "apps/io/sha256.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t all_bytes = UINT64_MAX;

// Why the first `bytes` of a file are not those of the checkpoint; "" where they are.
std::string fault_of(const fs::path &file, std::uint64_t bytes, const std::string &sum) {
  std::error_code failure;
  if (!fs::exists(fs::symlink_status(file, failure))) return "is missing";
  if (!fs::is_regular_file(file, failure)) return "is no file";
  const std::uintmax_t size = fs::file_size(file, failure);
  if (failure) return "cannot be read: " + failure.message();
  if (bytes != all_bytes && size < bytes)
    return fmt::format("has {} bytes, it had {} at the checkpoint", size, bytes);
  const std::optional<std::string> found = sha256_of_file(file, bytes);
  if (!found) return "cannot be read";
  return *found == sum ? "" : "has been changed since the checkpoint";
}

} // namespace

void FileMarks::describe(Archive &archive) {
  const int version = archive.version(4);
  archive("cracks_bytes", cracks_bytes);
  if (version != 2) archive("history_bytes", history_bytes); // which the second left out
  if (version >= 3) {
    archive.text("cracks_sum", cracks_sum);
    archive.text("history_sum", history_sum);
    archive.text("specimen_sum", specimen_sum);
    archive.text("input_sums", input_sums);
  }
  archive("last_frame", last_frame, "s");
  archive("frames", frames, "1", between(0, std::numeric_limits<int>::max()));
  archive("wall_seconds", wall_seconds, "s", at_least(0));
  archive("target_strain", target_strain, "1", unknown_target, or_nan());
  if (version >= 4) archive.text("changes", changes);
}

void require_same_files(const FileMarks &marks, const OutputPaths &paths, RunLog &log) {
  const auto require = [](const fs::path &file, std::uint64_t bytes, const std::string &sum,
                          const char *way_out) {
    const std::string fault = sum.empty() ? "" : fault_of(file, bytes, sum);
    if (!fault.empty())
      throw CheckpointError(file.string() + ": error: " + fault +
                            "; put the file back as the run wrote it, " + way_out);
  };
  std::error_code none;
  constexpr const char *anew = "or start the run anew with --overwrite";
  require(paths.specimen_csv(), all_bytes, marks.specimen_sum, anew);
  require(paths.cracks(), marks.cracks_bytes, marks.cracks_sum, anew);
  if (fs::exists(fs::symlink_status(paths.history(), none)))
    require(paths.history(), marks.history_bytes, marks.history_sum,
            "or move it away: it is then written anew from the checkpoint");
  else
    log.warning("{}: is missing, it is written anew from the checkpoint", paths.history().string());
}

void require_same_inputs(const FileMarks &marks, const Scene &scene, const Json &now) {
  if (marks.input_sums.empty()) return;
  const Json before = Json::parse(marks.input_sums, nullptr, false);
  for (const auto &[entry, sum] : now.items())
    if (text_in(before, entry) != sum)
      refuse(
          scene, entry,
          "names a file that has changed since the run began that is to be resumed. Allowed: the file as it "
          "was, or a new run.");
}

} // namespace platen::apps
