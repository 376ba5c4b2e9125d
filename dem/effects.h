// Effects that this build has. The CMake list PLATEN_EFFECTS names them; one that it leaves out has no code.
#pragma once

#include <stdexcept>
#include <string>

namespace platen::dem::compiled {

#if defined(PLATEN_EFFECTS_LISTED)
inline constexpr bool rotation = PLATEN_WITH_ROTATION, bond_moments = PLATEN_WITH_BOND_MOMENTS,
                      friction = PLATEN_WITH_FRICTION, rolling = PLATEN_WITH_ROLLING,
                      hertz = PLATEN_WITH_HERTZ, bond_dashpots = PLATEN_WITH_BOND_DASHPOTS,
                      contact_dashpots = PLATEN_WITH_CONTACT_DASHPOTS,
                      local_damping = PLATEN_WITH_LOCAL_DAMPING, gravity = PLATEN_WITH_GRAVITY,
                      energy_ledger = PLATEN_WITH_ENERGY_LEDGER, crack_log = PLATEN_WITH_CRACK_LOG,
                      dissipative_scheme = PLATEN_WITH_DISSIPATIVE_SCHEME,
                      strength_factors = PLATEN_WITH_STRENGTH_FACTORS;
#else
inline constexpr bool rotation = true, bond_moments = true, friction = true, rolling = true, hertz = true,
                      bond_dashpots = true, contact_dashpots = true, local_damping = true, gravity = true,
                      energy_ledger = true, crack_log = true, dissipative_scheme = true,
                      strength_factors = true;
#endif

} // namespace platen::dem::compiled
