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

// Friction of a surface.
struct SurfaceFriction {
  double friction_static = 0;  // 1, >= 0; infinity: never slides
  double friction_dynamic = 0; // 1; both zero: frictionless
  Weakening weakening{};       // from static to dynamic
};

inline FrictionLaw friction_law(const SurfaceFriction &f) {
  switch (f.weakening.by) {
    case Weakening::By::slip:
      return SlipWeakeningFriction{{f.friction_static, f.friction_dynamic, f.weakening.slip_length}};
    case Weakening::By::velocity:
      return VelocityWeakeningFriction{{f.friction_static, f.friction_dynamic, f.weakening.slip_velocity}};
    case Weakening::By::nothing:
      break;
  }
  return CoulombFriction{{f.friction_static, f.friction_dynamic}};
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
