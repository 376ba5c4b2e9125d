// The friction laws of platen contacts; all contacts of a platen follow the same law.
#pragma once

#include <variant>

#include "base/describe.h"
#include "dem/laws/coulomb_friction.h"
#include "dem/laws/weakening_friction.h"

namespace platen::dem {

using FrictionLaw = std::variant<CoulombFriction, SlipWeakeningFriction, VelocityWeakeningFriction>;

// How friction decreases from static to dynamic.
struct Weakening {
  enum class By { nothing, slip, velocity }; // nothing: at once where sliding begins
  By by = By::nothing;
  double slip_length = not_given;   // m, > 0; by slip
  double slip_velocity = not_given; // m/s, > 0; by velocity
};

struct SurfaceFriction {
  double friction_static = 0;          // 1, >= 0; zero: frictionless; infinity: never slides
  double friction_dynamic = not_given; // 1; not given: as the static one
  Weakening weakening{};               // from static to dynamic

  double dynamic() const { return std::isnan(friction_dynamic) ? friction_static : friction_dynamic; }

  static constexpr const char *name = "friction";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

template <class Visitor, class Self>
void SurfaceFriction::describe(Visitor &&v, Self &p) {
  v("friction_static", p.friction_static, "1", between(0, 5),
    "Coefficient of friction of grains on both platens while they stick.");
  v("friction_dynamic", p.friction_dynamic, "1", between(0, 5),
    "The same while they slide; as the static one where not given.");
  v("friction_law", p.weakening.by,
    Words<Weakening::By>{{"constant", Weakening::By::nothing},
                         {"slip weakening", Weakening::By::slip},
                         {"velocity weakening", Weakening::By::velocity}},
    "How friction falls from static to dynamic. Constant: at once, and back at rest; slip weakening: dynamic "
    "+ (static - dynamic) s0 / (s0 + s), s the path that the contact has slid (Cusatis et al. 2011); "
    "velocity weakening: dynamic + (static - dynamic) exp(-v / v0), v its speed (Andersson et al. 2007).");
  v("slip_length", p.weakening.slip_length, "m", above(0), "s0: the slip that takes half (Friction law).");
  v("slip_velocity", p.weakening.slip_velocity, "m/s", above(0), "v0 (Friction law).");
}

inline FrictionLaw friction_law(const SurfaceFriction &f) {
  switch (f.weakening.by) {
    case Weakening::By::slip:
      return SlipWeakeningFriction{{f.friction_static, f.dynamic(), f.weakening.slip_length}};
    case Weakening::By::velocity:
      return VelocityWeakeningFriction{{f.friction_static, f.dynamic(), f.weakening.slip_velocity}};
    case Weakening::By::nothing:
      break;
  }
  return CoulombFriction{{f.friction_static, f.dynamic()}};
}

// One step of a contact by a weakening law; arguments as those of the laws. Not inlined: a loop over constant
// friction would otherwise lose its registers.
[[gnu::noinline]] inline CoulombFriction::Result slide_weakening(const FrictionLaw &law,
                                                                 CoulombFriction::State &state,
                                                                 const Vector3 &stretch, double normal_force,
                                                                 double tangential_stiffness, double dt) {
  if (const auto *by_slip = std::get_if<SlipWeakeningFriction>(&law))
    return (*by_slip)(state, stretch, normal_force, tangential_stiffness);
  return std::get<VelocityWeakeningFriction>(law)(state, stretch, normal_force, tangential_stiffness, dt);
}

} // namespace platen::dem
