#include "coupling/boundaries/skin_pressure.h"

namespace platen::coupling {
namespace {

// Areas of the skin are looked at in every step that is a multiple of this.
constexpr long steps_between_skins = 400;

} // namespace

SkinPressure::SkinPressure(const dem::Particles &particles, const dem::Bonds *bonds, const dem::Shape &shape,
                           const EndPlatens &ends, dem::ConfinementArea area)
    : Boundary("skin_pressure"),
      bonds_(bonds),
      ends_(ends),
      skin_(particles, bonds, shape, ends.planes(), area) {}

void SkinPressure::apply_forces(dem::Particles &particles, const Step &step) {
  skin_.add_forces(particles, bonds_, ends_.planes(), asked_, step.dt, step.farthest,
                   step.number % steps_between_skins == 0);
}

void SkinPressure::describe(Archive &archive) {
  archive.version(1);
  archive.part("skin", skin_);
}

} // namespace platen::coupling
