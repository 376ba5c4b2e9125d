// The specimen: its tables, the effects that its scene requires, and the stages of one step in order.
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

// Whether the density is that of the grains or that of the solid which they represent, voids included.
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
  std::optional<StrengthScatter> strength_scatter; // none: all bonds have the same strength
  std::optional<Phases> phases;                    // none: all grains are alike
  BondChoice bond_choice;                          // which pairs are bonded; as it is: all within reach

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

// Density of the grains before mass scaling, kg/m^3. For a solid, all spheres together have the mass of the
// specimen's shape filled with it. Throws std::invalid_argument if shape or spheres have no volume.
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
  double strain = 0;                  // of the test, if the test reports one
};

// One step: begin_step, compute_forces, forces of surfaces, end_step. If nothing reads the state between two
// steps, end_and_begin_step does both in one pass, with the same bits.
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
  // Contact search, bonds, breaks and their transfer to contacts, grain contacts. Particle force and torque
  // then contain these and the weight, except what is still in the ghosts. `parallel_loop` runs on free
  // threads: it may read particles but must not write them. Throws NotFinite if the search finds a position
  // that is not finite. With ranks, `done` is called after `parallel_loop`, while work remains.
  void compute_forces(double dt, const Loop &parallel_loop = {}, const std::function<void()> &done = {});
  // Ghosts of bonds and contacts, damping, second half kick; forces are then complete.
  void end_step(double dt);
  void end_and_begin_step(double finished, double next);

  // Without bodies and surfaces; NaN without a ledger. This and the following functions are for the whole
  // specimen: if it is cut, all ranks call them together, after settle().
  EnergyLedger energy() const;
  BondTotals bond_totals() const; // needs bonds
  double unbalanced() const;      // N, sum of the magnitudes of net forces at the end of the last step
  std::size_t touching_count() const;
  std::size_t intact_bonds() const;
  std::vector<double> bond_losses() const; // of all ranks (measure/damage.h); needs bonds
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
  // During a step: breaks up to the step before, so that decisions in a step need not wait for other ranks.
  long known_breaks() const { return known_breaks_; }
  // For the bonds that broke in this step.
  void set_strain_of_cracks(double strain);

  // Cuts the specimen over ranks: from the next step on this rank computes the blocks that the exchange
  // assigns. gather() makes the model complete between steps; the next step cuts it again. settle() sends
  // counts, cracks and records to all ranks. All ranks call these together.
  void share(std::unique_ptr<Exchange> exchange);
  Exchange *exchange() const { return exchange_.get(); } // null: one process
  bool is_cut() const { return cut_; }
  // Visits the sums to which each rank has added its own part since the specimen was cut.
  template <class Visit>
  void visit_sums(const Visit &visit) {
    visit(works.damping), visit(works.weight);
    visit(sums_.damping_work), visit(sums_.weight_work), visit(sums_.kinetic_energy), visit(sums_.unbalanced);
    if (contacts) visit(contacts->friction_work), visit(contacts->damping_work);
  }
  void gather();
  void scatter();
  void settle();
  // Gathers the motion of all particles and does settle(): enough for sums and measures of positions, not for
  // measures of rows of bonds and contacts.
  void gather_motion();
  // To call before all ranks write a state together, each its own rows: drops broken rows and gives the first
  // rank all data that is in no row.
  void settle_state();

private:
  ModelSettings settings_;
  Integrator integrator_;
  KickSums sums_;
  Motion motion_;
  std::vector<BondBreak> breaks_; // of the blocks that were computed since the last finish_breaks()
  std::vector<char> again_;       // marks of blocks to compute again after breaks; or empty
  std::unique_ptr<Exchange> exchange_;
  bool cut_ = false;             // only own rows are up to date
  std::vector<Crack> unsettled_; // of own rows, while the specimen is cut
  long own_breaks_ = 0;          // since the specimen was cut
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
  void compute_bonds(double dt, const BlockList *listed, const Loop &parallel_loop = {});
  void compute_portions(double dt, const BlockList &listed, const Loop &parallel_loop = {});
  void compute_shared(double dt, const Loop &parallel_loop, const std::function<void()> &done);
  void receive_ghosts();
  void add_sums();
  template <class Part>
  Part sum_of_blocks(std::vector<Part> parts) const;
  // Totals of all ranks.
  double total(const ExactSum &sum) const;
  std::size_t total(std::size_t count) const;
  const BlockList *own_blocks() const { return exchange_ ? &exchange_->blocks().all : nullptr; }
  double last_step_ = 0; // s
  Ghosts ghosts() const;
};

} // namespace platen::dem
