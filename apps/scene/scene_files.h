// Readers of scene files: .prm in the grammar of deal.II's ParameterHandler, and the same tree as .json. Both
// hand every entry to a Parameters table together with its place, so that each refusal names file and line.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "apps/scene/parameters.h"

namespace platen::apps {

struct Program;

// Reads a file by its ending, .prm or .json. Line ends of any system and a byte order mark are fine. Throws
// InputError. `include` in a .prm takes a path relative to the folder of the file that it stands in, or else
// of the scenes that came with the programs.
void read_scene_file(const std::string &path, Parameters &parameters);

// The same for text in memory; `name` stands in messages and gives the folder for `include`.
void read_prm_text(const std::string &text, const std::string &name, Parameters &parameters);
void read_json_text(const std::string &text, const std::string &name, Parameters &parameters);

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
