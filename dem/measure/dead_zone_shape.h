// The shape of a dead zone: its sections from the platen on, and the nearest cone.
#pragma once

#include <vector>

#include "dem/measure/dead_zone.h"

namespace platen::dem {

DeadZone measure_dead_zone(const Specimen &before, const std::vector<char> &members, End end,
                           const DeadZoneRules &rules);

} // namespace platen::dem
