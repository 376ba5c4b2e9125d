// The pressure of a cell on the skin of the specimen, where the sleeve itself is left out.
#pragma once

#include "coupling/boundaries/platen.h"
#include "dem/confinement.h"

namespace platen::coupling {

class SkinPressure : public Boundary {
public:
  // Throws std::invalid_argument where the skin has no area. `bonds` may be null.
  SkinPressure(const dem::Particles &particles, const dem::Bonds *bonds, const dem::Shape &shape,
               const EndPlatens &ends, dem::ConfinementArea area);

  void drift(const Step &, const Command &command) override { asked_ = command.pressure; }
  void apply_forces(dem::Particles &particles, const Step &step) override;
  void add_energy(dem::EnergyLedger &energy) const override { energy.boundary += skin_.work(); }
  double pressure() const override { return skin_.pressure(); }
  void describe(Archive &archive) override;
  const dem::Confinement &skin() const { return skin_; }

private:
  const dem::Bonds *bonds_;
  EndPlatens ends_;
  dem::Confinement skin_;
  double asked_ = 0; // Pa
};

} // namespace platen::coupling
