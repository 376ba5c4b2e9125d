// The test of a bond that remembers, measured and by hand side by side: two spheres go from place to
// place without inertia, for what such a bond remembers is the path that the test states, not the
// oscillations of free spheres. The bond itself is the model's own, brought on by its kernels.
#pragma once

#include <optional>
#include <vector>

#include "apps/bonds/cohesive_forms.h"
#include "apps/bonds/load_path.h"
#include "apps/bonds/moment_forms.h"
#include "apps/bonds/pair_section.h"

namespace platen::apps {

// Of the one bond, as it stands.
struct CohesiveReading {
  double tension_damage = 0, shear_damage = 0; // 1
  double plastic_closing = 0;                  // m, that stays when it is unloaded
  double work = 0, stored = 0, dissipated = 0; // J; work by the trapezoid between places
};

struct CohesiveRow {
  CohesiveReading measured;
  CohesiveLoad load, by_hand;    // that holds the moved sphere
  double dissipated_by_hand = 0; // J
};

struct CohesiveResult {
  std::vector<CohesiveRow> rows;
  double length = 0; // m, of the bond: at this arm forces count beside moments
  // J/m^2, area under the softening branch; NaN where the bond has not failed in tension, or in shear without
  // pressure.
  double fracture_energy = 0, fracture_energy_by_hand = 0;

  double largest_difference() const;        // of loads, over the largest load by hand
  double difference(std::size_t row) const; // of a row
};

struct BondRun;

class CohesiveTest {
public:
  // Throws InputError where this build leaves out what the scene asks for.
  CohesiveTest(const Scene &scene, double modulus, double stiffness_ratio);

  // Rows stand at `Pair test/Steps` equal steps and wherever the lines by hand bend, so that sums between
  // rows are exact. To be called once.
  BondRun run();

private:
  void move(const CohesivePlace &to);
  void add_row(BondRun &run, const CohesivePlace &at) const;
  std::vector<double> kinks(const CohesivePlace &to) const; // of the lines by hand
  void go_by_hand(const CohesivePlace &to);
  void conclude(BondRun &run) const;
  void conclude_turning(BondRun &run) const;
  CohesiveReading read() const;

  const PairTest &test_;
  double radius_; // m, of a sphere
  dem::Model model_;
  CohesiveSection section_;
  CohesiveByHand by_hand_;
  std::optional<MomentByHand> moment_; // by hand, on a path that bends or twists
  std::size_t upper_ = 0, lower_ = 0;  // rows
  CohesivePlace at_;
  CohesiveLoad now_;
  double work_ = 0;
  long steps_ = 0;
};

} // namespace platen::apps
