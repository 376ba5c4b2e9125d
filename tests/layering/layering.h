// Reads sources and reports what breaks the layers: which folder may include what, that numerics opens no
// file, that it names no entry of a scene file, and that it calls no function of the C library that differs
// by processor.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platen::layering {

struct Violation {
  std::string file;
  int line = 0; // from 1
  std::string what;
};

// Checks one source file. `folder` is the layer it belongs to: "base", "dem", "dist", "fem" or "coupling"
// (others may do anything); `file` is only repeated in the result. Comments are not looked at, string
// literals for entries of scenes alone.
std::vector<Violation> check_source(const std::string &folder, const std::string &file,
                                    const std::string &text);

struct Survey {
  std::vector<Violation> violations;
  int files = 0; // sources read
};

// Checks all .h and .cc files of these layers below `root`. Throws std::runtime_error where a file cannot
// be read.
Survey check_tree(const std::filesystem::path &root);

} // namespace platen::layering
