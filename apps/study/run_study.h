// platen-study: a list of cases, each crushed on several seeds.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/command_line.h"

namespace platen::apps {

// Words that may come first on the command line.
std::vector<std::string> study_kinds();

int run_study(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
