// platen-compress and platen-brazilian: a specimen crushed, pulled or split between platens.
#pragma once

#include "apps/scene/command_line.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// Each whole app after scene and command line have been read; returns the exit status.
int run_compression(const CommandLine &command, const Scene &scene);
// The same with the specimen, a cylinder, laid on its rim; stress is 2 P / (pi D t).
int run_brazilian(const CommandLine &command, const Scene &scene);

} // namespace platen::apps
