// Bodies of the kernels of soft spheres; the including file sets PLATEN_LANES (4, 8 or 16 floats) and the
// names. Compiled without contraction, and sums are kept for each lane of a whole group: every instruction
// set gives the same columns and sums. Everything is in an unnamed namespace (simd.inc.h gives the reason).
#include "dem/kernels/soft_kernel.h"

namespace platen::dem::kernels {
namespace {

constexpr int lanes = PLATEN_LANES, quads = lanes / 4, parts = static_cast<int>(soft_group) / lanes;
typedef float Floats __attribute__((vector_size(4 * PLATEN_LANES)));
typedef float FloatsInMemory __attribute__((vector_size(4 * PLATEN_LANES), aligned(4), may_alias));
typedef float Quad __attribute__((vector_size(16)));
typedef float QuadInMemory __attribute__((vector_size(16), may_alias));

// Keeps vectors in registers.
#define PLATEN_SOFT_INLINE inline __attribute__((always_inline))

constexpr float tiny = 1e-30F; // keeps the direction of two coincident spheres finite (zero)

// The same shuffle of every four lanes; lanes of the second vector count from `lanes` on.
#if PLATEN_LANES == 4
#define PLATEN_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l)
#elif PLATEN_LANES == 8
#define PLATEN_SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4)
#else
#define PLATEN_SHUFFLE(a, b, i, j, k, l)                                                                    \
  __builtin_shufflevector(a, b, i, j, k, l, i + 4, j + 4, k + 4, l + 4, i + 8, j + 8, k + 8, l + 8, i + 12, \
                          j + 12, k + 12, l + 12)
#endif

inline Floats load(const float *from) {
  return *reinterpret_cast<const FloatsInMemory *>(from);
}
inline Quad load_row(const SoftRow *column, int row) {
  return *reinterpret_cast<const QuadInMemory *>(column + row);
}
inline Quad load_row(const SoftRow *column, unsigned bytes) {
  return *reinterpret_cast<const QuadInMemory *>(reinterpret_cast<const char *>(column) + bytes);
}
inline Floats root(const Floats &a) {
  Floats r;
  for (int l = 0; l < lanes; ++l)
    r[l] = __builtin_sqrtf(a[l]);
  return r;
}

// Joins rows k, k + 4, ... of a group to one vector; part() extracts one of them.
template <class Place>
PLATEN_SOFT_INLINE Floats join(const SoftRow *column, const Place *at) {
#if PLATEN_LANES == 4
  return load_row(column, at[0]);
#else
  const auto two = [&](int i, int j) {
    return __builtin_shufflevector(load_row(column, at[i]), load_row(column, at[j]), 0, 1, 2, 3, 4, 5, 6, 7);
  };
#if PLATEN_LANES == 8
  return two(0, 4);
#else
  return __builtin_shufflevector(two(0, 4), two(8, 12), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
#endif
#endif
}
template <int quad>
Quad part(const Floats &a) {
  return __builtin_shufflevector(a, a, 4 * quad, 4 * quad + 1, 4 * quad + 2, 4 * quad + 3);
}

struct Columns {
  Floats x, y, z, w;
};
// Four rows become four columns, or back, in every four lanes.
PLATEN_SOFT_INLINE Columns transposed(const Columns &in) {
  const Floats a = PLATEN_SHUFFLE(in.x, in.y, 0, lanes, 1, lanes + 1);
  const Floats b = PLATEN_SHUFFLE(in.x, in.y, 2, lanes + 2, 3, lanes + 3);
  const Floats c = PLATEN_SHUFFLE(in.z, in.w, 0, lanes, 1, lanes + 1);
  const Floats d = PLATEN_SHUFFLE(in.z, in.w, 2, lanes + 2, 3, lanes + 3);
  return {PLATEN_SHUFFLE(a, c, 0, 1, lanes, lanes + 1), PLATEN_SHUFFLE(a, c, 2, 3, lanes + 2, lanes + 3),
          PLATEN_SHUFFLE(b, d, 0, 1, lanes, lanes + 1), PLATEN_SHUFFLE(b, d, 2, 3, lanes + 2, lanes + 3)};
}
template <class Place>
PLATEN_SOFT_INLINE Columns gather(const SoftRow *column, const Place *at) {
  return transposed({join(column, at), join(column, at + 1), join(column, at + 2), join(column, at + 3)});
}

inline void store_row(SoftRow *to, const Quad &a) {
  *reinterpret_cast<QuadInMemory *>(to) = a;
}
template <int quad = 0>
PLATEN_SOFT_INLINE void scatter(const Columns &rows, SoftRow *column, const int *at) {
  store_row(column + at[4 * quad], part<quad>(rows.x));
  store_row(column + at[4 * quad + 1], part<quad>(rows.y));
  store_row(column + at[4 * quad + 2], part<quad>(rows.z));
  store_row(column + at[4 * quad + 3], part<quad>(rows.w));
  if constexpr (quad + 1 < quads) scatter<quad + 1>(rows, column, at);
}

inline Floats product(const Columns &a, const Columns &b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline double sum_of(const Floats *part) {
  double sum = 0;
  for (int p = 0; p < parts; ++p)
    for (int l = 0; l < lanes; ++l)
      sum += static_cast<double>(part[p][l]);
  return sum;
}

struct LaneSums {
  Floats overlap[parts]{}, contacts[parts]{}, push[parts]{}, speed[parts]{}, power[parts]{};
};

// With u the partner's displacement minus the own one and d the listed vector, |d + u|^2 is equal to |d|^2 +
// (d + (d + u)) . u. The overlap is the difference of the squares of reach and distance over their sum.
inline void add_forces(const SoftColumns &c, const SoftLists &lists, std::size_t group,
                       const unsigned *partner, const float *separation, float step, int p, LaneSums &sums) {
  const int *row = lists.row + soft_group * group + static_cast<std::size_t>(lanes * p);
  const Columns own = gather(c.displacement, row), velocity = gather(c.velocity, row);
  Columns force = gather(c.outside, row);
  Floats overlaps{}, contacts{};
  for (int k = 0; k < lists.steps[group]; ++k, partner += soft_group, separation += 4 * soft_group) {
    const Columns other = gather(c.displacement, partner);
    const Columns d{load(separation), load(separation + soft_group), load(separation + 2 * soft_group), {}};
    const Columns u{other.x - own.x, other.y - own.y, other.z - own.z, {}};
    const Columns now{d.x + u.x, d.y + u.y, d.z + u.z, {}};
    const Columns both{d.x + now.x, d.y + now.y, d.z + now.z, {}};
    const Floats outside = load(separation + 3 * soft_group) + product(both, u);
    const Floats distance = root(product(now, now));
    const Floats inside = outside < 0.0F ? -outside : Floats{};
    const Floats weight = inside / ((own.w + other.w + distance) * (distance + tiny));
    force.x -= weight * now.x, force.y -= weight * now.y, force.z -= weight * now.z;
    overlaps += weight * distance;
    contacts += outside < 0.0F ? 1.0F - Floats{} : Floats{};
  }
  const Columns kicked{
      velocity.x + step * force.x, velocity.y + step * force.y, velocity.z + step * force.z, {}};
  sums.overlap[p] += overlaps, sums.contacts[p] += contacts;
  sums.push[p] += product(force, force), sums.speed[p] += product(kicked, kicked);
  sums.power[p] += product(force, velocity);
  scatter(transposed(force), c.force, row);
}

} // namespace

SoftSums PLATEN_SOFT_FORCES(SoftColumns c, SoftLists lists, float step) {
  LaneSums sums;
  const unsigned *partner = lists.partner;
  const float *separation = lists.separation;
  for (std::size_t group = 0; group < lists.groups; ++group) {
    for (int p = 0; p < parts; ++p)
      add_forces(c, lists, group, partner + lanes * p, separation + lanes * p, step, p, sums);
    const std::size_t entries = soft_group * static_cast<std::size_t>(lists.steps[group]);
    partner += entries, separation += 4 * entries;
  }
  return {sum_of(sums.overlap), sum_of(sums.contacts), sum_of(sums.push), sum_of(sums.speed),
          sum_of(sums.power)};
}

// Treats all four numbers of a row alike: forces and velocities are 0 where the radius stands.
float PLATEN_SOFT_DRIFT(SoftColumns c, SoftMove m, std::size_t first, std::size_t last) {
  Floats fastest{};
  for (std::size_t row = first; row < last; row += quads) {
    const Floats f = load(&c.force[row].x), kicked = load(&c.velocity[row].x) + m.step * f;
    const Floats v = (1.0F - m.mixing) * kicked + m.along * f;
    *reinterpret_cast<FloatsInMemory *>(&c.velocity[row].x) = v;
    *reinterpret_cast<FloatsInMemory *>(&c.displacement[row].x) = load(&c.displacement[row].x) + m.step * v;
    const Floats square = v * v;
    const Floats pairs = square + PLATEN_SHUFFLE(square, square, 1, 0, 3, 2);
    const Floats speed = pairs + PLATEN_SHUFFLE(pairs, pairs, 2, 3, 0, 1);
    fastest = fastest > speed ? fastest : speed;
  }
  float largest = 0;
  for (int l = 0; l < lanes; ++l)
    largest = largest > fastest[l] ? largest : fastest[l];
  return largest;
}

} // namespace platen::dem::kernels
