// Contacts between grains in SIMD vectors: selection of the active rows of a step, because most near pairs do
// not touch, and their forces. One source, compiled once per instruction set (contact_kernel.inc.h), with
// results equal to the last bit.
#pragma once

#include <cstddef>

#include "base/vector3.h"
#include "dem/laws/contact_settings.h"
#include "dem/pair_blocks.h"

namespace platen::dem::kernels {

// Columns of rows and of particles, each with one row to spare.
struct ContactColumns {
  const int *first, *second;                 // of each row
  const double *rest_distance, *coefficient; // m, N/m^p
  int *touching;
  double *overlap; // m
  Vector3 *force;  // N, on first
  // With friction: unit normal and tangential force (N) of the last step; stiffness in N/m.
  Vector3 *normal, *spring;
  double *tangential_stiffness;
  int *sliding;
  // With rolling resistance: N m.
  Vector3 *rolling;
  double *rolling_stiffness;
  Vector3 *dashpot; // N, with dashpots
  // Of particles; angular velocity only with rotation.
  const Vector3 *position, *velocity, *angular_velocity;
  const double *radius, *mass;
};

// Rows of a block of particles, and the targets of their forces: the block's particles and its ghosts.
struct ContactBlock {
  std::size_t first_pair, end_pair; // rows
  const int *added;                 // rows beyond these, in the order of their pairs
  std::size_t added_count;
  int own; // particles
  const PairBlocks::Ends *ends;
  Vector3 *force, *torque; // of all particles; torque null without rotation
  Vector3 *ghost_force, *ghost_torque;
};

struct ContactStep {
  double dt = 0;                             // s
  double friction = 0, rolling_friction = 0; // 1
  double tangential_ratio = 0;               // k_t / k_n, for laws with variable stiffness
  double dashpot = 0;                        // fraction of critical
};

// Effects of a loop; each combination is a separate loop. Dashpots are a column that may be null.
struct ContactEffects {
  NormalContact normal = NormalContact::linear;
  TangentialContact tangential = TangentialContact::coulomb;
  bool rotation = true;
  bool ledger = true; // sums of lost energies
};

struct ContactLoss {
  double friction = 0, damping = 0; // J
};

// Computes one block: `rows` has space for all its rows, `losses` for three times as many.
using ContactLoop = ContactLoss (*)(const ContactColumns &, const ContactBlock &, const ContactStep &,
                                    int *rows, double *losses);

struct ContactKernels {
  // Finds the rows of [first, last) that are closer than their rest distance or were touching, ascending.
  // Writes them to `rows`, which has space for all; returns their number. NaN counts as close, so that it
  // appears in the forces.
  std::size_t (*rows_at_work)(const ContactColumns &, std::size_t first, std::size_t last, int *rows);
  // Throws std::invalid_argument for rolling resistance without rotation.
  ContactLoop (*loop)(const ContactEffects &);
};
extern const ContactKernels contact_kernels_baseline, contact_kernels_avx2, contact_kernels_avx512;

} // namespace platen::dem::kernels
