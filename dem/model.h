// The specimen: its tables, the effects that its scene calls for, and the stages of one step in their order.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/archive.h"
#include "base/loop.h"
#include "dem/bonds.h"
#include "dem/contacts.h"
#include "dem/energy.h"
#include "dem/exchange.h"
#include "dem/heterogeneity.h"
#include "dem/integrator.h"
#include "dem/particles.h"
#include "dem/stable_step.h"
#include "dem/stages.h"

namespace platen::dem {

// Whose density is given: that of the grains, or that of the solid which they stand for, voids included.
enum class DensityOf { grains, solid };

struct ModelSettings {
  bool rotation = true;
  double density = 2400; // kg/m^3
  DensityOf density_of = DensityOf::grains;
  double mass_scaling = 1;    // multiplies mass and inertia
  Vector3 gravity;            // m/s^2
  double local_damping = 0.5; // 0 ... 1
  DampingForm damping_form = DampingForm::component;
  bool energy_ledger = true;              // sums of energies and works
  bool crack_log = true;                  // a record of each bond that breaks
  double bond_dashpot = 0;                // fraction of critical
  BondLayout bond_layout;                 // also gives unbonded pairs their stiffness
  std::optional<BondParameters> bond;     // none: no bonds
  std::optional<ContactSettings> contact; // none: spheres pass through each other
  InstructionSet instruction_set = best_instruction_set();
  Scheme scheme = Scheme::velocity_verlet;
  double dissipation = 1.1; // phi of Tchamwa and Wielgosz, 1 ... 1.5; 1: velocity Verlet
  std::optional<StrengthScatter> strength_scatter; // none: all bonds are as strong
  std::optional<Phases> phases;                    // none: all grains are alike

  double phi() const { return scheme == Scheme::tchamwa_wielgosz ? dissipation : 1; } // of the scheme chosen

  static constexpr const char *name = "ModelSettings";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);
};

