// A report on one output folder, or on several compared.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// Draws all pictures that the first run's files allow into `folder` (made where it is not there), with more
// than one run also the comparison; puts them and the figures on the page report.html there; prints what was
// drawn, what is missing, and the figures. Needs a display. Throws InputError where a frame is damaged,
// OutputError where a picture or the page cannot be written.
void write_report(const std::vector<Run> &runs, const std::filesystem::path &folder, std::ostream &out);

} // namespace platen::apps::report
