// The bonds of a specimen as columns, and the record of every bond that ever was.
#pragma once

#include <vector>

#include "base/archive.h"
#include "base/exact_sum.h"
#include "base/loop.h"
#include "base/parallel.h"
#include "base/table.h"
#include "dem/instruction_set.h"
#include "dem/laws/bond_law.h"
#include "dem/pair_blocks.h"
#include "dem/particles.h"

namespace platen::dem {

struct Specimen;

enum class RadiusRule { minimum, mean, harmonic, given };

// A length, absolute or as a multiple of the smaller radius of a pair.
struct Gap {
  bool relative = true;
  double value = 0.05; // of the smaller radius, or m
  double length(double smaller_radius) const { return relative ? value * smaller_radius : value; } // m
};

// How bonds are laid between the spheres of a packing.
struct BondLayout {
  double modulus = std::numeric_limits<double>::quiet_NaN(); // G_b, Pa
  double radius_multiplier = 1;                              // lambda
  RadiusRule radius_rule = RadiusRule::minimum;
  double radius = std::numeric_limits<double>::quiet_NaN(); // m, for RadiusRule::given
  Gap gap;                                                  // largest distance of the surfaces of a pair
  bool by_range = false; // instead of the gap: | |d|/(R_i + R_j) - 1 | <= interaction_range
  double interaction_range = 0.1;
  // Of the bond's area, beside lambda's square. 0: 40 P / N_c of the specimen, by Model (Onate et al. 2015).
  double area_factor = 1;

  static constexpr const char *name = "BondLayout";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p);

  double bond_radius(double ri, double rj) const;                                     // R_b, m
  double normal_stiffness(double ri, double rj) const { return modulus / (ri + rj); } // k_n, Pa/m (T-24)
  // k_n A of a pair, whether it is bonded or not; N/m.
  double axial_stiffness(double ri, double rj) const;
  double reach(double ri, double rj) const;           // largest gap that is bonded, m
  double largest_overlap(double ri, double rj) const; // that is bonded, m
};

template <class Visitor, class Self>
void BondLayout::describe(Visitor &&v, Self &p) {
  v("modulus", p.modulus, "Pa", above(0), "Young modulus of the bond.");
  v("radius_multiplier", p.radius_multiplier, "1", above_up_to(0, 10),
    "Bond radius over the radius that the rule gives.");
  v("radius_rule", p.radius_rule,
    Words<RadiusRule>{{"minimum", RadiusRule::minimum},
                      {"mean", RadiusRule::mean},
                      {"harmonic", RadiusRule::harmonic},
                      {"given", RadiusRule::given}},
    "Bond radius from the radii of the pair, or given.");
  v("radius", p.radius, "m", above(0), "Bond radius.");
  v("gap", p.gap,
    "Pairs with at most this distance between their surfaces are bonded; R_min is the smaller radius.");
  v("interaction_range", p.interaction_range, "1", between(0, 1),
    "Pairs whose distance differs from the sum of their radii by at most this share of it are bonded, "
    "instead "
    "of by their gap.");
  v("area_factor", p.area_factor, "1", between(0, 10),
    "Alpha, on the area of the bond; 0: 40 times porosity over mean number of bonds of a sphere.");
}

// 40 P / N_c with the porosity P of the specimen (a share) and the mean number N_c of pairs in range that a
// sphere has: 1 at 25 % and 10 (Onate et al. 2015, eq. 22). Throws BadParameter where there is no pair or no
// porosity.
double packing_factor(const Specimen &specimen, const BondLayout &layout);

enum class BondState : int { intact = 0, damaged = 1, broken_in_tension = 2, broken_in_shear = 3 };

struct BondBreak {
  int row = 0; // in Bonds::table at the time of the break
  BondState mode = BondState::broken_in_tension;
};
struct BrokenBond;
struct BondTotals;

