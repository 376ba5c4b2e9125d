// What an elasto-damage-plastic bond between two spheres does that are moved from place to place, by hand:
// strengths, displacements and fracture energies of theory 2.6 as straight lines, of which the law itself
// knows nothing.
#pragma once

#include <algorithm>
#include <vector>

#include "dem/laws/elasto_damage_plastic.h"

namespace platen::apps {

// Linear softening of one direction. SI units, stresses.
struct SofteningByHand {
  double strength = 0;  // Pa; infinite where it never fails
  double stiffness = 0; // Pa/m
  double softening = 0; // u_f / u_l - 1

  double limit() const { return strength / stiffness; }    // u_l, m, where damage begins
  double end() const { return limit() * (1 + softening); } // u_f, m, where nothing is left
  // J/m^2, area under the softening branch.
  double fracture_energy() const { return 0.5 * strength * (end() - limit()); }
};

struct InterfaceSection {
  dem::ElastoDamagePlastic law;
  double length = 0, area = 0, modulus = 0; // m, m^2, Pa

  double normal_stiffness() const { return modulus / length; } // Pa/m
  double shear_stiffness() const {
    return 0.5 * normal_stiffness() / (1 + law.parameters.poisson_ratio);
  } // Pa/m
  SofteningByHand tension() const;
  SofteningByHand shear(double pressure) const; // Pa, under which it is sheared
  double yield_stress(double closing) const;    // Pa, of closing so far (m) for the first time
  double closing_at(double stress) const;       // m, inverse of the same
};

// One bond on its path. Places are absolute; between them the path is straight and is to end at the kinks.
struct InterfacePlace {
  double opening = 0, slip = 0; // m
};
struct InterfaceLoad {
  double normal = 0, shear = 0; // N, tension positive; on the driven sphere by its holder
};

class InterfaceByHand {
public:
  // A slip ratio ties slip to opening (combined path); without one, normal and shear loads are of their own:
  // slip only under compression that stays.
  explicit InterfaceByHand(const InterfaceSection &section, bool combined = false, double slip_ratio = 0);

  // Where on the path from here the lines bend, as shares of it above 0 and below 1, ascending; on both
  // sides of a failure.
  std::vector<double> kinks(const InterfacePlace &to) const;
  void go(const InterfacePlace &to);
  InterfaceLoad load() const { return now_; }
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
  double pressure() const; // Pa, that closes it now
  void update();

  InterfaceSection section_;
  bool combined_;
  double slip_ratio_;
  InterfacePlace at_;
  InterfaceLoad now_;
  double deepest_ = 0, plastic_ = 0; // m: closing so far, and what of it stays
  double widest_ = 0, farthest_ = 0; // m: opening from where it unloads, slip to either side
  double slider_ = 0;                // m, stretch of the spring of friction
  double work_ = 0;
  bool failed_ = false;
};

} // namespace platen::apps
