// What a bond with history does between two spheres that are moved from place to place, by hand: strengths,
// displacements and fracture energies of theory 2.6 and 2.7 as straight lines, of which the laws themselves
// know nothing.
#pragma once

#include <algorithm>
#include <vector>

#include "dem/bonds.h"

namespace platen::apps::testing {

// Linear softening of one direction, or none: brittle. SI units, stresses.
struct SofteningByHand {
  double strength = 0;  // Pa; infinite where it never fails
  double stiffness = 0; // Pa/m
  double softening = 0; // u_f / u_l - 1

  bool is_brittle() const { return !(softening > 0); }
  // Damage at so many times the limit.
  double damage(double used) const {
    if (is_brittle()) return used > 1 ? 1 : 0;
    return std::clamp((used - 1) / softening, 0.0, 1.0);
  }

  double limit() const { return strength / stiffness; }    // u_l, m, where damage begins
  double end() const { return limit() * (1 + softening); } // u_f, m, where nothing is left
};

struct CohesiveSection {
  double length = 0, area = 0, modulus = 0;                                                   // m, m^2, Pa
  double shear_ratio = 0;                                                                     // k_s / k_n
  double tensile_strength = 0, shear_strength = 0, friction_static = 0, friction_dynamic = 0; // Pa; 0: never
  // As ElastoDamagePlastic::Parameters; 0: brittle.
  double softening_tension = 0, softening_shear = 0, fracture_energy_tension = 0, fracture_energy_shear = 0;
  bool coupled = false; // shares of tension and shear add up
  // Slip and shear force count at arms of the length at rest, not of the present one (theory 2.2).
  bool arms_at_rest = false;
  dem::CompressionBranches compression;

  double normal_stiffness() const { return modulus / length; }                // Pa/m
  double shear_stiffness() const { return shear_ratio * normal_stiffness(); } // Pa/m
  SofteningByHand tension() const;
  SofteningByHand shear(double pressure) const; // Pa, under which it is sheared
  double yield_stress(double closing) const;    // Pa, of closing so far (m) for the first time
  double closing_at(double stress) const;       // m, inverse of the same
};
// Of the one bond of a pair, whose law has to be one of those.
CohesiveSection section_of(const dem::Bonds &bonds);

// One bond on its path. Places are absolute; between them the path is straight and is to end at the kinks.
struct CohesivePlace {
  double opening = 0, slip = 0; // m
  double turn = 0;              // rad, of one sphere against the other
};
struct CohesiveLoad {
  double normal = 0, shear = 0; // N, tension positive; on the driven sphere by its holder
  double moment = 0;            // N m
};

class CohesiveByHand {
public:
  // A slip ratio ties slip to opening (combined path); without one, normal and shear loads are of their own:
  // slip only under compression that stays.
  explicit CohesiveByHand(const CohesiveSection &section, bool combined = false, double slip_ratio = 0);

  // Where on the path from here the lines bend, as shares of it above 0 and below 1, ascending; on both
  // sides of a failure.
  std::vector<double> kinks(const CohesivePlace &to) const;
  void go(const CohesivePlace &to);
  CohesiveLoad load() const { return now_; }
  double stored() const;                                 // J
  double work() const { return work_; }                  // J, area under the lines so far
  double dissipated() const { return work_ - stored(); } // J
  double damage() const { return std::max(tension_damage(), shear_damage()); } // of both directions

private:
  struct Used {
    double tension = 0, shear = 0;
  };
  struct Stresses {
    double normal = 0, cohesion = 0; // Pa
    double friction_share = 0;       // of the slider's stress
  };
  double tension_damage() const;
  double shear_damage() const;
  Used used() const; // combined: of the strengths, at the largest opening so far
  Stresses stresses() const;
  double pressure() const;            // Pa, that closes it now
  double stretch() const;             // m, of the spring of friction at its limit
  double own_slip(double slip) const; // m, what it counts as
  double slip_of(double own) const;   // m, inverse of the same
  void update();

  CohesiveSection section_;
  bool combined_;
  double slip_ratio_;
  CohesivePlace at_;
  CohesiveLoad now_;
  double deepest_ = 0, plastic_ = 0; // m: closing so far, and what of it stays
  double widest_ = 0, farthest_ = 0; // m: opening from where it unloads, slip to either side
  double slider_ = 0;                // m, stretch of the spring of friction
  double work_ = 0;
  bool failed_ = false;
};

} // namespace platen::apps::testing
