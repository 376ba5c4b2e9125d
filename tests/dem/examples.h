// Small models that the tests of the particle library share. SI units.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "base/pi.h"
#include "dem/measure/damage.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"
#include "tests/instruction_sets.h"

namespace platen::dem::examples {

constexpr double radius = 1.3e-3;      // m, of every sphere unless a test says otherwise
constexpr double modulus = 40e9;       // Pa, G_b
constexpr double stiffness_ratio = .4; // k_s / k_n
constexpr double tensile_strength = 9e6, shear_strength = 33e6; // Pa

// Quantities of one bond between equal spheres of `radius`, lambda = 1.
constexpr double area = pi * radius * radius;                          // m^2
constexpr double second_moment = area * radius * radius / 4;           // I, m^4
constexpr double polar_moment = area * radius * radius / 2;            // J, m^4
constexpr double normal_stiffness = modulus / (2 * radius);            // k_n, Pa/m
constexpr double shear_stiffness = stiffness_ratio * normal_stiffness; // k_s, Pa/m

Specimen spheres(std::vector<Vector3> centres, double r = radius);
// Two along x whose gap is this share of their distance.
Specimen pair_of(double first = radius, double second = radius, double gap = 1e-9);
// A simple cubic lattice, of this distance in radii, as a box holds it that stands on z = 0.
Specimen cubic(int along_x, int along_y, int along_z, double distance = 2);
// n + 1 touching spheres in a row along `direction`, the first at the origin.
Specimen row(int bonds, const Vector3 &direction);
// Advancing-front packing of a box of these widths over the sphere radius; Z just below 6.
Specimen packed_box(double x, double y, double z, std::uint64_t seed = 1);

// Unbreakable bonds of the constants above, bonded where spheres touch (gap 1e-6 of the radius), rotation on,
// no contacts, no damping.
ModelSettings bonded();
// The same with beams of modulus E (Pa), Poisson ratio and radius over the mean of the spheres'.
ModelSettings bonded_by_beams(double young, double poisson, double slender);
// Concrete of Onate et al. 2015 (table 5): its interfaces, and those over an interaction range of .1, with
// contacts that have the friction of failed ones.
ElastoDamagePlastic::Parameters cohesive_bond_of_concrete();
ModelSettings interfaces();
// Yielding parallel bonds, of so low a strength in shear that some slide apart, and contacts.
ModelSettings yielding_bonds();
ModelSettings facets();
// Parallel bonds with the strengths above, and contacts of the bond's stiffness with friction .5 and without
// dashpot.
ModelSettings breakable();
// Grains of quartz without bonds, whose contacts have this stiffness (N/m; Hertz' their own), neither
// friction nor dashpot.
ModelSettings unbonded(NormalContact normal, TangentialContact tangential, double stiffness);
// Parameters of settings whose bonds are parallel ones.
ParallelBond::Parameters &parallel_bond(ModelSettings &settings);
// Interfaces that bend and twist.
ModelSettings bending_interfaces();

// Whatever a model may consist of: what is claimed of every model is claimed of each of these.
struct SetUp {
  std::string name;
  ModelSettings settings;
};
void PrintTo(const SetUp &set_up, std::ostream *to);
const std::vector<SetUp> &set_ups();
// A free block that flies apart, `side` radii wide, and cracks.
std::unique_ptr<Model> flying_block(const ModelSettings &settings, double side);

// One whole step. `load` is called where surfaces would act: between forces and second half kick.
template <class Load>
void step(Model &model, double dt, const Load &load) {
  model.begin_step(dt);
  model.compute_forces(dt);
  load(model.particles);
  model.end_step(dt);
}
inline void step(Model &model, double dt, int times = 1) {
  for (int k = 0; k < times; ++k)
    step(model, dt, [](Particles &) {});
}

// Moves both of a pair by hand within a second, from rest and without a kick: the second by `by`, both
// turned.
void move_pair(Model &model, const Vector3 &by, const Vector3 &turn_first = {},
               const Vector3 &turn_second = {});

// Row of the particle that was `id` in the specimen.
std::size_t row_of(const Particles &particles, int id);
// Forces and torques of bonds on every particle by the law, bond by bond; contacts and weight are not in it.
struct Loads {
  std::vector<Vector3> force, torque;
};
Loads bond_loads(const Particles &particles, const Bonds &bonds);
// The same as the step computes it; it replaces what the particles had. Rows at their strength go to
// `breaks`.
Loads kernel_loads(Particles &particles, Bonds &bonds, InstructionSet set, std::vector<BondBreak> &breaks);
inline double bond_energy(const Particles &particles, const Bonds &bonds) {
  return bond_totals(particles, bonds).energy;
}

// Rotation and translation of the whole model: positions, orientations, velocities.
void turn_rigidly(Particles &particles, const Quaternion &turn, const Vector3 &centre);

struct Momentum {
  Vector3 linear, angular;                    // kg m/s, kg m^2/s about the origin, spin included
  double linear_scale = 0, angular_scale = 0; // sums of magnitudes, to compare with
};
Momentum momentum(const Particles &particles);

// Spheres in motion, at random and inwards: some bonds are drawn apart, some slide, some are pressed beyond
// yield. `rate` in 1/s.
void shake(Particles &particles, double speed, double rate = 0);
// Vectors and quaternions of laws.
inline Vector3 vector(const Triple<double> &a) {
  return {a.x, a.y, a.z};
}
inline Rotation<double> rotation(const Quaternion &q) {
  return {q.w, q.x, q.y, q.z};
}

// Breaks the bonds of which this is true by row, in tension; returns how many.
template <class Where>
std::size_t break_rows_where(Bonds &bonds, Particles &particles, const Where &where, double time = 0) {
  std::vector<BondBreak> breaks;
  for (std::size_t k = 0; k < bonds.size(); ++k)
    if (where(k)) breaks.push_back({static_cast<int>(k), BondState::broken_in_tension});
  bonds.break_rows(breaks, particles, time);
  return breaks.size();
}

// The same by where the middle of a bond was at first.
template <class Where>
std::size_t break_where(Bonds &bonds, Particles &particles, const Where &where, double time = 0) {
  return break_rows_where(
      bonds, particles,
      [&](std::size_t k) { return where(reference_midpoint(particles, bonds, bonds.record[k])); }, time);
}

} // namespace platen::dem::examples
