// The folder that holds the newest checkpoints of a run: checkpoint/step_000000012000.platen.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/output/checkpoint.h"

namespace platen::apps {

constexpr int kept_checkpoints = 2; // the newest, and one to fall back on

// Writes the checkpoint of `step` into `folder` (created where needed): fill() adds the blocks. It is written
// aside, becomes current by rename when the disk has it, and only then all but the two newest go; checkpoints
// of later steps are of a run that was taken back, and go too. Where writing fails (OutputError), the former
// ones stay as they are. Returns the file.
std::filesystem::path write_checkpoint(const std::filesystem::path &folder, std::uint64_t step,
                                       const std::function<void(StateSink &)> &fill);

// Its parts, for who writes the file otherwise (rank_checkpoint.h): its name, and what goes once it is there.
std::filesystem::path checkpoint_path(const std::filesystem::path &folder, std::uint64_t step);
void remove_other_checkpoints(const std::filesystem::path &folder, std::uint64_t step);

struct FoundCheckpoint {
  std::filesystem::path path;
  std::uint64_t step = 0;
  std::vector<std::string> remarks; // newer checkpoints that are damaged, one sentence each: for the user
};

// The newest checkpoint of which every byte holds. Throws CheckpointError where there is none; the text says
// what is wrong with those that are there.
FoundCheckpoint newest_whole_checkpoint(const std::filesystem::path &folder);

} // namespace platen::apps
