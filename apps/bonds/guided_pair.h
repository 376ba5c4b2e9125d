// The test of a bond that remembers, measured and by hand side by side: two spheres go from place to
// place without inertia, for what such a bond remembers is the path that the test states, not the
// oscillations of free spheres. The bond itself is the model's own, brought on by its kernels.
#pragma once

#include <optional>
#include <vector>

#include "apps/bonds/interface_forms.h"
#include "apps/bonds/load_path.h"
#include "apps/bonds/moment_forms.h"
#include "apps/bonds/pair_section.h"

namespace platen::apps {

// Of the one bond, as it stands.
struct InterfaceReading {
  double tension_damage = 0, shear_damage = 0; // 1
  double plastic_closing = 0;                  // m, that stays when it is unloaded
  double work = 0, stored = 0, dissipated = 0; // J; work by the trapezoid between places
};

struct InterfaceRow {
  InterfaceReading measured;
  InterfaceLoad load, by_hand;   // that holds the moved sphere
  double dissipated_by_hand = 0; // J
};

struct InterfaceResult {
  std::vector<InterfaceRow> rows;
  double length = 0; // m, of the bond: at this arm forces count beside moments
  // J/m^2, area under the softening branch; NaN where the bond has not failed in tension, or in shear without
  // pressure.
  double fracture_energy = 0, fracture_energy_by_hand = 0;

  double largest_difference() const;        // of loads, over the largest load by hand
  double difference(std::size_t row) const; // of a row
};

struct BondRun;

class InterfaceTest {
public:
  // Throws InputError where this build leaves out what the scene asks for.
  InterfaceTest(const Scene &scene, double modulus, double stiffness_ratio);

  // Rows stand at `Pair test/Steps` equal steps and wherever the lines by hand bend, so that sums between
  // rows are exact. To be called once.
  BondRun run();

private:
  void move(const InterfacePlace &to);
  void add_row(BondRun &run, const InterfacePlace &at) const;
  std::vector<double> kinks(const InterfacePlace &to) const; // of the lines by hand
  void go_by_hand(const InterfacePlace &to);
  void conclude(BondRun &run) const;
  void conclude_turning(BondRun &run) const;
  InterfaceReading read() const;

  const PairTest &test_;
  double radius_; // m, of a sphere
  dem::Model model_;
  InterfaceSection section_;
  InterfaceByHand by_hand_;
  std::optional<MomentByHand> moment_; // by hand, on a path that bends or twists
  std::size_t upper_ = 0, lower_ = 0;  // rows
  InterfacePlace at_;
  InterfaceLoad now_;
  double work_ = 0;
  long steps_ = 0;
};

} // namespace platen::apps
