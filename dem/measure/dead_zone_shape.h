// The shape of a dead zone: its sections up from the platen, and the cone that they come nearest to.
#pragma once

#include <vector>

#include "dem/measure/dead_zone.h"

namespace platen::dem {

DeadZone measure_dead_zone(const Specimen &before, const std::vector<char> &members, End end,
                           const DeadZoneRules &rules);

} // namespace platen::dem
