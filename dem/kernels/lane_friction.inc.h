// Common parts of contacts in SIMD vectors: rows by their numbers, and springs that rotate with their planes.
#pragma once

#include <cmath>
#include <cstring>

#include "base/portable.h"
#include "dem/kernels/lane_mask.inc.h"
#include "dem/laws/coulomb_friction.h"
#include "dem/laws/rotating_plane.h"

namespace platen::dem::kernels {
namespace {

PLATEN_INLINE Simd gather(const double *column, const int *at) {
  Simd a;
  for (int l = 0; l < lanes; ++l)
    a.v[l] = column[at[l]];
  return a;
}
// Whether each of the consecutive numbers from an address on is not zero.
PLATEN_INLINE LaneMask set_lanes_of(const int *from) {
  typedef int Numbers __attribute__((vector_size(4 * PLATEN_LANES)));
  Numbers numbers;
  std::memcpy(&numbers, from, sizeof numbers);
  return {__builtin_convertvector(numbers, LaneMask::Bits) != 0};
}
// Writes lanes [0, count) to the rows `at`.
PLATEN_INLINE void scatter(double *column, const int *at, int count, const Simd &a) {
  for (int l = 0; l < count; ++l)
    column[at[l]] = a.v[l];
}
PLATEN_INLINE void scatter(int *column, const int *at, int count, const LaneMask &a) {
  for (int l = 0; l < count; ++l)
    column[at[l]] = a.v[l] != 0 ? 1 : 0;
}
PLATEN_INLINE void scatter(Vector3 *column, const int *at, int count, const Triple<Simd> &a) {
  for (int l = 0; l < count; ++l)
    column[at[l]] = Vector3{a.x.v[l], a.y.v[l], a.z.v[l]};
}

// Rotates about the unit normal by any angle (rad), exact.
PLATEN_INLINE Triple<Simd> spin_in_plane(const Triple<Simd> &vector, const Triple<Simd> &normal,
                                         const Simd &angle) {
  const Triple<Simd> little = spun_a_little<OfLanes>(vector, normal, angle);
  const LaneMask far = OfLanes::at_least(OfLanes::magnitude(angle), Simd(spin_of_a_step));
  if (!OfLanes::any(far)) return little;
  Simd cosine, sine;
  for (int l = 0; l < lanes; ++l)
    cosine.v[l] = portable::cos(angle.v[l]), sine.v[l] = portable::sin(angle.v[l]);
  return choose<OfLanes>(far, scale(cosine, vector) + scale(sine, cross(normal, vector)), little);
}

} // namespace
} // namespace platen::dem::kernels
