// Velocity Verlet with rotation, or the dissipative scheme of Tchamwa and Wielgosz, as passes over the
// particles.
#pragma once

#include "base/exact_sum.h"
#include "base/parallel.h"
#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

struct Motion {
  double fastest = 0;     // m/s, largest half-step speed
  ExactSum speed_squares; // m^2/s^2, sum of all; not finite where a velocity is not
};

struct KickSums {
  ExactSum damping_work;   // J, lost to local damping and to the scheme in this step
  ExactSum weight_work;    // J, done by gravity in this step
  ExactSum kinetic_energy; // J, at full-step velocities
  ExactSum unbalanced;     // N, sum of |net force| before damping
};

// Pair blocks whose ghosts are returned at the end of a step; null: none.
struct Ghosts {
  const PairBlocks *bonds = nullptr, *contacts = nullptr;
};

// Local damping of a load F at the velocity v: of each component by itself, F -= alpha |F| sign(v) (Cundall
// 1987), or of the whole vector along the velocity, F -= alpha |F| v/|v|, which does not depend on the axes
// (Onate et al. 2015).
enum class DampingForm { component, vector };

enum class Scheme { velocity_verlet, tchamwa_wielgosz };

// How the particles move, chosen once. Results do not depend on the instruction set.
struct Integrator {
  bool rotation = true;
  double local_damping = 0;  // alpha, of loads and moments; 0: none
  Vector3 gravity;           // m/s^2
  bool energy_ledger = true; // sums of works and energies
  InstructionSet instruction_set = best_instruction_set();
  // phi of Tchamwa and Wielgosz, 1 ... 1.5; 1: velocity Verlet. Above 1 particles need their excess columns
  // (Particles::add_excess).
  double dissipation = 1;
  DampingForm damping_form = DampingForm::component;

  // All functions process the listed blocks if a list is given, otherwise all particles. First half kick and
  // drift: v += dt/2 F/m, x += dt v, q = Exp(dt w) q. With a dissipation phi the velocity of the drift, which
  // `velocity` holds until `end`, is larger by (phi - 1) dt F/m.
  Motion begin(Particles &particles, double dt, const BlockList *listed = nullptr) const;
  // Returns ghosts, applies damping and the second half kick. Forces and torques are then complete and
  // damped. Without a ledger all sums except `unbalanced` are 0.
  KickSums end(Particles &particles, const Ghosts &ghosts, double dt,
               const BlockList *listed = nullptr) const;
  // end(finished), then begin(next), in one pass, with the same bits; forces stay undamped, and kinetic
  // energy and unbalanced force are not summed.
  Motion end_and_begin(Particles &particles, const Ghosts &ghosts, double finished, double next,
                       KickSums &sums, const BlockList *listed = nullptr) const;
};

// Sets force to the weight and torque to zero, for models without bonds.
void set_weight(Particles &particles, const Vector3 &gravity, const BlockList *listed = nullptr);

double kinetic_energy(const Particles &particles);
// J, of each block of particles, or of the listed ones.
std::vector<double> kinetic_energy_of_blocks(const Particles &particles, const BlockList *listed = nullptr);

} // namespace platen::dem
