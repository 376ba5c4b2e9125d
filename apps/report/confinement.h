// What a cell does to the specimen: its pressure, the deviator, and how the volume goes. Pictures need an X
// server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// Whether a cell, a sleeve or a wall presses the sides, so that the history has a deviator.
bool has_cell(const Run &run);

// Deviator and volume against axial strain, pressure against time. The run must have a cell.
void draw_confinement(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
