// Discs that are split and bars that are bent between strips: how the load spreads along each strip, and what
// the specimen opens or bends. Pictures need an X server (display.h) and throw OutputError where the file
// cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/platens.h"

namespace platen::apps::report {

// Whether strips press, not whole platens: as the scene of the run says.
bool has_strips(const Run &run);

// Load along a strip, N/m, in `parts` equal ones of the depth from -half_depth to half_depth (m) along y.
std::vector<double> load_along(const PlatenContacts &contacts, double half_depth, int parts);

// Of each strip against y near the peak; two supports apart. The run must have strips and contacts.
void draw_strip_loads(const Run &run, const Extent &extent, double radius, const std::filesystem::path &png);

// Whether the history has the opening of a disc or the deflection of a bar.
bool tells_opening(const Run &run);
// Nominal stress against it.
void draw_opening(const Run &run, const std::filesystem::path &png);

} // namespace platen::apps::report
