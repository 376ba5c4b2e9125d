// Block kernels of soft spheres on their way to rest (dem/packing/soft_spheres.h). One source, compiled once
// per instruction set (soft_kernel.inc.h), to the same last bit of every column. Lengths in mean radii.
#pragma once

#include <cstddef>

#include "base/vector3.h"

namespace platen::dem::kernels {

// Lists of partners are cut into packs of so many spheres, whatever the instruction set.
constexpr std::size_t soft_pack = 8;

struct Ball { // read as a vector of four
  double radius = 0;
  double x = 0, y = 0, z = 0;
};

struct SoftColumns {
  Ball *ball;
  Vector3 *force, *velocity;
  const Vector3 *press; // a constant force, or null
  // Partners of the spheres of pack p, step by step: partner[first[p] + soft_pack k + l] is the k-th of
  // lane l, in the order in which forces are added; lanes that have fewer end with a ball that touches none.
  const int *partner;
  const std::size_t *first;
  const double *earlier; // of each sphere: how many of its partners belong to pairs that others have counted
  double *force_square, *speed_square;
};

// Of the contacts of pairs, each counted once.
struct SoftContacts {
  double overlap = 0, largest = 0, number = 0;
};
SoftContacts add_soft_forces_baseline(SoftColumns, std::size_t first_pack, std::size_t last_pack);
SoftContacts add_soft_forces_avx2(SoftColumns, std::size_t first_pack, std::size_t last_pack);
SoftContacts add_soft_forces_avx512(SoftColumns, std::size_t first_pack, std::size_t last_pack);
using SoftForces = SoftContacts (*)(SoftColumns, std::size_t, std::size_t);

// Force times velocity, and the sum of the sizes of these products, which bounds the round-off of the first.
struct SoftPower {
  double sum = 0, size = 0;
};
// Fills the columns of squares: of the force, and of the velocity that a kick by `step` would leave.
SoftPower soft_squares_baseline(SoftColumns, double step, std::size_t first_pack, std::size_t last_pack);
SoftPower soft_squares_avx2(SoftColumns, double step, std::size_t first_pack, std::size_t last_pack);
SoftPower soft_squares_avx512(SoftColumns, double step, std::size_t first_pack, std::size_t last_pack);
using SoftSquares = SoftPower (*)(SoftColumns, double, std::size_t, std::size_t);

// The kick, the turn of the velocity towards the force, and the drift.
struct SoftMove {
  double step = 0, mixing = 0, along = 0;
};
// Returns the largest squared speed.
double move_soft_baseline(SoftColumns, SoftMove, std::size_t first_pack, std::size_t last_pack);
double move_soft_avx2(SoftColumns, SoftMove, std::size_t first_pack, std::size_t last_pack);
double move_soft_avx512(SoftColumns, SoftMove, std::size_t first_pack, std::size_t last_pack);
using SoftDrift = double (*)(SoftColumns, SoftMove, std::size_t, std::size_t);

} // namespace platen::dem::kernels
