// platen-compress: a specimen crushed, or pulled, between platens.
#pragma once

#include "apps/scene/command_line.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// The whole app after scene and command line have been read; returns the exit status.
int run_compression(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
