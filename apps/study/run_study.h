// platen-study: a list of cases, each crushed on several seeds.
#pragma once

#include "apps/scene/command_line.h"

namespace platen::apps {

int run_study(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
