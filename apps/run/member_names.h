// Members of the library's settings, as its messages name them, and the scene's entries that they come from;
// refusals of entries.
#pragma once

#include <string>

#include "apps/scene/scene.h"
#include "coupling/errors.h"

namespace platen::apps {

// "Loading/Ramp" for "loading.ramp"; the member itself where no entry belongs to it.
std::string entry_of_member(const std::string &member);
// With every member in backquotes replaced by its entry.
std::string with_entries(const std::string &message);
// Throws InputError: "path reason", with file and line where the scene comes from a file.
[[noreturn]] void refuse(const Scene &scene, const std::string &path, const std::string &reason);
// Refuses the entry that a set-up failed at, with its file and line.
[[noreturn]] void refuse(const Scene &scene, const coupling::BadSetup &error);

} // namespace platen::apps
