// Block kernels for the relaxation of soft spheres (dem/packing/soft_spheres.h). One source, compiled once
// per instruction set (soft_kernel.inc.h), with every column and sum equal to the last bit. Lengths in mean
// radii.
//
// Single precision is enough because no large numbers are subtracted: spheres are stored by their
// displacement since the lists of partners were made, pairs by their distance at that time, computed in
// double precision. The error of an overlap is then some 1e-7 of the displacements, not of the positions.
#pragma once

#include <cstddef>

namespace platen::dem::kernels {

// Spheres of a block are computed in groups of this size, for every instruction set.
constexpr std::size_t soft_group = 16;

struct alignas(16) SoftRow { // read as a vector of four
  float x = 0, y = 0, z = 0;
  float w = 0;
};

// Rows fill whole groups; padding rows have a radius and no partners.
struct SoftColumns {
  SoftRow *displacement;  // displacement since the lists were made; w: the radius
  SoftRow *velocity;      // w: 0
  SoftRow *force;         // w: 0
  const SoftRow *outside; // force on a sphere except from its partners; w: 0
};

// Possible contacts of one block: soft_group numbers per group or per step, lane by lane.
struct SoftLists {
  std::size_t groups;
  const int *row;          // the spheres of each group
  const int *steps;        // of each group: largest number of partners of its spheres
  const unsigned *partner; // of each step: row of the partner, as bytes from the first row
  // Of each step: vector from the sphere to its partner when the lists were made, x, y and z, and its square
  // minus the square of the sum of radii. Lanes without a further partner hold their own row, zero distance
  // and `no_partner`.
  const float *separation;
};
constexpr float no_partner = 1e30F;

// Sums over the spheres of a block; every pair counts once for each of its ends there.
struct SoftSums {
  double overlap = 0, contacts = 0;
  double push = 0,
         speed = 0; // squares of the forces, and of the velocities after a kick by `step`
  double power = 0; // forces times velocities
};
SoftSums add_soft_forces_baseline(SoftColumns, SoftLists, float step);
SoftSums add_soft_forces_avx2(SoftColumns, SoftLists, float step);
SoftSums add_soft_forces_avx512(SoftColumns, SoftLists, float step);
using SoftForces = SoftSums (*)(SoftColumns, SoftLists, float);

// The kick, the turn of the velocity towards the force, and the drift.
struct SoftMove {
  float step = 0, mixing = 0, along = 0;
};
// Returns the largest squared speed of rows [first, last), whole groups.
float move_soft_baseline(SoftColumns, SoftMove, std::size_t first, std::size_t last);
float move_soft_avx2(SoftColumns, SoftMove, std::size_t first, std::size_t last);
float move_soft_avx512(SoftColumns, SoftMove, std::size_t first, std::size_t last);
using SoftDrift = float (*)(SoftColumns, SoftMove, std::size_t, std::size_t);

} // namespace platen::dem::kernels
