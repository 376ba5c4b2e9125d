// Choices of a scene that exclude each other, entries that an app needs, and entries that have no effect.
#pragma once

#include "apps/scene/parameters.h"
#include "apps/scene/scene.h"

namespace platen::apps {

// Contradictions and what is missing, with their places; adds to scene.notes.
Faults check_scene(Scene &scene, const Parameters &parameters, const Program &program);

// The path of a file entry as the program can open it: relative to the folder of the file that sets it, or,
// from the command line, to the current folder.
std::string resolved_path(const Entry &entry);

} // namespace platen::apps
