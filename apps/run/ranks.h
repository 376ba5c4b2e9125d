// The apps that run on several ranks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/scene/command_line.h"
#include "base/state.h"
#include "dem/exchange.h"
#include "dem/instruction_set.h"
#include "dem/model.h"

namespace platen::apps {

// run_app on all ranks that a launcher has started, or on the one.
int run_app_on_ranks(int argc, char **argv, const Program &program, const AppBody &body);

// To cut a specimen over the ranks; null where there is one.
std::unique_ptr<dem::Exchange> exchange_of_ranks();
// One line: how it was cut. And what to say where ranks have nothing to do; empty where all have.
std::string words_of_cut(const dem::Exchange &exchange);
std::string words_of_idle_ranks(const dem::Exchange &exchange);

// The best set that all ranks have, and what to say where some have a better one; empty where none has. A
// specimen that is computed with several sets is not the same on all numbers of ranks.
struct CommonSet {
  dem::InstructionSet set;
  std::string note;
};
CommonSet common_instruction_set(dem::InstructionSet own, dem::Exchange *exchange, bool resumes);

// Throws InputError where ranks have different texts: command lines, or scenes of one name on several
// machines.
void require_same_on_ranks(const std::string &text);

// write_checkpoint (apps/output/checkpoint_folder.h) of a run whose specimen is cut: all ranks write it, each
// its own rows, after settle_state() of the experiment. `part` is the name of the specimen in the state that
// `fill` adds on each rank.
void write_checkpoint_of_ranks(dem::Model &specimen, const std::string &part,
                               const std::filesystem::path &folder, std::uint64_t step,
                               const std::function<void(StateSink &)> &fill);

} // namespace platen::apps
