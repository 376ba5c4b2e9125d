// Packs of doubles and how they are read from and written to rows; for the kernel sources, which set
// PLATEN_LANES (2, 4 or 8). Everything stays in an unnamed namespace of the including file, because functions
// compiled for one instruction set must never be linked into another's.
#pragma once

#include <cstddef>

#include "base/vector3.h"
#include "dem/laws/parallel_bond.h"

namespace platen::dem::kernels {
namespace {

constexpr int lanes = PLATEN_LANES;
typedef double Native __attribute__((vector_size(8 * PLATEN_LANES)));

// A struct of this file, not the bare vector type: what is instantiated on it then belongs to this file
// alone.
struct Pack {
  Native v{};
  Pack() = default;
  Pack(Native a) : v(a) {}
  Pack(double a) : v(a - Native{}) {}
};
// Beside those of double, which the ones below would hide.
using dem::any_positive;
using dem::larger;
using dem::magnitude;
using dem::positive_part;
using dem::root;
using dem::where_positive;

inline Pack operator+(const Pack &a, const Pack &b) {
  return a.v + b.v;
}
inline Pack operator-(const Pack &a, const Pack &b) {
  return a.v - b.v;
}
inline Pack operator*(const Pack &a, const Pack &b) {
  return a.v * b.v;
}
inline Pack operator/(const Pack &a, const Pack &b) {
  return a.v / b.v;
}
inline Pack operator-(const Pack &a) {
  return -a.v;
}
inline Pack root(const Pack &a) {
  Pack r;
  for (int l = 0; l < lanes; ++l)
    r.v[l] = __builtin_sqrt(a.v[l]);
  return r;
}
inline Pack magnitude(const Pack &a) {
  return a.v < 0.0 ? -a.v : a.v;
}
inline Pack positive_part(const Pack &a) {
  return a.v > 0.0 ? a.v : Native{};
}
inline Pack larger(const Pack &a, const Pack &b) {
  return a.v > b.v ? a.v : b.v;
}
inline bool any_positive(const Pack &a) {
  bool any = false;
  for (int l = 0; l < lanes; ++l)
    any |= a.v[l] > 0.0;
  return any;
}
inline Pack where_positive(const Pack &x, const Pack &a, const Pack &b) {
  return x.v > 0.0 ? a.v : b.v;
}
// `size`, which is not negative, with the sign of `of`.
inline double with_sign(double size, double of) {
  return __builtin_copysign(size, of);
}
inline Pack with_sign(const Pack &size, const Pack &of) {
  typedef long long Bits __attribute__((vector_size(8 * PLATEN_LANES)));
  const Bits sign = (Bits)(-0.0 - Native{});
  return (Native)((Bits)size.v | ((Bits)of.v & sign));
}

} // namespace
} // namespace platen::dem::kernels

#if PLATEN_LANES == 2
#include "dem/kernels/rows_of_two.inc.h"
#else
#include "dem/kernels/rows_of_four.inc.h"
#endif

namespace platen::dem::kernels {
namespace {

inline Triple<Pack> to_vectors(const Row *rows) {
  const Rotation<Pack> columns = to_columns(rows);
  return {columns.w, columns.x, columns.y};
}

inline Rotation<Pack> load(const Quaternion *from) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&from[l].w);
  return to_columns(rows);
}

// Rows column[at[l]] for every lane. Columns have a spare row at their end, so that a vector can be read as
// four doubles.
inline Rotation<Pack> gather(const Quaternion *column, const int *at) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[at[l]].w);
  return to_columns(rows);
}
inline Triple<Pack> gather(const Vector3 *column, const int *at) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[at[l]].x);
  return to_vectors(rows);
}
// column[b[l]] - column[a[l]].
inline Triple<Pack> gather_difference(const Vector3 *column, const int *b, const int *a) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[b[l]].x) - load_row(&column[a[l]].x);
  return to_vectors(rows);
}

} // namespace
} // namespace platen::dem::kernels
