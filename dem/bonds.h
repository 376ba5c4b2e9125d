// The bonds of a specimen as columns, and one record for every initial bond.
#pragma once

#include <vector>

#include "base/archive.h"
#include "base/exact_sum.h"
#include "base/loop.h"
#include "base/parallel.h"
#include "base/table.h"
#include "dem/bond_choice.h"
#include "dem/instruction_set.h"
#include "dem/laws/bond_law.h"
#include "dem/laws/bond_layout.h"
#include "dem/packing/specimen.h"
#include "dem/pair_blocks.h"
#include "dem/particles.h"

namespace platen::dem {

// 40 P / N_c with the porosity P of the specimen (a fraction) and the mean number N_c of pairs in range per
// sphere: 1 for P = 25 % and N_c = 10 (Onate et al. 2015, eq. 22). Throws BadParameter if there is no pair or
// no porosity.
double packing_factor(const Specimen &specimen, const BondLayout &layout);

enum class BondState : int { intact = 0, damaged = 1, broken_in_tension = 2, broken_in_shear = 3 };

struct BondBreak {
  int row = 0; // in Bonds::table at the time of the break
  BondState mode = BondState::broken_in_tension;
};
struct BrokenBond;
struct BondTotals;

struct Bonds {
  // Computed rows: all intact bonds, and bonds broken since the last compaction (with stiffness 0).
  Table table;
  Column<int> &first = table.add<int>("first", "1");   // particle row i
  Column<int> &second = table.add<int>("second", "1"); // particle row j > i
  Column<int> &record = table.add<int>("record", "1"); // row in `records`
  Column<Vector3> &reference = table.add<Vector3>("reference", "m");
  Column<double> &rest_length = table.add<double>("rest_length", "m", above(0));
  Column<double> &lever = table.add<double>("lever", "1", between(0, 1));
  Column<double> &normal_stiffness = table.add<double>("normal_stiffness", "Pa/m", at_least(0));
  Column<double> &bond_radius = table.add<double>("bond_radius", "m", above(0));
  // Only if bonds differ in strength: factor on both strengths.
  Column<double> *strength_factor = nullptr; // 1
  // Only with dashpots: coefficients along the bond and in bending (0 once broken), times the ratios for
  // shear and torsion; force and moment on the first particle in the last step.
  Column<double> *dashpot = nullptr;         // N s/m
  Column<double> *dashpot_bending = nullptr; // N m s; only with rotation
  double dashpot_shear_ratio = 0, dashpot_twist_ratio = 0;
  Column<Vector3> *dashpot_force = nullptr;  // N
  Column<Vector3> *dashpot_moment = nullptr; // N m; only with rotation

  // One row per initial bond, in the order of creation. Output and measures read these rows.
  Table records;
  Column<int> &record_first = records.add<int>("first", "1");
  Column<int> &record_second = records.add<int>("second", "1");
  Column<int> &state = records.add<int>("state", "1", between(0, 3));            // BondState
  Column<double> &break_time = records.add<double>("break_time", "s", or_nan()); // NaN while intact

  // Only for laws with history: the members of the law's State, in its order. Failed rows then stay.
  std::vector<Column<double> *> memory_scalars;
  std::vector<Column<Vector3> *> memory_vectors;
  std::size_t failed_rows = 0;

  PairBlocks blocks; // of the rows of `table`; ends times kernels::row_stride
  BondLaw law;
  std::size_t broken_rows = 0; // rows of `table` with zero stiffness

  std::vector<std::size_t> in_flaw; // of each flaw: initial bonds that it cut or weakened

  // Bonds all pairs within the layout's reach, or those of the choice; pairs are sorted by (first, second).
  // Throws std::invalid_argument if spheres share a centre, or if the law needs rotation and there is none.
  // None is made across the notch, nor through a flaw that cuts.
  Bonds(const Particles &particles, const BondLayout &layout, const BondParameters &parameters,
        const Notch &notch = {}, const BondChoice &choice = {});

  // Adds dashpots of the fraction alpha of critical to every bond: F = 2 alpha sqrt(K m*) v in parallel with
  // each spring of stiffness K, with the reduced mass m* (inertia for moments). Bonds must be intact.
  void add_dashpots(const Particles &particles, double alpha);
  // Facets: throws BadParameter, with the bond and the size that would do, if the fracture energy of one is
  // not above its elastic energy at its strength.
  void require_ductile(const Particles &particles) const;
  // Adds the column of strength factors, all 1, if there is none.
  void add_strength_factor();
  std::size_t size() const { return table.size(); }
  std::size_t initial_count() const { return records.size(); }
  // Drops broken rows and rebuilds the blocks. Forces and sums stay the same to the last bit.
  void compact();
  // For laws that keep failed rows last: in every block where enough of them stand between others, moves
  // failed rows behind the intact ones, and damaged ones between, if the law keeps those separate. This
  // changes the order of the sums of a block.
  void order_rows();
  // To call when rows of this block have failed or become damaged.
  void look_at_order(std::size_t block);
  // Keeps the rows of the marked blocks of particles and drops the others; records stay.
  void keep_blocks(const std::vector<char> &marked);
  // After rows were put into `table`: counts the broken rows; count_and_cut() also rebuilds the blocks.
  void count_rows();
  void count_and_cut();
  void describe(Archive &archive);
  // Sets the stiffness of these rows to 0, marks their records and returns the state of the bonds.
  std::vector<BrokenBond> break_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                     double time);
  // For laws with history: marks these failed rows and returns the energy dissipated by damage. What they
  // dissipate from now on is friction.
  std::vector<BrokenBond> fail_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                    double time);
  bool has_failed(std::size_t row) const; // broken; with history: damage is 1
  BondResponse<double> response(std::size_t row, const Particles &particles) const;
  double damage(std::size_t row) const;          // 0 ... 1; 0 for laws without history
  bool failed_in_tension(std::size_t row) const; // for laws with history
  // History variables of a row; State is that of its law.
  template <class State>
  State memory(std::size_t row) const;
  template <class State>
  void set_memory(std::size_t row, const State &remembered);
  BondStiffness stiffness(std::size_t row) const; // at rest; 0 once broken
  // Whether kernels copy velocities into the rows of a block.
  bool rows_move() const { return rows_hold_motion_of(law) || dashpot != nullptr; }
  std::size_t bytes() const; // of all columns and of the blocks

