// Where spheres and platens were at the largest stress so far: what cones are found from later.
#pragma once

#include <array>
#include <vector>

#include "base/archive.h"
#include "coupling/platen_test.h"
#include "dem/measure/dead_zone.h"

namespace platen::apps {

class StateAtPeak {
public:
  void keep(const coupling::PlatenTest &problem);
  // Nothing where no state was kept.
  dem::MotionAfterPeak motion_since(const coupling::PlatenTest &problem) const;
  void describe(Archive &archive);

private:
  std::vector<Vector3> position_; // m, of each sphere
  struct Place {
    Vector3 displacement; // m, of the middle of a platen's face since the start; elastic: of its mean
    Quaternion rotation;  // of what the machine moves
  };
  static Place place_of(const coupling::Platen &platen);
  std::array<Place, 2> platens_; // [bottom_end], [top_end]
};

} // namespace platen::apps
