// The apps that run on several ranks.
#pragma once

#include <memory>

#include "apps/scene/command_line.h"
#include "dem/exchange.h"
#include "dem/instruction_set.h"

namespace platen::apps {

// run_app on all ranks that a launcher has started, or on the one.
int run_app_on_ranks(int argc, char **argv, const AppDescription &app, const AppBody &body);

// To cut a specimen over the ranks; null where there is one.
std::unique_ptr<dem::Exchange> exchange_of_ranks();
// One line: how it was cut. And what to say where ranks have nothing to do; empty where all have.
std::string words_of_cut(const dem::Exchange &exchange);
std::string words_of_idle_ranks(const dem::Exchange &exchange);

// The best set that all ranks have. A specimen that is computed with several is not the same on all numbers
// of ranks.
dem::InstructionSet common_instruction_set(dem::InstructionSet own, dem::Exchange *exchange);

// Throws InputError where ranks were started with different scenes.
void require_one_scene(const std::string &text_of_scene, dem::Exchange *exchange);

} // namespace platen::apps