template <class Visitor, class Self>
void ModelSettings::describe(Visitor &&v, Self &p) {
  v("density", p.density, "kg/m3", above(0), "Density of the grains, or of the solid.");
  v("density_of", p.density_of, Words<DensityOf>{{"grains", DensityOf::grains}, {"solid", DensityOf::solid}},
    "Solid: grains are heavier, so that the specimen with its voids has that density.");
  v("mass_scaling", p.mass_scaling, "1", between(1, 1e6),
    "Factor on all masses; the time step grows by its root, and inertia with it.");
  v("local_damping", p.local_damping, "1", from_to_below(0, 1),
    "Local damping: force against the motion, as a fraction of the unbalanced force.");
  v("damping_form", p.damping_form,
    Words<DampingForm>{{"component", DampingForm::component}, {"vector", DampingForm::vector}},
    "Local damping of each component of a force by itself, or of the whole along the velocity.");
  v("bond_dashpot", p.bond_dashpot, "1", between(0, 1), "Dashpot of the bond, fraction of critical damping.");
  v("scheme", p.scheme,
    Words<Scheme>{{"velocity verlet", Scheme::velocity_verlet},
                  {"tchamwa wielgosz", Scheme::tchamwa_wielgosz}},
    "Tchamwa Wielgosz takes energy from fast oscillations by the drift itself, for slow tests.");
  v("dissipation", p.dissipation, "1", between(1, 1.5),
    "phi: an oscillation of frequency w is damped by (phi - 1) w dt / 2 of critical; 1: none, which is "
    "velocity "
    "Verlet.");
}

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
  int record = 0;                     // of the bond
  double strain = 0;                  // of the test that the specimen is in, where it tells one
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

  // First half kick and drift; time becomes that of the new positions.
  void begin_step(double dt);
  // Contact search, bonds, breaks and their hand-over, grain contacts. Particle force and torque hold them
  // and the weight, but for what waits in the ghosts. `beside` is done too, while threads have hands free: it
  // may read particles but write nothing of theirs. Throws NotFinite where the search meets such a place.
  // On ranks `done` is called once `beside` is, while there is work left.
  void compute_forces(double dt, const Loop &beside = {}, const std::function<void()> &done = {});
  // Ghosts of bonds, damping, second half kick; forces are complete then.
  void end_step(double dt);
  void end_and_begin_step(double finished, double next);

  // Without bodies and surfaces; not numbers without a ledger. This and what follows are of the whole
  // specimen: where it is cut all ranks ask together, after settle().
  EnergyLedger energy() const;
  BondTotals bond_totals() const; // needs bonds
  double unbalanced() const;      // N, sum of the sizes of net forces at the end of the last step
  std::size_t touching_count() const;
  std::size_t intact_bonds() const;
  const KickSums &last_sums() const { return sums_; }
  const Motion &last_motion() const { return motion_; }
  const ModelSettings &settings() const { return settings_; }
  std::vector<Crack> take_cracks();
  std::size_t bytes() const; // of all columns and search lists
  std::size_t broken(BondState mode) const;
  StableStep stable_step(const std::vector<GroundSpring> &ground, double surface_dashpot,
                         double sought_below = std::numeric_limits<double>::infinity()) const;

  void describe(Archive &archive);

  // Sums since the start.
  struct Works {
    ExactSum damping, fracture, weight; // J
  };
  Works works;
  long broken_tension = 0, broken_shear = 0;
  // Up to the step before, where a step is being made: what decides in a step must not wait for other ranks.
  long known_breaks() const { return known_breaks_; }
  // Of the bonds that broke in this step.
  void set_strain_of_cracks(double strain);

  // Cut over ranks: from the next step on this one computes the blocks that the exchange gives it. Between
  // steps the model is whole again after gather(); a step cuts it by itself. settle() makes counts, cracks
  // and records known to all. All ranks call these together.
  void share(std::unique_ptr<Exchange> exchange);
  Exchange *exchange() const { return exchange_.get(); } // null: alone
  bool is_cut() const { return cut_; }
  // Of sums to which each rank has added its own part since the specimen was cut.
  template <class Visit>
  void visit_sums(const Visit &visit) {
    visit(works.damping), visit(works.weight);
    visit(sums_.damping_work), visit(sums_.weight_work), visit(sums_.kinetic_energy), visit(sums_.unbalanced);
    if (contacts) visit(contacts->friction_work), visit(contacts->damping_work);
  }
  void gather();
  void scatter();
  void settle();
  // Motion of all particles, and what settle() does: enough for sums and measures of places, not for those of
  // rows of bonds and contacts.
  void gather_motion();
  // Before a state is written by all ranks together, each its own rows: what is in no row is known to the
  // first rank then, and broken rows are dropped.
  void settle_state();

private:
  ModelSettings settings_;
  Integrator integrator_;
  KickSums sums_;
  Motion motion_;
  std::vector<BondBreak> breaks_; // of the blocks that were computed since the last finish_breaks()
  std::vector<char> again_;       // blocks whose bonds have broken and are to be computed again; or empty
  std::unique_ptr<Exchange> exchange_;
  bool cut_ = false;             // only own rows are up to date
  std::vector<Crack> unsettled_; // of own rows, while the specimen is cut
  long own_breaks_ = 0;          // since it is shared
  long known_breaks_ = 0, breaks_before_sharing_ = 0;
  void finish_breaks(double dt);
  void compute_contacts(double dt, const BlockList *listed);
  void compute_again();
  void compute_block_again(std::size_t block);
  void break_bonds(double dt);
  void note_breaks(const std::vector<BrokenBond> &broken);
  void count(const Crack &crack);
  void begun(double dt);
  void start_exchange(double dt);
  void search_contacts();
  void compute_bonds(double dt, const BlockList *listed, const Loop &beside = {});
  void compute_portions(double dt, const BlockList &listed, const Loop &beside = {});
  void compute_shared(double dt, const Loop &beside, const std::function<void()> &done);
  void receive_ghosts();
  void add_sums();
  template <class Part>
  Part sum_of_blocks(std::vector<Part> parts) const;
  double whole(const ExactSum &sum) const;
  std::size_t whole(std::size_t count) const;
  const BlockList *own_blocks() const { return exchange_ ? &exchange_->blocks().all : nullptr; }
  double last_step_ = 0; // s
  Ghosts ghosts() const;
};

} // namespace platen::dem
