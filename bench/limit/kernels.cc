#include "limit/parts.h"

#include <cstddef>

#include "limit/pack.h"
// After the packs, whose root it finds.
#include "limit/bond_forces.h"

namespace platen::bench {

namespace {

// Blocks between the one at work and the one whose second particles are fetched: their rows lie anywhere
// near, so that no hardware sees them coming. It saves a tenth of the loop on Zen 3; first particles, which
// follow each other, need none.
constexpr std::ptrdiff_t look_ahead = 4;

inline void gather(const Pose *poses, const int *rows, Pack Pose::*row, Pack columns[lanes]) {
  const Pack *from[lanes];
  for (int l = 0; l < lanes; ++l)
    from[l] = &(poses[rows[l]].*row);
  load_columns(from, columns);
}

inline void add_block(const BondBlock &b, const Pose *poses, const int *second, Load *first_loads,
                      Load *second_loads) {
  Pack i[lanes], j[lanes], p[lanes], q[lanes];
  gather(poses, b.first, &Pose::place, i);
  gather(poses, b.second, &Pose::place, j);
  gather(poses, b.first, &Pose::turn, p);
  gather(poses, b.second, &Pose::turn, q);
  const BondForces<Pack> f = bond_forces<Pack>(b, {i[0], i[1], i[2]}, p[0], {p[1], p[2], p[3]},
                                               {j[0], j[1], j[2]}, q[0], {q[1], q[2], q[3]});
  Pack rows[lanes];
  store_rows(f.force.x, f.force.y, f.force.z, rows);
  for (int l = 0; l < lanes; ++l) {
    first_loads[b.first[l]].force += rows[l];
    second_loads[second[l]].force -= rows[l];
  }
  store_rows(f.torque_first.x, f.torque_first.y, f.torque_first.z, rows);
  for (int l = 0; l < lanes; ++l)
    first_loads[b.first[l]].torque += rows[l];
  store_rows(f.torque_second.x, f.torque_second.y, f.torque_second.z, rows);
  for (int l = 0; l < lanes; ++l)
    second_loads[second[l]].torque += rows[l];
}

// q + dt/2 (0, spin) q and one Newton step from 1 towards 1/|q|. What that leaves is of the order of the
// square of |q|^2 - 1 = (dt/2 |spin|)^2: below round-off.
inline Pack turned_on(const Pack &q, const Pack &spin, double half_step) {
  const Pack h = half_step * spin;
  const Pack r = q + h[0] * Pack{-1, 1, -1, 1} * __builtin_shufflevector(q, q, 1, 0, 3, 2) +
                 h[1] * Pack{-1, 1, 1, -1} * __builtin_shufflevector(q, q, 2, 3, 0, 1) +
                 h[2] * Pack{-1, -1, 1, 1} * __builtin_shufflevector(q, q, 3, 2, 1, 0);
  Pack square = r * r;
  square += __builtin_shufflevector(square, square, 1, 0, 3, 2);
  square += __builtin_shufflevector(square, square, 2, 3, 0, 1);
  return r * (1.5 - 0.5 * square);
}

} // namespace

// Flattened: calls for packs go through memory, which costs a fifth of the speed.
__attribute__((flatten)) void add_bond_forces(Part &part, const Columns &c) {
  const BondBlock *b = part.inner.data(), *end = b + part.inner.size();
  for (; b != end; ++b) {
    if (end - b > look_ahead)
      for (int l = 0; l < lanes; ++l)
        __builtin_prefetch(&c.poses[b[look_ahead].second[l]]);
    add_block(*b, c.poses, b->second, c.loads, c.loads);
  }
  for (std::size_t k = 0; k < part.crossing.size(); ++k)
    add_block(part.crossing[k], c.poses, part.slots[k].data(), c.loads, part.ghosts.data());
}

__attribute__((flatten)) void integrate(const Part &part, const Columns &c, double time_step) {
  for (int k = part.begin; k < part.end; ++k) {
    Motion &motion = c.motions[k];
    motion.velocity += c.increments[k].per_force * c.loads[k].force;
    motion.spin += c.increments[k].per_torque * c.loads[k].torque;
    c.poses[k].place += time_step * motion.velocity;
    c.poses[k].turn = turned_on(c.poses[k].turn, motion.spin, 0.5 * time_step);
    c.loads[k] = c.applied[k];
  }
}

} // namespace platen::bench
