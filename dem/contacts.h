// Contacts between unbonded spheres: linear or Hertz-Mindlin, with Coulomb friction and rolling resistance.
#pragma once

#include <algorithm>
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
                                    int *rows, double *losses);
} // namespace kernels

struct ContactStiffness {
  double normal = 0, tangential = 0; // N/m
};

class Contacts {
public:
  // energy_ledger: sum the energy lost to friction and dashpots. instruction_set: does not change results.
  Contacts(const Particles &particles, const ContactSettings &settings, const BondLayout &layout,
           bool energy_ledger = true, InstructionSet instruction_set = best_instruction_set());

  // One row per pair that may touch, sorted by (first, second), except rows of bonds broken since
  // sort_rows().
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

  // Updates the rows after a motion of at most `distance` (m) per particle.
  void search(const Particles &particles, const Bonds *bonds, double distance) {
    moved(distance);
    update(particles, bonds);
  }
  // The same in two parts; search_is_wide() returns whether update() will search all particles. With a list
  // of blocks, rows are those of pairs whose first particle lies in them.
  void moved(double distance) { search_.moved(distance); }
  bool search_is_wide() const { return search_.wide_due(); }
  void update(const Particles &particles, const Bonds *bonds, const BlockList *listed = nullptr);
  // Makes rows of the pairs that are close now: their number then does not depend on earlier searches.
  void renew_close(const Particles &particles);
  // Adds the forces of all rows, from positions and half-step velocities, to the particles; forces on other
  // blocks stay in the ghosts of blocks(). History advances by dt. before(block), if given, is called before
  // the contacts of each block are added.
  void compute(Particles &particles, double dt, const BlockList *listed = nullptr, const Loop &before = {});
  // Calls visit(row) for the rows whose first particle lies in a block, in the order of their pairs.
  template <class Visit>
  void for_rows_of_block(std::size_t block, const Visit &visit) const;
  const PairBlocks &blocks() const { return blocks_; }
  PairBlocks &blocks() { return blocks_; }
  // Drops rows and search-list pairs whose first particle is not in a marked block.
  void keep_blocks(const std::vector<char> &marked);
  ContactSearch &search_state() { return search_; }
  // To call after sorted rows were put into `table` from elsewhere.
  void rows_changed() {
    stale_ = Stale::all;
    added_.clear();
    added_rows_ = 0;
  }
  // Takes over the pairs of broken bonds (overlap from min(R_i + R_j, initial distance), shear force kept up
  // to the Coulomb limit) and sets the energy that each bond released, J, >= 0: bond energy minus contact
  // energy, minus the difference of their works in the half step before the break (the kick at its end uses
  // the contact force). `sorted`: the new rows are sorted at once.
  void take_over(const Particles &particles, const Bonds &bonds, std::vector<BrokenBond> &broken, double dt,
                 bool sorted = false);
  // J, stored in normal, tangential and rolling springs; summed block by block of particles, so that it does
  // not depend on which rank has which rows.
  double energy() const;
  std::vector<double> energy_of_blocks(const BlockList *listed = nullptr) const;
  std::size_t touching_count() const;
  // Stiffness of a pair that overlaps by `approach` (m) or soon will. The overlap is at least 0.2 % of the
  // smaller radius, because Hertz' law has no stiffness at zero overlap.
  ContactStiffness stiffness_bound(const Particles &particles, int first, int second, double approach) const;

  const ContactSearch &search_state() const { return search_; }
  void describe(Archive &archive);
  const ContactSettings &settings() const { return settings_; }
  // Friction coefficient from the next step on, >= 0. Only for contacts made with tangential springs.
  void set_friction(double friction);

private:
  kernels::ContactColumns columns(const Particles &particles);
  kernels::ContactBlock block_of(Particles &particles, std::size_t block);
  kernels::ContactLoop loop_for(bool rotation, bool ledger, InstructionSet set) const;
  void carry_rows(const Particles &particles);
  void add_row(const Particles &particles, const IndexPair &pair);
  IndexPair pair_of(int row) const {
    return {first[static_cast<std::size_t>(row)], second[static_cast<std::size_t>(row)]};
  }
  bool comes_before(int row, const IndexPair &pair) const { return pair_of(row) < pair; }
  std::vector<int> rows_in_order() const;
  void sort_rows();
  std::size_t sorted_rows() const { return table.size() - added_rows_; }
  std::size_t place_of(const IndexPair &pair) const;
  void begin_row(const Particles &particles, std::size_t k, const IndexPair &pair);
  void cut_blocks(const Particles &particles);
  double coefficient_of(const Particles &particles, int first, int second) const;
  double stored_energy(std::size_t k) const;
  void require_consistent(const StateSource &state, const std::string &at) const;
  double start_contact(const Particles &particles, std::size_t k, double dt, BrokenBond &broken);
  Vector3 keep_shear(std::size_t k, double pressing, BrokenBond &broken);

  ContactSettings settings_;
  BondLayout layout_;
  ContactSearch search_;
  std::size_t particles_ = 0;
  double dashpot_ = 0; // fraction of critical
  kernels::ContactLoop loop_ = nullptr;
  PairBlocks blocks_; // of the rows, where not stale
  enum class Stale { none, some, all } stale_ = Stale::all;
  std::vector<char> stale_blocks_;      // marks of the stale blocks, for Stale::some
  std::vector<std::vector<int>> added_; // per block: rows behind the sorted ones, in order; or empty
  std::size_t added_rows_ = 0;
};

template <class Visit>
void Contacts::for_rows_of_block(std::size_t block, const Visit &visit) const {
  const auto row_of_particle = [&](std::size_t particle) {
    const auto end = first.begin() + static_cast<std::ptrdiff_t>(sorted_rows());
    return static_cast<std::size_t>(std::lower_bound(first.begin(), end, static_cast<int>(particle)) -
                                    first.begin());
  };
  std::size_t row = row_of_particle(block * block_rows);
  const std::size_t end = row_of_particle((block + 1) * block_rows);
  if (!added_.empty())
    for (const int added : added_[block]) {
      for (const IndexPair pair = pair_of(added); row < end && comes_before(static_cast<int>(row), pair);
           ++row)
        visit(row);
      visit(static_cast<std::size_t>(added));
    }
  for (; row < end; ++row)
    visit(row);
}

} // namespace platen::dem
