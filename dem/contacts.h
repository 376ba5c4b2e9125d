// Contacts between unbonded spheres: linear or Hertz-Mindlin, with Coulomb friction and rolling resistance.
#pragma once

#include <array>
#include <vector>

#include "dem/bonds.h"
#include "dem/contact_search.h"
#include "dem/instruction_set.h"
#include "dem/laws/contact_settings.h"
#include "dem/pair_blocks.h"
#include "dem/particles.h"

namespace platen::dem {

namespace kernels { // contact_kernel.h
struct ContactColumns;
struct ContactBlock;
struct ContactStep;
struct ContactLoss;
using ContactLoop = ContactLoss (*)(const ContactColumns &, const ContactBlock &, const ContactStep &,
                                    std::size_t first, std::size_t last, int *rows, double *losses);
} // namespace kernels

struct ContactStiffness {
  double normal = 0, tangential = 0; // N/m
};

class Contacts {
public:
  // energy_ledger: sums of what friction and dashpots take. instruction_set: changes no bit.
  Contacts(const Particles &particles, const ContactSettings &settings, const BondLayout &layout,
           bool energy_ledger = true, InstructionSet instruction_set = best_instruction_set());

  // One row per pair that may touch, sorted by (first, second).
  Table table;
  Column<int> &first = table.add<int>("first", "1");
  Column<int> &second = table.add<int>("second", "1");
  Column<double> &rest_distance = table.add<double>("rest_distance", "m", above(0));
  Column<double> &coefficient = table.add<double>("coefficient", "N/m^p", at_least(0));
  Column<int> &touching = table.add<int>("touching", "1", flag());
  Column<double> &overlap = table.add<double>("overlap", "m", at_least(0));
  Column<Vector3> &force = table.add<Vector3>("force", "N"); // on first
  // Only with friction.
  Column<Vector3> *normal = nullptr;              // last unit normal, from first to second
  Column<Vector3> *spring = nullptr;              // tangential force on first, N
  Column<double> *tangential_stiffness = nullptr; // N/m
  Column<int> *sliding = nullptr;
  Column<Vector3> *dashpot = nullptr; // N, on first, in the last step; only with dashpots
  // Only with rolling resistance.
  Column<Vector3> *rolling = nullptr;          // moment on first, N m
  Column<double> *rolling_stiffness = nullptr; // N m

  ExactSum friction_work, damping_work; // J, dissipated so far

  // Brings the rows up to date after a motion of at most `distance` (m) per particle.
  void search(const Particles &particles, const Bonds *bonds, double distance) {
    moved(distance);
    update(particles, bonds);
  }
  // The same in two pieces, with what lies between: whether all particles will be gone through. With a list
  // of blocks, rows are those of pairs whose first particle lies in them.
  void moved(double distance) { search_.moved(distance); }
  bool search_is_wide() const { return search_.wide_due(); }
  void update(const Particles &particles, const Bonds *bonds, const BlockList *listed = nullptr);
  // Rows of the pairs that are close now, so that their number does not depend on when the lists were made.
  void renew_close(const Particles &particles);
  // Forces of all rows from positions and half-step velocities, added to the particles; what leaves a block
  // of particles waits in the ghosts of blocks(). History advances by dt.
  void compute(Particles &particles, double dt, const BlockList *listed = nullptr);
  const PairBlocks &blocks() const { return blocks_; }
  PairBlocks &blocks() { return blocks_; }
  // Of rows and search lists: drops what does not begin in the blocks of particles that are marked.
  void keep_blocks(const std::vector<char> &marked);
  ContactSearch &search_state() { return search_; }
  // After rows were put into `table` from elsewhere.
  void rows_changed() { stale_ = Stale::all; }
  // Takes over the pairs of broken bonds (physics: overlap from min(R_i + R_j, initial distance), shear force
  // kept up to the Coulomb limit) and sets what each released, J, >= 0: bond energy minus what its contact
  // holds, less the work that the two differ by in the half step that leads to the break (the kick at its end
  // is the contact's).
  void take_over(const Particles &particles, const Bonds &bonds, std::vector<BrokenBond> &broken, double dt);
  // J, stored in normal, tangential and rolling springs; added up block by block of particles, so that it
  // does not depend on who has which rows.
  double energy() const;
  std::vector<double> energy_of_blocks(const BlockList *listed = nullptr) const;
  std::size_t touching_count() const;
  // Stiffness of a pair that overlaps by `approach` (m), or soon will: Hertz' law, which has none at
  // touching, is taken at 0.2 % of the smaller radius at least.
  ContactStiffness stiffness_bound(const Particles &particles, int first, int second, double approach) const;

  const ContactSearch &search_state() const { return search_; }
  void describe(Archive &archive);
  const ContactSettings &settings() const { return settings_; }
  // From the next step on; 1, not negative. Of contacts that were made with tangential springs.
  void set_friction(double friction);

private:
  kernels::ContactColumns columns(const Particles &particles);
  kernels::ContactBlock block_of(Particles &particles, std::size_t block);
  kernels::ContactLoop loop_for(bool rotation, bool ledger, InstructionSet set) const;
  void carry_rows(const Particles &particles);
  void add_rows(const Particles &particles, const std::vector<IndexPair> &pairs);
  void begin_row(const Particles &particles, std::size_t k, const IndexPair &pair);
  void cut_blocks(const Particles &particles);
  double coefficient_of(const Particles &particles, int first, int second) const;
  double stored_energy(std::size_t k) const;
  void require_whole(const StateSource &state, const std::string &at) const;
  double start_contact(const Particles &particles, std::size_t k, double dt, BrokenBond &broken);
  Vector3 keep_shear(std::size_t k, double pressing, BrokenBond &broken);

  ContactSettings settings_;
  BondLayout layout_;
  ContactSearch search_;
  std::size_t particles_ = 0;
  double dashpot_ = 0; // fraction of critical
  kernels::ContactLoop loop_ = nullptr;
  PairBlocks blocks_; // of the rows, as far as current
  enum class Stale { none, some, all } stale_ = Stale::all;
  std::vector<char> stale_blocks_; // marked where some are
};

} // namespace platen::dem
