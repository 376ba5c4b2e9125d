// Rules on the settings of a sleeve, a tube or a wrap and of metals, as faults.h has them of all settings.
#pragma once

#include "coupling/faults.h"

namespace platen::coupling {

// Of settings that have one. `servo`: whether the top platen is ever asked for a stress.
std::vector<Fault> sleeve_faults(const PlatenTestSettings &settings, const dem::Shape *shape, bool servo);

// Of a metal that yields. `of`: of its members ("sleeve.metal."); `modulus_of`: the member with its Young's
// modulus (Pa).
std::vector<Fault> metal_faults(const MetalSettings &metal, const std::string &of, double young_modulus,
                                const std::string &modulus_of);

} // namespace platen::coupling
