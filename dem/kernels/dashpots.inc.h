// Dashpots of bonds, in the pass that computes their springs.
#pragma once

#include "dem/kernels/block_rows.inc.h"

namespace platen::dem::kernels {
namespace {

// Sums in row order, so that rows without a dashpot can be dropped without a change.
struct PowerSum {
  double sum = 0; // W
  PLATEN_INLINE void add(const Simd &power) {
    for (int l = 0; l < lanes; ++l)
      sum += power.v[l];
  }
};

// Force on the first particles, N; torques on both, N m, only with rotation.
struct DashpotResponse {
  Triple<Simd> force, torque_i, torque_j;
};

PLATEN_INLINE void add_dashpot_moments(const BondColumns &c, std::size_t k, const Simd &acts,
                                       const Triple<Simd> &spin, const Triple<Simd> &along, Simd &power,
                                       DashpotResponse &r) {
  const Simd bending = acts * load(c.dashpot_bending + k);
  const Triple<Simd> moment =
      scale(bending, spin) + scale(Simd((c.dashpot_twist_ratio - 1.0) * bending), along);
  r.torque_i = r.torque_i + moment;
  r.torque_j = r.torque_j - moment;
  power = power + dot(moment + load(c.dashpot_moment + k), spin);
  store(c.dashpot_moment + k, moment);
}

// Dashpots in parallel with the springs of bonds with distance `d` and end velocity `v`, at the contact point
// lever d from the first centre (docs/theory.md). `acts`: 1, or 0 for bonds that have just failed.
template <class Rows>
PLATEN_INLINE DashpotResponse dashpots_of(const BondColumns &c, std::size_t k, const Ends &ends,
                                          const Triple<Simd> &d, Triple<Simd> v, const Simd &acts,
                                          PowerSum &power) {
  const Simd lever = load(c.lever + k), axial = acts * load(c.dashpot + k);
  Triple<Simd> spin;
  if constexpr (Rows::rotation) {
    const Triple<Simd> wi = spins<Rows>(FirstEnd(ends)), wj = spins<Rows>(SecondEnd(ends));
    v = v + cross(d, scale(lever, wi) + scale(Simd(1.0 - lever), wj));
    spin = wj - wi;
  }
  const Simd per_square = 1.0 / dot(d, d), across = c.dashpot_shear_ratio * axial;
  DashpotResponse r;
  r.force = scale(across, v) + scale(Simd((axial - across) * (dot(v, d) * per_square)), d);
  Simd taken = dot(r.force + load(c.dashpot_force + k), v);
  store(c.dashpot_force + k, r.force);
  if constexpr (Rows::rotation) {
    const Triple<Simd> moment = cross(d, r.force);
    r.torque_i = scale(lever, moment);
    r.torque_j = moment - r.torque_i;
    if (c.dashpot_moment != nullptr)
      add_dashpot_moments(c, k, acts, spin, scale(Simd(dot(spin, d) * per_square), d), taken, r);
  }
  power.add(taken);
  return r;
}

// Dashpots alone, for SIMD vectors in which bonds may have failed in this step: `failed` is positive there.
template <class Rows>
[[gnu::noinline]] void add_dashpots_separately(const BondColumns &c, std::size_t k, const Ends &ends,
                                               const Simd &failed, PowerSum &power) {
  Triple<Simd> d, v;
  part(ends, d, v);
  const DashpotResponse r =
      dashpots_of<Rows>(c, k, ends, d, v, where_positive(failed, Simd(0.0), Simd(1.0)), power);
  scatter<Rows>(ends, r.force, r.torque_i, r.torque_j);
}

} // namespace
} // namespace platen::dem::kernels