struct Bonds {
  // Rows that are computed: all intact bonds, and those broken since the last compaction (their stiffness is
  // 0).
  Table table;
  Column<int> &first = table.add<int>("first", "1");   // particle row i
  Column<int> &second = table.add<int>("second", "1"); // particle row j > i
  Column<int> &record = table.add<int>("record", "1"); // row in `records`
  Column<Vector3> &reference = table.add<Vector3>("reference", "m");
  Column<double> &rest_length = table.add<double>("rest_length", "m", above(0));
  Column<double> &lever = table.add<double>("lever", "1", between(0, 1));
  Column<double> &normal_stiffness = table.add<double>("normal_stiffness", "Pa/m", at_least(0));
  Column<double> &bond_radius = table.add<double>("bond_radius", "m", above(0));
  // Only where bonds differ in strength: factor of both strengths.
  Column<double> *strength_factor = nullptr; // 1
  // Only with dashpots: their coefficients (0 once broken) along the bond and in bending, times the ratios in
  // shear and torsion; and what they exerted on the first particle in the last step.
  Column<double> *dashpot = nullptr;         // N s/m
  Column<double> *dashpot_bending = nullptr; // N m s; only with rotation
  double dashpot_shear_ratio = 0, dashpot_twist_ratio = 0;
  Column<Vector3> *dashpot_force = nullptr;  // N
  Column<Vector3> *dashpot_moment = nullptr; // N m; only with rotation

  // One row per initial bond, in the order of creation: what output and measures read.
  Table records;
  Column<int> &record_first = records.add<int>("first", "1");
  Column<int> &record_second = records.add<int>("second", "1");
  Column<int> &state = records.add<int>("state", "1", between(0, 3));            // BondState
  Column<double> &break_time = records.add<double>("break_time", "s", or_nan()); // NaN while intact

  // Only where bonds remember: the members of the law's State, in its order. Rows then stay when they have
  // failed.
  std::vector<Column<double> *> memory_scalars;
  std::vector<Column<Vector3> *> memory_vectors;
  std::size_t failed_rows = 0;

  PairBlocks blocks; // of the rows of `table`, ends times kernels::row_stride
  BondLaw law;
  std::size_t broken_rows = 0; // rows of `table` with zero stiffness

  // Bonds all pairs within the layout's reach; pairs are sorted by (first, second). Throws
  // std::invalid_argument where spheres share a centre, or where the law needs spheres that turn and these do
  // not.
  Bonds(const Particles &particles, const BondLayout &layout, const BondParameters &parameters);

  // Dashpots of the fraction alpha of critical in every bond: F = 2 alpha sqrt(K m*) v beside each spring of
  // stiffness K, with the reduced mass m*, or inertia for moments. Bonds must be intact.
  void add_dashpots(const Particles &particles, double alpha);
  // Strength factors of 1, to be changed.
  void add_strength_factor();
  std::size_t size() const { return table.size(); }
  std::size_t initial_count() const { return records.size(); }
  // Drops broken rows and cuts the blocks anew. Forces on particles do not change by a bit, nor does any sum.
  void compact();
  // Of laws that keep failed rows last: puts them behind the whole ones in every block where enough of them
  // stand among these. Sums of a block are then added in another order.
  void order_failed();
  // Keeps the rows of the blocks of particles that are marked, and drops the others; the records stay.
  void keep_blocks(const std::vector<char> &marked);
  // After rows were put into `table` from elsewhere: counts the broken ones; and cuts the blocks.
  void count_rows();
  void count_and_cut();
  void describe(Archive &archive);
  // Takes the stiffness from these rows, marks their records and tells what they held.
  std::vector<BrokenBond> break_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                     double time);
  // Of bonds that remember: marks these rows, which have failed, and tells what damage took from them. What
  // they dissipate from now on is friction.
  std::vector<BrokenBond> fail_rows(const std::vector<BondBreak> &breaks, const Particles &particles,
                                    double time);
  bool has_failed(std::size_t row) const; // broken, or of those that remember
  BondResponse<double> response(std::size_t row, const Particles &particles) const;
  double damage(std::size_t row) const;          // 0 ... 1; of laws without history 0
  bool failed_in_tension(std::size_t row) const; // of bonds that remember
  // What a row remembers; State is that of its law.
  template <class State>
  State memory(std::size_t row) const;
  template <class State>
  void set_memory(std::size_t row, const State &remembered);
  BondStiffness stiffness(std::size_t row) const; // at rest; 0 once broken
  // Whether kernels copy velocities into the rows of a block.
  bool rows_move() const { return law_reads_motion(law) || dashpot != nullptr; }
  std::size_t bytes() const; // of all columns and of the blocks

