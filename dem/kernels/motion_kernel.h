// Block kernels of the motion: the two half kicks, damping, drift and their energy sums in one pass over the
// particles. One source, compiled once per instruction set (motion_kernel.inc.h), with bitwise equal results.
#pragma once

#include <cstddef>

#include "base/vector3.h"

namespace platen::dem::kernels {

struct MotionColumns {
  Vector3 *position, *velocity, *force;
  const double *mass;
  // Only with rotation.
  Quaternion *orientation;
  Vector3 *angular_velocity, *torque;
  const double *inertia;
  // Only with a dissipative scheme; the second only with rotation too.
  Vector3 *excess_velocity, *excess_spin;
};

enum class LocalDamping { none, component, vector };

// Coefficients of a pass. Optional effects are branches that all rows take alike, not separate loops
// (bench/results/effects.md lists their cost).
struct MotionStep {
  double finished = 0; // s, of the step that the second half kick ends
  double next = 0;     // s, of the step that the first half kick and the drift begin
  LocalDamping damping = LocalDamping::none;
  double local_damping = 0; // alpha
  bool energy_sums = true;  // damping_work and kinetic_energy
  bool weight_sum = false;  // weight_work
  Vector3 gravity;          // m/s^2
  double excess = 0;        // phi - 1 of a dissipative scheme
};

// Parts of a step that a pass does.
enum class Halves { end, begin, end_and_begin };

struct MotionSums {
  double damping_work = 0;   // J, lost to local damping and to the scheme in the finished step
  double weight_work = 0;    // J, done by gravity in it
  double unbalanced = 0;     // N, sum of |net force| before damping; only Halves::end, also without energies
  double kinetic_energy = 0; // J, at full-step velocities; only Halves::end
  double speed_squares = 0;  // m^2/s^2, sum at the half step; not finite where a velocity is not
  double fastest_square = 0; // m^2/s^2, the largest of them
};

// Effects with columns of their own; each combination is a separate loop.
struct MotionEffects {
  bool rotation = false;
  bool dissipative = false; // drifts by an excess over the half-step velocity
};

// Passed by value: stores to columns cannot change a step, so that it stays in registers.
using MotionKernel = MotionSums (*)(MotionColumns, MotionStep, std::size_t first, std::size_t last);
MotionKernel motion_kernel_baseline(Halves, const MotionEffects &);
MotionKernel motion_kernel_avx2(Halves, const MotionEffects &);
MotionKernel motion_kernel_avx512(Halves, const MotionEffects &);

} // namespace platen::dem::kernels
