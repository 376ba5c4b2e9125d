// Packs of doubles and how they are read from and written to rows; for the kernel sources, which set
// PLATEN_LANES (4 or 8). Everything stays in an unnamed namespace of the including file, because functions
// compiled for one instruction set must never be linked into another's.
#pragma once

#include <cstddef>

#include "dem/laws/parallel_bond.h"
#include "dem/vector3.h"

namespace platen::dem::kernels {
namespace {

constexpr int lanes = PLATEN_LANES;
typedef double Native __attribute__((vector_size(8 * PLATEN_LANES)));
typedef double Four __attribute__((vector_size(32)));
typedef double FourInMemory __attribute__((vector_size(32), aligned(8), may_alias));

// A struct of this file, not the bare vector type: what is instantiated on it then belongs to this file
// alone.
struct Pack {
  Native v{};
  Pack() = default;
  Pack(Native a) : v(a) {}
  Pack(double a) : v(a - Native{}) {}
};
// Beside those of double, which the ones below would hide.
using dem::larger;
using dem::magnitude;
using dem::positive_part;
using dem::root;
using dem::with_sign;

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
inline Pack with_sign(const Pack &size, const Pack &of) {
  return of.v < 0.0 ? -size.v : size.v;
}

inline Four load_four(const double *from) {
  return *reinterpret_cast<const FourInMemory *>(from);
}
inline void store_four(double *to, const Four &a) {
  *reinterpret_cast<FourInMemory *>(to) = a;
}

// The four lanes from 4 half on of a pack, and back.
inline Four part(const Pack &a, int half) {
#if PLATEN_LANES == 4
  (void)half;
  return a.v;
#else
  return half == 0 ? __builtin_shufflevector(a.v, a.v, 0, 1, 2, 3)
                   : __builtin_shufflevector(a.v, a.v, 4, 5, 6, 7);
#endif
}
inline Pack join(const Four *parts) {
#if PLATEN_LANES == 4
  return parts[0];
#else
  return __builtin_shufflevector(parts[0], parts[1], 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

// Rows of four become columns of four, or back.
inline void transpose(const Four *in, Four *out) {
  const Four a = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
  const Four b = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
  const Four c = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
  const Four d = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// One column of `lanes` rows that follow each other.
inline Pack load(const double *from) {
  Four parts[lanes / 4];
  for (int h = 0; h < lanes / 4; ++h)
    parts[h] = load_four(from + 4 * h);
  return join(parts);
}

// `lanes` vectors that follow each other in memory.
inline Triple<Pack> load(const Vector3 *from) {
  Four x[lanes / 4], y[lanes / 4], z[lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    const double *at = &from[4 * h].x;
    const Four a = load_four(at), b = load_four(at + 4), c = load_four(at + 8);
    const Four p = __builtin_shufflevector(a, b, 0, 1, 6, 7); // x0 y0 x2 y2
    const Four q = __builtin_shufflevector(a, c, 2, 3, 4, 5); // z0 x1 z2 x3
    const Four r = __builtin_shufflevector(b, c, 0, 1, 6, 7); // y1 z1 y3 z3
    x[h] = __builtin_shufflevector(p, q, 0, 5, 2, 7);
    y[h] = __builtin_shufflevector(p, r, 1, 4, 3, 6);
    z[h] = __builtin_shufflevector(q, r, 0, 5, 2, 7);
  }
  return {join(x), join(y), join(z)};
}
inline void store(Vector3 *to, const Triple<Pack> &t) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Four x = part(t.x, h), y = part(t.y, h), z = part(t.z, h);
    const Four p = __builtin_shufflevector(x, y, 0, 4, 2, 6); // x0 y0 x2 y2
    const Four q = __builtin_shufflevector(z, x, 0, 5, 2, 7); // z0 x1 z2 x3
    const Four r = __builtin_shufflevector(y, z, 1, 5, 3, 7); // y1 z1 y3 z3
    double *at = &to[4 * h].x;
    store_four(at, __builtin_shufflevector(p, q, 0, 1, 4, 5));
    store_four(at + 4, __builtin_shufflevector(r, p, 0, 1, 6, 7));
    store_four(at + 8, __builtin_shufflevector(q, r, 2, 3, 6, 7));
  }
}
inline Rotation<Pack> load(const Quaternion *from) {
  Four c[4][lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    Four rows[4], columns[4];
    for (int l = 0; l < 4; ++l)
      rows[l] = load_four(&from[4 * h + l].w);
    transpose(rows, columns);
    for (int k = 0; k < 4; ++k)
      c[k][h] = columns[k];
  }
  return {join(c[0]), join(c[1]), join(c[2]), join(c[3])};
}
inline void store(Quaternion *to, const Rotation<Pack> &q) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Four columns[4] = {part(q.w, h), part(q.x, h), part(q.y, h), part(q.z, h)};
    Four rows[4];
    transpose(columns, rows);
    for (int l = 0; l < 4; ++l)
      store_four(&to[4 * h + l].w, rows[l]);
  }
}

// Rows column[at[l]] for every lane. Columns have a spare row at their end, so that a vector can be read as
// four doubles.
inline Rotation<Pack> gather(const Quaternion *column, const int *at) {
  Four c[4][lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    Four rows[4], columns[4];
    for (int l = 0; l < 4; ++l)
      rows[l] = load_four(&column[at[4 * h + l]].w);
    transpose(rows, columns);
    for (int k = 0; k < 4; ++k)
      c[k][h] = columns[k];
  }
  return {join(c[0]), join(c[1]), join(c[2]), join(c[3])};
}
// column[b[l]] - column[a[l]].
inline Triple<Pack> gather_difference(const Vector3 *column, const int *b, const int *a) {
  Four c[3][lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    Four rows[4], columns[4];
    for (int l = 0; l < 4; ++l)
      rows[l] = load_four(&column[b[4 * h + l]].x) - load_four(&column[a[4 * h + l]].x);
    transpose(rows, columns);
    for (int k = 0; k < 3; ++k)
      c[k][h] = columns[k];
  }
  return {join(c[0]), join(c[1]), join(c[2])};
}
inline Triple<Pack> gather(const Vector3 *column, const int *at) {
  Four c[3][lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    Four rows[4], columns[4];
    for (int l = 0; l < 4; ++l)
      rows[l] = load_four(&column[at[4 * h + l]].x);
    transpose(rows, columns);
    for (int k = 0; k < 3; ++k)
      c[k][h] = columns[k];
  }
  return {join(c[0]), join(c[1]), join(c[2])};
}

// Lanes as rows {x, y, z, any}.
inline void to_rows(const Triple<Pack> &t, Four *rows) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Four columns[4] = {part(t.x, h), part(t.y, h), part(t.z, h), part(t.z, h)};
    transpose(columns, rows + 4 * h);
  }
}

} // namespace
} // namespace platen::dem::kernels
