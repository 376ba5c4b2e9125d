// The test of a bond with history: two spheres go from place to place without inertia, because such a bond
// remembers the path that the test states, not the oscillations of free spheres. The bond is the model's own,
// advanced by its kernels.
#pragma once

#include "apps/bonds/bond_run.h"

namespace platen::apps {

class PrescribedPair {
public:
  explicit PrescribedPair(const Scene &scene);

  // Rows stand at `Pair test/Steps` equal steps and at each turn of the path. To be called once.
  BondRun run();

private:
  struct Place {
    double opening = 0, slip = 0; // m
    double turn = 0;              // rad, of one sphere against the other
  };
  // Holding loads of the moved sphere: N, tension positive; N m.
  struct Load {
    double normal = 0, shear = 0, moment = 0;
  };
  Place place_at(double displacement) const;
  void follow(const Place &to, int rows, BondRun &run);
  void move(const Place &to);
  void take(const BondReading &now, BondRun &run);
  BondReading read() const;

  const Scene &scene_;
  const PairTest &test_;
  dem::Model model_;
  const double length_, normal_stiffness_; // m, Pa/m; of the intact bond
  const bool slides_, turns_;
  const int moves_per_row_;
  double closed_ = 0;                 // m, opening under the pressure of a shear test
  std::size_t upper_ = 0, lower_ = 0; // rows
  Place at_;
  Load load_;
  double work_ = 0;
  BondReading peak_; // intact, of the driven direction
  bool softened_ = false;
  long steps_ = 0;
};

} // namespace platen::apps
