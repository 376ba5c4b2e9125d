// SIMD vectors of doubles, read from and written to rows; for the kernel sources, which set PLATEN_LANES (2,
// 4 or 8). Everything is in an unnamed namespace of the including file, because functions compiled for one
// instruction set must never be linked into code for another.
#pragma once

#include <cstddef>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

#include "base/vector3.h"
#include "dem/laws/parallel_bond.h"

namespace platen::dem::kernels {
namespace {

constexpr int lanes = PLATEN_LANES;
typedef double Native __attribute__((vector_size(8 * PLATEN_LANES)));

// A struct of this file, not the bare vector type: templates on it then belong to this file only.
struct Simd {
  Native v{};
  Simd() = default;
  Simd(Native a) : v(a) {}
  Simd(double a) : v(a - Native{}) {}
};
// The functions for double, which the ones below would hide.
using dem::all_positive;
using dem::any_positive;
using dem::larger;
using dem::magnitude;
using dem::positive_part;
using dem::root;
using dem::where_positive;

PLATEN_INLINE Simd operator+(const Simd &a, const Simd &b) {
  return a.v + b.v;
}
PLATEN_INLINE Simd operator-(const Simd &a, const Simd &b) {
  return a.v - b.v;
}
PLATEN_INLINE Simd operator*(const Simd &a, const Simd &b) {
  return a.v * b.v;
}
PLATEN_INLINE Simd operator/(const Simd &a, const Simd &b) {
  return a.v / b.v;
}
PLATEN_INLINE Simd operator-(const Simd &a) {
  return -a.v;
}
PLATEN_INLINE Simd root(const Simd &a) {
  Simd r;
  for (int l = 0; l < lanes; ++l)
    r.v[l] = __builtin_sqrt(a.v[l]);
  return r;
}
PLATEN_INLINE Simd magnitude(const Simd &a) {
  return a.v < 0.0 ? -a.v : a.v;
}
PLATEN_INLINE Simd larger(const Simd &a, const Simd &b) {
  return a.v > b.v ? a.v : b.v;
}
PLATEN_INLINE Simd positive_part(const Simd &a) {
#if PLATEN_LANES == 8 && defined(__AVX512F__) // the compiler needs two instructions for the comparison with 0
  return (Native)_mm512_maskz_max_pd(__mmask8(-1), (__m512d)a.v, _mm512_setzero_pd());
#else
  return a.v > 0.0 ? a.v : Native{};
#endif
}
// Bit mask of the lanes above 0.
PLATEN_INLINE unsigned positive_lanes(const Simd &a) {
#if PLATEN_LANES == 8
  return _mm512_cmp_pd_mask((__m512d)a.v, _mm512_setzero_pd(), _CMP_GT_OQ);
#elif PLATEN_LANES == 4
  return static_cast<unsigned>(
      _mm256_movemask_pd(_mm256_cmp_pd((__m256d)a.v, _mm256_setzero_pd(), _CMP_GT_OQ)));
#elif defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmpgt_pd((__m128d)a.v, _mm_setzero_pd())));
#else
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l)
    bits |= (a.v[l] > 0.0 ? 1u : 0u) << l;
  return bits;
#endif
}
// Bit mask of the lanes with a >= b.
PLATEN_INLINE unsigned lanes_at_least(const Simd &a, const Simd &b) {
#if PLATEN_LANES == 8 && defined(__AVX512F__)
  return _mm512_cmp_pd_mask((__m512d)a.v, (__m512d)b.v, _CMP_GE_OQ);
#elif PLATEN_LANES == 4
  return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd((__m256d)a.v, (__m256d)b.v, _CMP_GE_OQ)));
#elif PLATEN_LANES == 2 && defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd(_mm_cmpge_pd((__m128d)a.v, (__m128d)b.v)));
#else
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l)
    bits |= (a.v[l] >= b.v[l] ? 1u : 0u) << l;
  return bits;
