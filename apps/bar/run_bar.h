// platen-bar: a bonded bar pulled, bent, twisted and struck, and what strength of materials says of it.
#pragma once

#include "apps/scene/command_line.h"

namespace platen::apps {

// The whole app: output folder, history.csv, summary.json, log; returns the exit status.
int run_bar(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
