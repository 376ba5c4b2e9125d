// Rows of four doubles for SIMD vectors of eight lanes: one vector holds two rows, so that transpositions and
// sums need half the instructions of single rows (simd.inc.h).
#pragma once

namespace platen::dem::kernels {
namespace {

typedef double Row __attribute__((vector_size(32)));
typedef double RowInMemory __attribute__((vector_size(32), aligned(8), may_alias));
typedef double NativeInMemory __attribute__((vector_size(64), aligned(8), may_alias));

PLATEN_INLINE Row load_row(const double *from) {
  return *reinterpret_cast<const RowInMemory *>(from);
}
PLATEN_INLINE void store_row(double *to, const Row &a) {
  *reinterpret_cast<RowInMemory *>(to) = a;
}
PLATEN_INLINE Native load_native(const double *from) {
  return *reinterpret_cast<const NativeInMemory *>(from);
}
PLATEN_INLINE void store_native(double *to, const Native &a) {
  *reinterpret_cast<NativeInMemory *>(to) = a;
}

PLATEN_INLINE Native join(const Row &low, const Row &high) {
  return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
}
// Select from both vectors: the first and third pair, or the second and fourth; the lower or upper half; the
// even or odd lanes in turn. Each is one instruction without a table of indices.
PLATEN_INLINE Native odd_twos(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13);
}
PLATEN_INLINE Native even_twos(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
}
PLATEN_INLINE Native lower(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
}
PLATEN_INLINE Native upper(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
}
PLATEN_INLINE Native even(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
}
PLATEN_INLINE Native odd(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}

// Rows of four doubles become columns of eight. A vector holds two rows: 0, 2; 1, 3; 4, 6; 5, 7.
PLATEN_INLINE Rotation<Simd> to_columns(const Native &r02, const Native &r13, const Native &r46,
                                        const Native &r57) {
  const Native a = even(r02, r13), b = odd(r02, r13), c = even(r46, r57), d = odd(r46, r57);
  return {odd_twos(a, c), odd_twos(b, d), even_twos(a, c), even_twos(b, d)};
}
PLATEN_INLINE Rotation<Simd> to_columns(const Row *rows) {
  return to_columns(join(rows[0], rows[2]), join(rows[1], rows[3]), join(rows[4], rows[6]),
                    join(rows[5], rows[7]));
}

// And back: the pairs of rows l and l + 4, l = 0 ... 3, alternate; odd_twos gives row l, even_twos row l + 4.
struct RowTwos {
  Native of[4];
};
PLATEN_INLINE RowTwos to_twos(const Rotation<Simd> &t) {
  const Native a = even(t.w.v, t.x.v), b = odd(t.w.v, t.x.v);
  const Native c = even(t.y.v, t.z.v), d = odd(t.y.v, t.z.v);
  return {odd_twos(a, c), odd_twos(b, d), even_twos(a, c), even_twos(b, d)};
}
// Rows {x, y, z, any}.
PLATEN_INLINE RowTwos to_twos(const Triple<Simd> &t) {
  return to_twos(Rotation<Simd>{t.x, t.y, t.z, t.z});
}
// Row l of a and row l of b in one vector, or rows l + 4.
PLATEN_INLINE Native rows_of_first(const RowTwos &a, const RowTwos &b, int l) {
  return odd_twos(a.of[l], b.of[l]);
}
PLATEN_INLINE Native rows_of_second(const RowTwos &a, const RowTwos &b, int l) {
  return even_twos(a.of[l], b.of[l]);
}

// Two consecutive rows in memory, and the columns of the first and of the second.
typedef Native LongRow;
PLATEN_INLINE LongRow load_long_row(const double *from) {
  return load_native(from);
}
PLATEN_INLINE Rotation<Simd> first_columns(const LongRow *rows) {
  return to_columns(lower(rows[0], rows[2]), lower(rows[1], rows[3]), lower(rows[4], rows[6]),
                    lower(rows[5], rows[7]));
}
PLATEN_INLINE Rotation<Simd> second_columns(const LongRow *rows) {
  return to_columns(upper(rows[0], rows[2]), upper(rows[1], rows[3]), upper(rows[4], rows[6]),
                    upper(rows[5], rows[7]));
}

// One column of eight consecutive rows.
PLATEN_INLINE Simd load(const double *from) {
  return load_native(from);
}

// Eight consecutive vectors in memory: x0 y0 z0 x1 y1 z1 x2 y2, z2 x3 ... x5, y5 z5 ... z7.
PLATEN_INLINE Triple<Simd> load(const Vector3 *from) {
  const double *at = &from->x;
  const Native a = load_native(at), b = load_native(at + 8), c = load_native(at + 16);
  const Native x = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
  const Native y = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
  const Native z = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
  return {Native(__builtin_shufflevector(x, c, 0, 1, 2, 3, 4, 5, 10, 13)),
          Native(__builtin_shufflevector(y, c, 0, 1, 2, 3, 4, 8, 11, 14)),
          Native(__builtin_shufflevector(z, c, 0, 1, 2, 3, 4, 9, 12, 15))};
}
PLATEN_INLINE void store(Vector3 *to, const Triple<Simd> &t) {
  const Native &x = t.x.v, &y = t.y.v, &z = t.z.v;
  const Native a = __builtin_shufflevector(x, y, 0, 8, 0, 1, 9, 0, 2, 10);
  const Native b = __builtin_shufflevector(x, y, 0, 3, 11, 0, 4, 12, 0, 5);
  const Native c = __builtin_shufflevector(x, y, 13, 0, 6, 14, 0, 7, 15, 0);
  double *at = &to->x;
  store_native(at, __builtin_shufflevector(a, z, 0, 1, 8, 3, 4, 9, 6, 7));
  store_native(at + 8, __builtin_shufflevector(b, z, 10, 1, 2, 11, 4, 5, 12, 7));
  store_native(at + 16, __builtin_shufflevector(c, z, 0, 13, 2, 3, 14, 5, 6, 15));
}
PLATEN_INLINE void store(Quaternion *to, const Rotation<Simd> &q) {
  const RowTwos twos = to_twos(q);
  for (int h = 0; h < 4; h += 2) {
    store_native(&to[h].w, odd_twos(twos.of[h], twos.of[h + 1]));
    store_native(&to[4 + h].w, even_twos(twos.of[h], twos.of[h + 1]));
  }
}

PLATEN_INLINE void to_rows(const Rotation<Simd> &q, Row *rows) {
  const RowTwos twos = to_twos(q);
  for (int h = 0; h < 4; ++h) {
    rows[h] = __builtin_shufflevector(twos.of[h], twos.of[h], 0, 1, 4, 5);
    rows[h + 4] = __builtin_shufflevector(twos.of[h], twos.of[h], 2, 3, 6, 7);
  }
}
// Lanes as rows {x, y, z, any}.
PLATEN_INLINE void to_rows(const Triple<Simd> &t, Row *rows) {
  to_rows(Rotation<Simd>{t.x, t.y, t.z, t.z}, rows);
}

} // namespace
} // namespace platen::dem::kernels
