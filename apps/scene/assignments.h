// What scene files say, before anything is known of its meaning: paths, texts and places.
#pragma once

#include <string>
#include <vector>

#include "apps/scene/faults.h"

namespace platen::apps {

struct Assignment {
  enum class Kind {
    section, // is opened
    value,   // of a key
    wrong,   // a statement that says nothing; `key` is what it may be about, `text` the message
    broken   // the same, and what follows it may be missing
  };
  Kind kind = Kind::value;
  std::string section, key, text; // "Platens/Top", "Stress", "1 MPa"
  Origin origin;
  std::string line; // as it stands in the file, for columns; "" where every character of the text can be seen
};

struct FileText {
  std::vector<Assignment> assignments; // in the order of the files
  std::vector<std::string> sources;    // that were read, the scene itself first
};

// Reads a file by its ending: .prm in the grammar of deal.II's ParameterHandler (subsection, set, end,
// include, # and \), or the same tree as .json. Line ends of any system and a byte order mark are fine.
// `include` takes a path relative to the folder of the file that it stands in, or else of the scenes that
// came with the programs. What is wrong, a file that cannot be read too, is an assignment of that kind.
FileText file_assignments(const std::string &path);
// The same for text in memory with plain line ends; `name` stands in messages and gives the folder for
// `include`.
FileText prm_assignments(const std::string &text, const std::string &name);
// {"Bond": {"Modulus": "320 GPa"}, "Platens": {"Top": {"Friction static": 0.3}}}: numbers, texts and true /
// false are values; an entry may be an object with a "value", as --print-parameters --json and
// ParameterHandler write it.
FileText json_assignments(const std::string &text, const std::string &name);

} // namespace platen::apps
