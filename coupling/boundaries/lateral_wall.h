// A stiff frictionless wall around the specimen, at rest: it holds the lateral strain at zero.
#pragma once

#include "coupling/boundaries/platen.h"
#include "dem/lateral_wall.h"

namespace platen::coupling {

class LateralWall : public Boundary {
public:
  // As dem::LateralWall; the pressure is told over the height between the platens.
  LateralWall(const dem::Particles &particles, const dem::Shape &shape, const EndPlatens &ends,
              double stiffness, double layer)
      : Boundary("wall"), ends_(ends), wall_(particles, shape, stiffness, layer) {}

  void drift(const Step &, const Command &) override {}
  void apply_forces(dem::Particles &particles, const Step &step) override {
    wall_.add_forces(particles, step.farthest);
  }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override;
  void add_energy(dem::EnergyLedger &energy) const override { energy.contacts += wall_.elastic_energy(); }
  double pressure() const override;
  void describe(Archive &archive) override { archive.part("springs", wall_); }
  std::size_t seats() const { return wall_.seats(); }

private:
  EndPlatens ends_;
  dem::LateralWall wall_;
};

} // namespace platen::coupling