#endif
}
constexpr unsigned all_lanes = (1u << lanes) - 1;
PLATEN_INLINE bool any_positive(const Simd &a) {
  return positive_lanes(a) != 0;
}
PLATEN_INLINE bool all_positive(const Simd &a) {
  return positive_lanes(a) == all_lanes;
}
PLATEN_INLINE Simd where_positive(const Simd &x, const Simd &a, const Simd &b) {
  return x.v > 0.0 ? a.v : b.v;
}
// `size`, which is not negative, with the sign of `of`.
PLATEN_INLINE double with_sign(double size, double of) {
  return __builtin_copysign(size, of);
}
PLATEN_INLINE Simd with_sign(const Simd &size, const Simd &of) {
  typedef long long Bits __attribute__((vector_size(8 * PLATEN_LANES)));
  const Bits sign = (Bits)(-0.0 - Native{});
  return (Native)((Bits)size.v | ((Bits)of.v & sign));
}

} // namespace
} // namespace platen::dem::kernels

#if PLATEN_LANES == 2
#include "dem/kernels/rows_of_two.inc.h"
#elif PLATEN_LANES == 8
#include "dem/kernels/rows_of_eight.inc.h"
#else
#include "dem/kernels/rows_of_four.inc.h"
#endif

namespace platen::dem::kernels {
namespace {

#if PLATEN_LANES != 8
// Two consecutive rows in memory, and the columns of the first and of the second.
struct LongRow {
  Row first, second;
};
PLATEN_INLINE LongRow operator-(const LongRow &a, const LongRow &b) {
  return {a.first - b.first, a.second - b.second};
}
PLATEN_INLINE LongRow load_long_row(const double *from) {
  return {load_row(from), load_row(from + 4)};
}
PLATEN_INLINE Rotation<Simd> first_columns(const LongRow *rows) {
  Row firsts[lanes];
  for (int l = 0; l < lanes; ++l)
    firsts[l] = rows[l].first;
  return to_columns(firsts);
}
PLATEN_INLINE Rotation<Simd> second_columns(const LongRow *rows) {
  Row seconds[lanes];
  for (int l = 0; l < lanes; ++l)
    seconds[l] = rows[l].second;
  return to_columns(seconds);
}
#endif

PLATEN_INLINE Triple<Simd> to_vector(const Rotation<Simd> &columns) {
  return {columns.w, columns.x, columns.y};
}
PLATEN_INLINE Triple<Simd> to_vectors(const Row *rows) {
  return to_vector(to_columns(rows));
}

PLATEN_INLINE Rotation<Simd> load(const Quaternion *from) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&from[l].w);
  return to_columns(rows);
}

// {x, y, z, 0} of a vector that may be the last of its column.
PLATEN_INLINE Row load_vector(const Vector3 *from) {
#if PLATEN_LANES == 2
  return {load_two(&from->x), Native{from->z, 0}};
#else
  return (Row)_mm256_maskload_pd(&from->x, _mm256_setr_epi64x(-1, -1, -1, 0));
#endif
}

// Rows column[at[l]] for every lane. Columns have a spare row at their end, so that a vector can be read as
// four doubles.
PLATEN_INLINE Rotation<Simd> gather(const Quaternion *column, const int *at) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[at[l]].w);
  return to_columns(rows);
}
PLATEN_INLINE Triple<Simd> gather(const Vector3 *column, const int *at) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[at[l]].x);
  return to_vectors(rows);
}
// column[b[l]] - column[a[l]].
PLATEN_INLINE Triple<Simd> gather_difference(const Vector3 *column, const int *b, const int *a) {
  Row rows[lanes];
  for (int l = 0; l < lanes; ++l)
    rows[l] = load_row(&column[b[l]].x) - load_row(&column[a[l]].x);
  return to_vectors(rows);
}

} // namespace
} // namespace platen::dem::kernels
