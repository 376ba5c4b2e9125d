// Rules on the settings of a sleeve, a tube or a wrap, as faults.h has them of all settings.
#pragma once

#include "coupling/faults.h"

namespace platen::coupling {

// Of settings that have one. `servo`: whether the top platen is ever asked for a stress.
std::vector<Fault> sleeve_faults(const PlatenTestSettings &settings, const dem::Shape *shape, bool servo);

} // namespace platen::coupling
