// The laws of friction that a platen's contacts may follow, all of a platen the same.
#pragma once

#include <variant>

#include "dem/laws/coulomb_friction.h"
#include "dem/laws/weakening_friction.h"

namespace platen::dem {

using FrictionLaw = std::variant<CoulombFriction, SlipWeakeningFriction, VelocityWeakeningFriction>;

// How friction falls from static to dynamic.
struct Weakening {
  enum class By { nothing, slip, velocity }; // nothing: at once where sliding begins
  By by = By::nothing;
  double slip_length = std::numeric_limits<double>::quiet_NaN();   // m, > 0; by slip
  double slip_velocity = std::numeric_limits<double>::quiet_NaN(); // m/s, > 0; by velocity
};

inline FrictionLaw friction_law(double friction_static, double friction_dynamic, const Weakening &weakening) {
  switch (weakening.by) {
    case Weakening::By::slip:
      return SlipWeakeningFriction{{friction_static, friction_dynamic, weakening.slip_length}};
    case Weakening::By::velocity:
      return VelocityWeakeningFriction{{friction_static, friction_dynamic, weakening.slip_velocity}};
    case Weakening::By::nothing:
      break;
  }
  return CoulombFriction{{friction_static, friction_dynamic}};
}

// One step of a contact by a law that weakens; arguments as those of the laws. Not for inlining: beside it a
// loop over constant friction would lose its registers.
[[gnu::noinline]] inline CoulombFriction::Result slide_weakening(const FrictionLaw &law,
                                                                 CoulombFriction::State &state,
                                                                 const Vector3 &stretch, double normal_force,
                                                                 double tangential_stiffness, double dt) {
  if (const auto *by_slip = std::get_if<SlipWeakeningFriction>(&law))
    return (*by_slip)(state, stretch, normal_force, tangential_stiffness);
  return std::get<VelocityWeakeningFriction>(law)(state, stretch, normal_force, tangential_stiffness, dt);
}

} // namespace platen::dem
