// Scenes written as text.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/scene/parameters.h"

namespace platen::apps {

// Write all entries: as .prm, which deal.II's ParameterHandler reads too, with or without documentation; as
// JSON, an object for each entry with value, default, unit, what is allowed and documentation. Both can be
// read as scenes.
void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out);
void write_json(const std::vector<Entry> &entries, std::ostream &out);

} // namespace platen::apps
