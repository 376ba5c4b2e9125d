// Block kernels of soft spheres on their way to rest (dem/packing/soft_spheres.h). One source, compiled once
// per instruction set (soft_kernel.inc.h), to the same last bit of every column and sum. Lengths in mean
// radii.
//
// Single precision is enough because nothing large is ever subtracted: spheres are known by the way that they
// have gone since the lists of partners were made, pairs by what they were then, which was found in double
// precision. An overlap is then right to some 1e-7 of the ways, not of the places.
#pragma once

#include <cstddef>

namespace platen::dem::kernels {

// Spheres of a block are taken in groups of so many, whatever the instruction set.
constexpr std::size_t soft_group = 16;

struct alignas(16) SoftRow { // read as a vector of four
  float x = 0, y = 0, z = 0;
  float w = 0;
};

// Rows fill whole groups; those left over have a radius and no partners.
struct SoftColumns {
  SoftRow *way;           // since the lists were made; w: the radius
  SoftRow *velocity;      // w: 0
  SoftRow *force;         // w: 0
  const SoftRow *outside; // what acts on a sphere beside its partners; w: 0
};

// Who may touch whom in one block: soft_group numbers a group or a step, lane by lane.
struct SoftLists {
  std::size_t groups;
  const int *row;          // the spheres of each group
  const int *steps;        // of each group: the most partners that one of its spheres has
  const unsigned *partner; // of each step: the row whose way the partner goes, in bytes from the first
  // Of each step: from the sphere to its partner when the lists were made, x, y and z, and the square of this
  // distance less that of the sum of radii. Lanes that have no partner left hold their own row, no distance
  // and `no_partner`.
  const float *apart;
};
constexpr float no_partner = 1e30F;

// Of the spheres of a block, every pair once for each of its ends there.
struct SoftSums {
  double overlap = 0, contacts = 0;
  double push = 0,
         speed = 0; // squares of the forces, and of the velocities that a kick by `step` would leave
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
