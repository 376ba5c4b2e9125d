// The way that the test of an elasto-damage-plastic bond goes, measured and by hand side by side.
#pragma once

#include "apps/bonds/interface_rig.h"
#include "apps/bonds/load_path.h"

namespace platen::apps {

struct InterfaceRow {
  InterfaceReading measured;
  InterfaceLoad by_hand;         // N
  double dissipated_by_hand = 0; // J
};

struct InterfaceResult {
  PathResult path;                // driven load over driven displacement
  std::vector<InterfaceRow> rows; // the same rows
  InterfaceSection section;
  double stiffness_by_hand = 0, strength_by_hand = 0; // N/m, N; NaN or infinite where there is none
  // J/m^2, area under the softening branch; NaN where the bond has not failed in tension, or in shear without
  // pressure.
  double fracture_energy = 0, fracture_energy_by_hand = 0;

  double largest_difference() const;        // of loads, over the largest load by hand
  double difference(std::size_t row) const; // of a row
};

// Places that the path goes to on straight ways, from touching spheres on.
std::vector<InterfacePlace> turning_places(const PairTest &test, const InterfaceSection &section);

// Rows stand at `Pair test/Steps` equal steps and wherever the lines by hand bend, so that sums between rows
// are exact.
InterfaceResult follow_interface(InterfaceRig &rig, const Scene &scene);

} // namespace platen::apps
