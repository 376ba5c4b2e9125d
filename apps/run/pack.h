// platen-pack: makes a specimen and judges its packing.
#pragma once

#include "apps/scene/command_line.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// The whole app after scene and command line have been read; returns the exit status.
int run_pack(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
