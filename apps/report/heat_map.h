// A map over radius and height as coloured rectangles with axes.
#pragma once

#include <filesystem>
#include <string>

#include "apps/report/crack_density.h"

namespace platen::apps::report {

// Height upwards, radius to both sides (the map on the right, its mirror image on the left), in mm at one
// scale; colour bar at the right. Throws OutputError.
void save_heat_map(const std::string &title, const std::string &subtitle, const DensityMap &map,
                   const std::filesystem::path &png);

} // namespace platen::apps::report
