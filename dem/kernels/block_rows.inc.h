// Working memory of a block of bonds: copies of the particles that it reaches, contiguous in memory of the
// thread, with the sums of their loads; each end of a bond reads one cache line and adds to one.
#pragma once

#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

// Rows of both ends of a SIMD vector of bonds.
struct Ends {
  double *rows; // of the block
  const PairBlocks::Ends *at;
  PLATEN_INLINE double *first(int lane) const { return rows + static_cast<unsigned>(at[lane].first); }
  PLATEN_INLINE double *second(int lane) const { return rows + static_cast<unsigned>(at[lane].second); }
  // The same ends, to be read again: sixteen addresses do not fit into the registers, and the compiler would
  // keep them on the stack from first to last use.
  PLATEN_INLINE Ends again() const {
    const PairBlocks::Ends *same = at;
#if defined(__GNUC__)
    asm("" : "+r"(same));
#endif
    return {rows, same};
  }
};

template <class Rows>
PLATEN_INLINE double *row_of(const BlockColumns &block, int row) {
  return block.rows + static_cast<std::ptrdiff_t>(row) * Rows::stride;
}

PLATEN_INLINE Ends ends_of(const BondColumns &c, const BlockColumns &block, std::size_t k) {
  return {block.rows, c.ends + k};
}

// Ends of bonds [k, last), fewer than a SIMD vector. The remaining lanes use the spare rows, which become
// copies of the ends of the last bond.
struct TailEnds {
  PairBlocks::Ends at[lanes];
};
template <class Rows>
TailEnds tail_ends(const BondColumns &c, const BlockColumns &block, std::size_t k, std::size_t last) {
  constexpr int stride = Rows::stride;
  const int spare = (block.own + block.ghosts) * stride;
  const double *first = block.rows + c.ends[last - 1].first, *second = block.rows + c.ends[last - 1].second;
  for (int n = 0; n < Rows::sums; ++n)
    block.rows[spare + n] = first[n], block.rows[spare + stride + n] = second[n];
  TailEnds ends;
  for (std::size_t l = 0; l < lanes; ++l)
    ends.at[l] = k + l < last ? c.ends[k + l] : PairBlocks::Ends{spare, spare + stride};
  return ends;
}

// Copies of the last rows of a block if they do not fill a SIMD vector; the remaining lanes repeat the last
// row, between the spare rows.
struct Tail {
  int first[lanes], second[lanes];
  Vector3 reference[lanes], dashpot_force[lanes], dashpot_moment[lanes];
  double rest_length[lanes], lever[lanes], normal_stiffness[lanes], bond_radius[lanes];
  double strength_factor[lanes];
  double dashpot[lanes], dashpot_bending[lanes];

  Tail(const BondColumns &c, std::size_t from, std::size_t to) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const bool real = from + l < to;
      const std::size_t k = real ? from + l : to - 1;
      first[l] = c.first[k], second[l] = c.second[k];
      reference[l] = c.reference[k];
      rest_length[l] = c.rest_length[k], lever[l] = c.lever[k];
      normal_stiffness[l] = c.normal_stiffness[k], bond_radius[l] = c.bond_radius[k];
      if (c.strength_factor != nullptr) strength_factor[l] = c.strength_factor[k];
      if (c.dashpot == nullptr) continue;
      dashpot[l] = real ? c.dashpot[k] : 0;
      dashpot_force[l] = real ? c.dashpot_force[k] : Vector3{};
      if (c.dashpot_bending == nullptr) continue;
      dashpot_bending[l] = real ? c.dashpot_bending[k] : 0;
      dashpot_moment[l] = real ? c.dashpot_moment[k] : Vector3{};
    }
  }
  BondColumns columns(BondColumns c) {
    c.first = first, c.second = second;
    c.reference = reference, c.rest_length = rest_length, c.lever = lever;
    c.normal_stiffness = normal_stiffness, c.bond_radius = bond_radius;
    c.strength_factor = strength_factor;
    if (c.dashpot != nullptr) c.dashpot = dashpot, c.dashpot_force = dashpot_force;
    if (c.dashpot_bending != nullptr) c.dashpot_bending = dashpot_bending, c.dashpot_moment = dashpot_moment;
    return c;
  }
  void give_back(const BondColumns &c, std::size_t from, std::size_t to) const {
    for (std::size_t l = 0; from + l < to; ++l) {
      if (c.dashpot_force != nullptr) c.dashpot_force[from + l] = dashpot_force[l];
      if (c.dashpot_moment != nullptr) c.dashpot_moment[from + l] = dashpot_moment[l];
    }
  }
};

// Vectors from the first to the second ends, m.
PLATEN_INLINE Triple<Simd> distances(const Ends &of) {
  const Ends ends = of.again();
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(ends.second(l)) - load_row(ends.first(l));
  return to_vectors(rows);
}
// The same, m, and their rates of change, m/s, from rows with motion. (Copied member by member: otherwise the
// compiler would keep a second copy in memory.)
PLATEN_INLINE void part(const Ends &of, Triple<Simd> &distance, Triple<Simd> &velocity) {
  const Ends ends = of.again();
  LongRow rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_long_row(ends.second(l)) - load_long_row(ends.first(l));
  const Rotation<Simd> x = first_columns(rows), v = second_columns(rows);
  distance.x = x.w, distance.y = x.x, distance.z = x.y;
  velocity.x = v.w, velocity.y = v.x, velocity.z = v.y;
}

