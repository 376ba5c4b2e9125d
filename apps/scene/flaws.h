// Flaws of a specimen as a scene writes them: "disc at 0 mm, 0 mm, 50 mm normal 0, 0, 1 radius 10 mm cut".
#pragma once

#include <optional>
#include <string>

#include "dem/bond_choice.h"

namespace platen::apps {

extern const char *const flaw_allowed;
// "" is none. Throws ValueError for a text that is no flaw.
std::optional<dem::Flaw> read_flaw(const std::string &text);

} // namespace platen::apps
