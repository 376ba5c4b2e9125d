// A bond with history on the path of a scene: by platen-bonds, and by hand.
#pragma once

#include <string>
#include <vector>

#include "apps/bonds/bond_run.h"
#include "apps/moment_forms.h"

namespace platen::apps::testing {

struct ComparedRun : BondRun {
  struct ByHand {
    CohesiveLoad load;     // that holds the moved sphere
    double dissipated = 0; // J
  };
  std::vector<ByHand> by_hand; // of each row
  double length = 0;           // m, of the bond: at this arm forces count beside moments
  const BondReading &last() const { return rows.back(); }
  double largest_difference() const; // of loads, over the largest load by hand
};

// The first run of a shipped scene. Rows stand at the scene's steps and wherever the lines by hand bend, so
// that sums between rows are exact.
ComparedRun compared_run(const std::string &scene, std::vector<std::string> overrides);

} // namespace platen::apps::testing