// Row of a lane, for one end of each bond.
struct FirstEnd {
  Ends ends;
  explicit FirstEnd(const Ends &of) : ends(of.again()) {}
  PLATEN_INLINE const double *operator()(int lane) const { return ends.first(lane); }
};
struct SecondEnd {
  Ends ends;
  explicit SecondEnd(const Ends &of) : ends(of.again()) {}
  PLATEN_INLINE const double *operator()(int lane) const { return ends.second(lane); }
};
template <class End>
PLATEN_INLINE Rotation<Simd> columns_at(int place, const End &row) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(row(l) + place);
  return to_columns(rows);
}
template <class Rows, class End>
PLATEN_INLINE Rotation<Simd> orientations(const End &end) {
  return columns_at(Rows::orientation, end);
}
template <class Rows, class End>
PLATEN_INLINE Triple<Simd> spins(const End &end) { // rad/s
  return to_vector(columns_at(Rows::spin, end));
}
struct EndTurn {
  Triple<Simd> spin; // rad/s
  Rotation<Simd> orientation;
};
template <class Rows, class End>
PLATEN_INLINE EndTurn turn_of(const End &end) {
  static_assert(Rows::orientation == Rows::spin + 4);
  LongRow rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_long_row(end(l) + Rows::spin);
  return {to_vector(first_columns(rows)), second_columns(rows)};
}

// Adds force and torques to the sums of both ends, bond by bond in row order.
#if PLATEN_LANES == 8
template <class Rows>
PLATEN_INLINE void scatter_with_torques(const Ends &of, const Triple<Simd> &force,
                                        const Triple<Simd> &torque_i, const Triple<Simd> &torque_j) {
  const Ends ends = of.again();
  const RowTwos f = to_twos(force), ti = to_twos(torque_i);
  const RowTwos tj = to_twos(Triple<Simd>{-torque_j.x, -torque_j.y, -torque_j.z});
  constexpr int at = Rows::sums;
  const auto add = [&](int l, const Native &to_first, const Native &from_second) {
    double *a = ends.first(l) + at, *b = ends.second(l) + at;
    store_native(a, load_native(a) + to_first);
    store_native(b, load_native(b) - from_second);
  };
  for (int l = 0; l < 4; ++l)
    add(l, rows_of_first(f, ti, l), rows_of_first(f, tj, l));
  for (int l = 0; l < 4; ++l)
    add(l + 4, rows_of_second(f, ti, l), rows_of_second(f, tj, l));
}
#endif
template <class Rows>
PLATEN_INLINE void scatter(const Ends &of, const Triple<Simd> &force, const Triple<Simd> &torque_i,
                           const Triple<Simd> &torque_j) {
  const Ends ends = of.again();
#if PLATEN_LANES == 8
  if constexpr (Rows::rotation) return scatter_with_torques<Rows>(ends, force, torque_i, torque_j);
#endif
  constexpr int at = Rows::sums;
  Row f[lanes], ti[lanes], tj[lanes];
  to_rows(force, f);
  if constexpr (Rows::rotation) {
    to_rows(torque_i, ti);
    to_rows(torque_j, tj);
  }
  for (int l = 0; l < lanes; ++l) {
    double *a = ends.first(l) + at, *b = ends.second(l) + at;
    store_row(a, load_row(a) + f[l]);
    store_row(b, load_row(b) - f[l]);
    if constexpr (Rows::rotation) {
      store_row(a + 4, load_row(a + 4) + ti[l]);
      store_row(b + 4, load_row(b + 4) + tj[l]);
    }
  }
}

// Adds bonds [from, to), some of which reach their strength; calls must be in ascending order.
PLATEN_INLINE void add_reached(BlockFindings &found, std::size_t from, std::size_t to) {
  if (!found.reached) found.first_reached = from;
  found.reached = true, found.end_reached = to;
}

// Copies the particles and clears the sums.
template <class Rows>
void gather(const BondColumns &c, const BlockColumns &block) {
  double *to = block.rows;
  const auto take = [&](int particle) {
    store_row(to, load_row(&c.position[particle].x));
    store_row(to + Rows::sums, Row{});
    if constexpr (Rows::motion) store_row(to + Rows::velocity, load_row(&c.velocity[particle].x));
    if constexpr (Rows::rotation) {
      store_row(to + Rows::orientation, load_row(&c.orientation[particle].w));
      store_row(to + Rows::sums + 4, Row{});
    }
    if constexpr (Rows::rotation && Rows::motion)
      store_row(to + Rows::spin, load_row(&c.angular_velocity[particle].x));
    to += Rows::stride;
  };
  for (int k = 0; k < block.own; ++k)
    take(block.first_row + k);
  for (int g = 0; g < block.ghosts; ++g)
    take(block.ghost_particle[g]);
}

// Writes the sums from row `first` on to `count` vectors. A store of four doubles also writes into the next
// vector, which is stored next; after the last vector there may be memory of another thread.
template <class Rows>
void scatter(const BlockColumns &block, int first, int count, int at, Vector3 *to) {
  const double *from = row_of<Rows>(block, first) + at;
  int k = 0;
  for (; k + 1 < count; ++k, from += Rows::stride)
    store_row(&to[k].x, load_row(from));
  if (k < count) to[k] = {from[0], from[1], from[2]};
}

template <class Rows>
void scatter(const BlockColumns &block) {
  constexpr int at = Rows::sums;
  scatter<Rows>(block, 0, block.own, at, block.force);
  scatter<Rows>(block, block.own, block.ghosts, at, block.ghost_force);
  if constexpr (Rows::rotation) {
    scatter<Rows>(block, 0, block.own, at + 4, block.torque);
    scatter<Rows>(block, block.own, block.ghosts, at + 4, block.ghost_torque);
  }
}

} // namespace
} // namespace platen::dem::kernels
