// Which programs read an entry: the others take scenes that hold it, and do nothing with it.
#pragma once

#include <string>

#include "apps/scene/scene.h"

namespace platen::apps {

// Of an entry, "Bond/Gap". tests/apps/scene_readers_test.cc runs the programs with everything else changed.
bool reads(AppKind app, const std::string &path);

} // namespace platen::apps
