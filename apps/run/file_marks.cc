#include "apps/run/file_marks.h"

#include <limits>

#include "apps/output/sha256.h"

namespace platen::apps {

void FileMarks::describe(Archive &archive) {
  const int version = archive.version(5);
  archive("cracks_bytes", cracks_bytes);
  if (version != 2) archive("history_bytes", history_bytes); // which the second left out
  if (version >= 3) { // the third and the fourth have sums of the tables too
    archive.text("specimen_sum", specimen_sum);
    archive.text("input_sums", input_sums);
  }
  archive("last_frame", last_frame, "s");
  archive("frames", frames, "1", between(0, std::numeric_limits<int>::max()));
  archive("wall_seconds", wall_seconds, "s", at_least(0));
  archive("target_strain", target_strain, "1", unknown_target, or_nan());
  if (version >= 4) archive.text("changes", changes);
}

void require_same_specimen(const FileMarks &marks, const OutputPaths &paths) {
  const std::filesystem::path file = paths.specimen_csv();
  if (marks.specimen_sum.empty() || sha256_of_file(file) == marks.specimen_sum) return;
  throw CheckpointError(file.string() +
                        ": error: is missing or has been changed since the checkpoint; put the file back as "
                        "the run wrote it, or start the run anew with --overwrite");
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
