// Boundaries of the lateral surface of a specimen without a sleeve.
#pragma once

#include "coupling/boundaries/platen.h"
#include "dem/confinement.h"
#include "dem/lateral_wall.h"

namespace platen::coupling {

// The pressure of a cell on the skin of the specimen, without a model of the sleeve.
class SkinPressure : public Boundary {
public:
  // Throws std::invalid_argument where the skin has no area. `bonds` may be null.
  SkinPressure(const dem::Particles &particles, const dem::Bonds *bonds, const dem::Shape &shape,
               const EndPlatens &ends, dem::ConfinementArea area)
      : Boundary("skin_pressure"),
        bonds_(bonds),
        ends_(ends),
        skin_(particles, bonds, shape, ends.planes(), area) {}

  void drift(const Step &, const Command &command) override { prescribed_ = command.pressure; }
  // Before bonds are computed: afterwards ranks no longer have all of them.
  std::size_t prepare(const dem::Particles &particles, const Step &step) override {
    skin_.update(particles, bonds_, ends_.planes(), step.dt, step.farthest, reads_all(step));
    return 0;
  }
  void apply_forces(dem::Particles &particles, const Step &step) override {
    skin_.add_forces(particles, prescribed_, step.dt);
  }
  void add_energy(dem::EnergyLedger &energy) const override { energy.boundary += skin_.work(); }
  double pressure() const override { return skin_.pressure(); }
  double confined_fraction() const override { return skin_.loaded_fraction(); }
  std::optional<std::vector<int>> rows_read() const override { return skin_.particles(); }
  bool reads_all(const Step &step) const override { return step.number % steps_between_skins == 0; }
  long lists_made() const override { return skin_.lists_made(); }
  void describe(Archive &archive) override {
    archive.version(1);
    archive.part("skin", skin_);
  }
  const dem::Confinement &skin() const { return skin_; }

private:
  // Areas of the skin are computed again in every step that is a multiple of this number.
  static constexpr long steps_between_skins = 400;
  const dem::Bonds *bonds_;
  EndPlatens ends_;
  dem::Confinement skin_;
  double prescribed_ = 0; // Pa
};

// A stiff frictionless wall around the specimen, at rest: it keeps the lateral strain at zero.
class LateralWall : public Boundary {
public:
  // As dem::LateralWall; the pressure is the mean over the height between the platens.
  LateralWall(const dem::Particles &particles, const dem::Shape &shape, const EndPlatens &ends,
              double stiffness, double layer)
      : Boundary("wall"), ends_(ends), wall_(particles, shape, stiffness, layer) {}

  void drift(const Step &, const Command &) override {}
  void apply_forces(dem::Particles &particles, const Step &step) override {
    wall_.add_forces(particles, step.farthest);
  }
  void add_springs(const dem::Particles &particles, std::vector<dem::GroundSpring> &springs) override {
    wall_.make_list(particles);
    const std::vector<dem::GroundSpring> own = wall_.ground_springs(particles);
    springs.insert(springs.end(), own.begin(), own.end());
  }
  void add_energy(dem::EnergyLedger &energy) const override { energy.contacts += wall_.elastic_energy(); }
  double pressure() const override {
    const dem::EndPlanes planes = ends_.planes();
    return wall_.pressure(planes.high - planes.low);
  }
  std::optional<std::vector<int>> rows_read() const override { return wall_.particles(); }
  bool reads_all(const Step &step) const override { return wall_.lists_anew(step.farthest); }
  long lists_made() const override { return wall_.lists_made(); }
  void describe(Archive &archive) override { archive.part("springs", wall_); }
  std::size_t seats() const { return wall_.seats(); }

private:
  EndPlatens ends_;
  dem::LateralWall wall_;
};

} // namespace platen::coupling
