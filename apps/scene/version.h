// What this program was made of.
#pragma once

#include <string>

namespace platen::apps {

// "Platen 0.1.0 (commit 1a2b3c4, Release)\ncompiler GCC 12.2.0\ndeal.II 9.4.1, Trilinos 13.2.0, VTK 9.1.0".
std::string version_text();

// The first line only: for summary.json and logs.
std::string version_line();

// The same for programs: one line of JSON with the keys `version`, `commit` (null where it is not known),
// `changed` (whether the source was changed after it), `build_type`, `compiler`, `deal.II`, `trilinos` (null
// without), `vtk`.
std::string version_json();

// Whether that names the source: it is of a commit, and nothing was changed since.
bool has_commit_of_its_own();

} // namespace platen::apps
