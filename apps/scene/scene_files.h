// Scenes written as text.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/scene/parameters.h"

namespace platen::apps {

struct Program;

// Write all entries: as .prm, which deal.II's ParameterHandler reads too, with or without documentation; as
// JSON, an object for each entry with value, default, unit, what is allowed and documentation. Both can be
// read as scenes.
void write_prm(const std::vector<Entry> &entries, bool with_documentation, std::ostream &out);
void write_json(const std::vector<Entry> &entries, std::ostream &out);

// The text of a scene that scene_text gave for `folder`, as this program writes it: entries that it lacks,
// because the program that wrote it had none, stand there with their defaults. As it is where it cannot be
// read.
std::string completed_scene_text(const std::string &path, const std::string &folder, const Program &program);

} // namespace platen::apps
