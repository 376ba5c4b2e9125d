// What the checkpoint of a run holds, and where two checkpoints differ.
#pragma once

#include <filesystem>
#include <iosfwd>

namespace platen::apps {

// The newest whole checkpoint of an output folder: each part with its version, each block with its rows, what
// they are made of, unit, least and largest number. Newer ones that are damaged are told. Throws
// CheckpointError where there is none.
void list_state(const std::filesystem::path &folder, std::ostream &out);

// The first difference of the newest checkpoints of two output folders; true where there is none.
bool compare_states(const std::filesystem::path &folder, const std::filesystem::path &other,
                    std::ostream &out);

} // namespace platen::apps