private:
  BondGeometry<double> geometry(std::size_t row) const;
  CohesiveGeometry<double> cohesive_geometry(std::size_t row) const;
  // Marks the record of a row that breaks, and tells what the row holds.
  BrokenBond marked(const BondBreak &, const Particles &particles, double time);
  template <class F>
  auto with_memory(std::size_t row, const F &f) const;
  void add_history();
  struct Failed { // rows of a block
    int all = 0;
    int last = 0; // of them, behind the last whole one
  };
  void count_last(Failed &failed, std::size_t begin, std::size_t end) const;
  std::size_t particles_ = 0;
  bool rotation_ = false;
  std::vector<Failed> failed_; // of each block of particles; of laws that keep failed rows last
  void cut_blocks();
  void require_whole(const StateSource &from, const std::string &at) const;
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

// A bond that has just broken: what the contact takes over, and what the crack log needs.
struct BrokenBond {
  int first = 0, second = 0, record = 0;
  BondState mode = BondState::broken_in_tension;
  double rest_length = 0, area = 0; // m, m^2
  BondResponse<double> last;        // at the break
  double power = 0;                 // W, rate at which the bond was taking up energy
  double released = 0;              // J
};

// Sets force and torque of every particle to its weight and the bonds of its own block; what bonds bring from
// other blocks waits in the ghosts, for return_ghosts. On any number of threads. Rows at or above their
// strength are appended to `breaks`, in row order; nothing is broken here. `beside` is done at the same time.
// Dashpots act too, where there are any, at the velocities of the last drift, which took dt. Returns the
// energy that they took in it, J: by the mean of their forces at its two ends, as the leapfrog sees it. This
// and what follows go through the blocks that are listed, where a list is given, and through all else.
ExactSum compute_bond_forces(Particles &particles, Bonds &bonds, InstructionSet set, const Vector3 &gravity,
                             double dt, std::vector<BondBreak> &breaks, const Loop &beside = {},
                             const BlockList *listed = nullptr);
// The same again for one block, whose rows have just been broken.
void compute_bond_forces_again(Particles &particles, Bonds &bonds, InstructionSet set, const Vector3 &gravity,
                               std::size_t block);
// What is to be added to the energy, J: at the end of the drift the dashpots of rows that have just been
// broken act no more. To be asked before their blocks are computed again, which overwrites their last forces.
ExactSum undone_work_of_dashpots(const Particles &particles, const Bonds &bonds, double dt,
                                 const std::vector<BondBreak> &breaks);

// The same for bonds that remember, which it brings `dt` further, at the velocities of the drift. Rows that
// have failed in this step are appended to `breaks`, in row order; they are not marked here, and their
// dashpots act no more.
ExactSum compute_cohesive_forces(Particles &particles, Bonds &bonds, InstructionSet set,
                                 const Vector3 &gravity, double dt, std::vector<BondBreak> &breaks,
                                 const Loop &beside = {}, const BlockList *listed = nullptr);

struct BondTotals {
  double energy = 0; // J
  double force = 0;  // N, sum of the sizes of all bonds' forces
  // J, of bonds that remember: taken by damage of those that hold, by friction of those that failed, by
  // yield.
  double damage = 0, friction = 0, plastic = 0;
  BondTotals &operator+=(const BondTotals &b) {
    energy += b.energy, force += b.force;
    damage += b.damage, friction += b.friction, plastic += b.plastic;
    return *this;
  }
};
// Of each block of particles, or of those that are listed.
std::vector<BondTotals> bond_totals_of_blocks(const Particles &particles, const Bonds &bonds,
                                              InstructionSet set, const BlockList *listed = nullptr);
// Added up block by block, so that rows that are broken do not show in the last bit.
BondTotals bond_totals(const Particles &particles, const Bonds &bonds,
                       InstructionSet set = best_instruction_set());

} // namespace platen::dem
