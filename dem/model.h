// The specimen: its tables, the effects that its scene calls for, and the stages of one step in their order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dem/bonds.h"
#include "dem/contacts.h"
#include "dem/energy.h"
#include "dem/integrator.h"
#include "dem/loop.h"
#include "dem/particles.h"
#include "dem/phases.h"
#include "dem/stable_step.h"
#include "dem/stages.h"
#include "dem/strength_scatter.h"

namespace platen::dem {

// Whose density is given: that of the grains, or that of the solid which they stand for, voids included.
enum class DensityOf { grains, solid };

struct ModelSettings {
  bool rotation = true;
  double density = 2400;    // kg/m^3
  double mass_scaling = 1;  // multiplies mass and inertia
  Vector3 gravity;          // m/s^2
  double local_damping = 0; // 0 ... 1
  DampingForm damping_form = DampingForm::component;
  bool energy_ledger = true;              // sums of energies and works
  bool crack_log = true;                  // a record of each bond that breaks
  double bond_dashpot = 0;                // fraction of critical
  BondLayout bond_layout;                 // also gives unbonded pairs their stiffness
  std::optional<BondParameters> bond;     // none: no bonds
  std::optional<ContactSettings> contact; // none: spheres pass through each other
  InstructionSet instruction_set = best_instruction_set();
  double dissipation = 1; // phi of Tchamwa and Wielgosz, 1 ... 1.5; 1: velocity Verlet
  DensityOf density_of = DensityOf::grains;
  std::optional<StrengthScatter> strength_scatter; // none: all bonds are as strong
  std::optional<Phases> phases;                    // none: all grains are alike
};

// Density of the grains before mass scaling, kg/m^3: of a solid, such that all spheres together weigh what
// the specimen's shape filled with it weighs. Throws std::invalid_argument where that shape has no volume.
double grain_density(const Specimen &specimen, double density, DensityOf of);

// One bond failure, for the crack log.
struct Crack {
  double time = 0;       // s
  Vector3 point, normal; // m, 1: middle of the bond, from first to second particle
  double area = 0;       // m^2
  BondState mode = BondState::broken_in_tension;
  double energy = 0;                  // J, released
  int particle_a = 0, particle_b = 0; // input ids
};

// One step: begin_step, forces, then surfaces add to particles, then end_step. Between steps whose end nobody
// looks at, end_and_begin_step does both in one pass, to the same bits.
class Model {
public:
  Model(const Specimen &specimen, const ModelSettings &settings);

  Particles particles;
  std::unique_ptr<Bonds> bonds;       // null without bonds
  std::unique_ptr<Contacts> contacts; // null without contacts
  StageClock clock;

  double time = 0;           // s
  long breaks = 0;           // in the last step
  std::vector<Crack> cracks; // since the last call of take_cracks

  // First half kick, drift, contact search; time becomes that of the new positions.
  void begin_step(double dt);
  // Bonds, breaks and their hand-over, grain contacts. Particle force and torque hold them and the weight,
  // but for what waits in the bonds' ghosts. `beside` is done too, while threads have hands free: it may read
  // particles but write nothing of theirs.
  void compute_forces(double dt, const Loop &beside = {});
  // Ghosts of bonds, damping, second half kick; forces are complete then.
  void end_step(double dt);
  void end_and_begin_step(double finished, double next);

  EnergyLedger energy() const; // without bodies and surfaces; not numbers without a ledger
  const KickSums &last_sums() const { return sums_; }
  const Motion &last_motion() const { return motion_; }
  const ModelSettings &settings() const { return settings_; }
  std::vector<Crack> take_cracks();
  std::size_t intact_bonds() const;
  std::size_t bytes() const; // of all columns and search lists
  std::size_t broken(BondState mode) const;
  StableStep stable_step(const std::vector<GroundSpring> &ground, double surface_dashpot) const;

  // Sums that a checkpoint keeps.
  struct Works {
    double damping = 0, fracture = 0, weight = 0; // J
  };
  Works works;
  long broken_tension = 0, broken_shear = 0;

private:
  ModelSettings settings_;
  Integrator integrator_;
  KickSums sums_;
  Motion motion_;
  std::vector<BondBreak> breaks_;
  void break_bonds(double dt);
  void note_breaks(const std::vector<BrokenBond> &broken);
  void begun(double dt);
  Ghosts ghosts() const;
};

} // namespace platen::dem