private:
  BondGeometry<double> geometry(std::size_t row) const;
  CohesiveGeometry<double> cohesive_geometry(std::size_t row) const;
  // Marks the record of a row that breaks, and returns the state of the bond.
  BrokenBond marked(const BondBreak &, const Particles &particles, double time);
  template <class F>
  auto with_memory(std::size_t row, const F &f) const;
  void add_history();
  // Order of a row in its block: 0 intact, 1 damaged, if the law keeps such rows separate, 2 failed.
  int place(std::size_t row) const;
  bool in_disorder(std::size_t begin, std::size_t end) const;
  std::size_t particles_ = 0;
  bool rotation_ = false;
  std::vector<char> disorder_; // per block of particles; only for laws that keep failed rows last
  void cut_blocks();
  void require_consistent(const StateSource &from, const std::string &at) const;
};

inline Triple<double> triple(const Vector3 &a) {
  return {a.x, a.y, a.z};
}

template <class State>
State Bonds::memory(std::size_t row) const {
  State remembered{};
  std::size_t scalars = 0, vectors = 0;
  State::describe(
      [&](const char *, const char *, auto &member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
          member = (*memory_scalars[scalars++])[row];
        else
          member = triple((*memory_vectors[vectors++])[row]);
      },
      remembered);
  return remembered;
}

template <class State>
void Bonds::set_memory(std::size_t row, const State &remembered) {
  std::size_t scalars = 0, vectors = 0;
  State::describe(
      [&](const char *, const char *, const auto &member) {
        if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
          (*memory_scalars[scalars++])[row] = member;
        else
          (*memory_vectors[vectors++])[row] = {member.x, member.y, member.z};
      },
      remembered);
}

// A bond that has just broken: data for its contact and for the crack log.
struct BrokenBond {
  int first = 0, second = 0, record = 0;
  BondState mode = BondState::broken_in_tension;
  double rest_length = 0, area = 0; // m, m^2
  BondResponse<double> last;        // at the break
  double power = 0;                 // W, rate at which the bond stored energy
  double released = 0;              // J
};

// Sets force and torque of every particle to its weight plus the forces of bonds of its own block; forces of
// bonds of other blocks stay in the ghosts until return_ghosts. On any number of threads. Rows at or above
// their strength are appended to `breaks`, in row order; nothing is broken here. `parallel_loop` runs at the
// same time. Dashpots act at the velocities of the last drift, which took dt. Returns the energy that they
// dissipated in it, J, from the mean of their forces at its two ends (leapfrog). This and the following
// functions process the listed blocks if a list is given, otherwise all blocks.
ExactSum compute_bond_forces(Particles &particles, Bonds &bonds, InstructionSet set, const Vector3 &gravity,
                             double dt, std::vector<BondBreak> &breaks, const Loop &parallel_loop = {},
                             const BlockList *listed = nullptr);
// The same for one block, whose rows have just been broken.
void compute_bond_forces_again(Particles &particles, Bonds &bonds, InstructionSet set, const Vector3 &gravity,
                               std::size_t block);
// Correction of the dissipated energy, J: dashpots of rows that have just been broken no longer act at the
// end of the drift. To call before their blocks are computed again, which overwrites their last forces.
ExactSum undone_work_of_dashpots(const Particles &particles, const Bonds &bonds, double dt,
                                 const std::vector<BondBreak> &breaks);

// The same for bonds with history, which it advances by `dt` at the velocities of the drift. Rows that fail
// in this step are appended to `breaks`, in row order; they are not marked here, and their dashpots stop.
ExactSum compute_cohesive_forces(Particles &particles, Bonds &bonds, InstructionSet set,
                                 const Vector3 &gravity, double dt, std::vector<BondBreak> &breaks,
                                 const Loop &parallel_loop = {}, const BlockList *listed = nullptr);

struct BondTotals {
  double energy = 0; // J
  double force = 0;  // N, sum of the magnitudes of all bond forces
  // J, with history: dissipated by damage of intact bonds, by friction of failed bonds, by yield.
  double damage = 0, friction = 0, plastic = 0;
  BondTotals &operator+=(const BondTotals &b) {
    energy += b.energy, force += b.force;
    damage += b.damage, friction += b.friction, plastic += b.plastic;
    return *this;
  }
};
// Totals of each block of particles, or of the listed ones.
std::vector<BondTotals> bond_totals_of_blocks(const Particles &particles, const Bonds &bonds,
                                              InstructionSet set, const BlockList *listed = nullptr);
// Summed block by block, so that broken rows do not change the last bit.
BondTotals bond_totals(const Particles &particles, const Bonds &bonds,
                       InstructionSet set = best_instruction_set());

} // namespace platen::dem
