// Velocity Verlet with rotation, as the two passes over particles of one step.
#pragma once

#include "dem/bonds.h"
#include "dem/particles.h"

namespace platen::dem {

struct Motion {
  double fastest = 0; // m/s, largest half-step speed
};

// First half kick and drift: v += dt/2 F/m, x += dt v, q = Exp(dt w) q. Forces and torques are set to the
// weight, ready for contacts to add to. Returns the largest speed.
Motion kick_and_drift(Particles &particles, double dt, const Vector3 &gravity);

struct KickSums {
  double damping_work = 0;   // J, lost to local damping in this step
  double kinetic_energy = 0; // J, at full-step velocities
  double unbalanced = 0;     // N, sum of |net force| before damping
  double weight_work = 0;    // J, done by gravity in this step
  KickSums &operator+=(const KickSums &b) {
    damping_work += b.damping_work, kinetic_energy += b.kinetic_energy, unbalanced += b.unbalanced;
    weight_work += b.weight_work;
    return *this;
  }
};

// Adds the bond rows to what contacts left in force and torque, applies local damping F -= alpha |F| sign(v)
// (each component; Cundall), and makes the second half kick. `bonds` may be null. Sums are of all particles.
KickSums gather_and_kick(Particles &particles, const Bonds *bonds, double dt, double local_damping,
                         const Vector3 &gravity);

double kinetic_energy(const Particles &particles);

} // namespace platen::dem
