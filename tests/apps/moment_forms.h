// What a bond that remembers does between two spheres that turn against each other, half each, about an axis
// across it (bending) or along it (twisting), by hand: its skin goes by beta R_b sin(turn) and softens, or
// breaks, as if it were pulled or sheared as a whole (theory 2.2, 2.6, 2.7).
#pragma once

#include "apps/cohesive_forms.h"

namespace platen::apps::testing {

struct MomentSection {
  double stiffness = 0; // N m, k_n I or k_s J, times the sine of the turn
  double arm = 0;       // m, beta R_b; 0: the skin does not count
  // The skin's own softening, and that of the other direction where both lose at once.
  SofteningByHand own, other;
  bool coupled = false;
  double area = 0; // m^2
};
enum class MomentAxis { across, along };
// beta: share of the moment that counts. bond_radius in m.
MomentSection moment_section(const CohesiveSection &section, MomentAxis axis, double beta,
                             double bond_radius);

class MomentByHand {
public:
  explicit MomentByHand(const MomentSection &section) : section_(section) {}

  // As CohesiveByHand's, of turns (rad) from 0 on.
  std::vector<double> kinks(double to) const;
  void go(double to);
  double moment() const; // N m
  double stored() const; // J
  double work() const { return work_; }
  double dissipated() const { return work_ - stored(); }

private:
  double used() const; // of the skin's limit, at the widest turn so far
  double left() const; // share of the stiffness
  double damage() const;

  MomentSection section_;
  double at_ = 0, widest_ = 0; // rad; sine
  double work_ = 0;            // J
  bool failed_ = false;
};

} // namespace platen::apps::testing
