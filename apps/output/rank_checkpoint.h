// A checkpoint that all ranks write, each its own rows: the file that one process writes (checkpoint.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "base/state.h"
#include "dist/spread_state.h"

namespace platen::apps {

// As write_checkpoint (checkpoint_folder.h), on all ranks together; `fill` adds the same blocks on each. What
// `spread` does not know is taken from rank 0. Collective; where anything fails on any rank all throw the
// same OutputError, and the former checkpoints stay as they are.
std::filesystem::path write_rank_checkpoint(MPI_Comm ranks, const dist::SpreadState &spread,
                                            const std::filesystem::path &folder, std::uint64_t step,
                                            const std::function<void(StateSink &)> &fill);

} // namespace platen::apps
