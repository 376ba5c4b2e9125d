// platen-calibrate: bonds for a wanted material.
#pragma once

#include "apps/scene/command_line.h"

namespace platen::apps {

int run_calibrate(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
