// Reads sources and reports what breaks the layers: which folder may include what, and that numerics opens no
// file.
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

// Checks one source file. `folder` is the layer it belongs to: "dem", "fem" or "coupling" (others may do
// anything); `file` is only repeated in the result. Comments and string literals are not looked at.
std::vector<Violation> check_source(const std::string &folder, const std::string &file,
                                    const std::string &text);

struct Survey {
  std::vector<Violation> violations;
  int files = 0; // sources read
};

// Checks all .h and .cc files of the three layers below `root`. Throws std::runtime_error where a file cannot
// be read.
Survey check_tree(const std::filesystem::path &root);

} // namespace platen::layering
