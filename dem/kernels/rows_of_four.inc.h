// Rows of four doubles as one vector each, for SIMD vectors of four lanes (simd.inc.h).
#pragma once

namespace platen::dem::kernels {
namespace {

typedef double Row __attribute__((vector_size(32)));
typedef double RowInMemory __attribute__((vector_size(32), aligned(8), may_alias));

PLATEN_INLINE Row load_row(const double *from) {
  return *reinterpret_cast<const RowInMemory *>(from);
}
PLATEN_INLINE void store_row(double *to, const Row &a) {
  *reinterpret_cast<RowInMemory *>(to) = a;
}

// Rows of four become columns of four, or back.
PLATEN_INLINE void transpose(const Row *in, Row *out) {
  const Row a = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
  const Row b = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
  const Row c = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
  const Row d = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// One column of four consecutive rows.
PLATEN_INLINE Simd load(const double *from) {
  return load_row(from);
}

// Four consecutive vectors in memory.
PLATEN_INLINE Triple<Simd> load(const Vector3 *from) {
  const double *at = &from->x;
  const Row a = load_row(at), b = load_row(at + 4), c = load_row(at + 8);
  const Row p = __builtin_shufflevector(a, b, 0, 1, 6, 7); // x0 y0 x2 y2
  const Row q = __builtin_shufflevector(a, c, 2, 3, 4, 5); // z0 x1 z2 x3
  const Row r = __builtin_shufflevector(b, c, 0, 1, 6, 7); // y1 z1 y3 z3
  return {Row(__builtin_shufflevector(p, q, 0, 5, 2, 7)), Row(__builtin_shufflevector(p, r, 1, 4, 3, 6)),
          Row(__builtin_shufflevector(q, r, 0, 5, 2, 7))};
}
PLATEN_INLINE void store(Vector3 *to, const Triple<Simd> &t) {
  const Row &x = t.x.v, &y = t.y.v, &z = t.z.v;
  const Row p = __builtin_shufflevector(x, y, 0, 4, 2, 6); // x0 y0 x2 y2
  const Row q = __builtin_shufflevector(z, x, 0, 5, 2, 7); // z0 x1 z2 x3
  const Row r = __builtin_shufflevector(y, z, 1, 5, 3, 7); // y1 z1 y3 z3
  double *at = &to->x;
  store_row(at, __builtin_shufflevector(p, q, 0, 1, 4, 5));
  store_row(at + 4, __builtin_shufflevector(r, p, 0, 1, 6, 7));
  store_row(at + 8, __builtin_shufflevector(q, r, 2, 3, 6, 7));
}
PLATEN_INLINE void store(Quaternion *to, const Rotation<Simd> &q) {
  const Row columns[4] = {q.w.v, q.x.v, q.y.v, q.z.v};
  Row rows[4];
  transpose(columns, rows);
  for (int l = 0; l < 4; ++l)
    store_row(&to[l].w, rows[l]);
}

PLATEN_INLINE Rotation<Simd> to_columns(const Row *rows) {
  Row columns[4];
  transpose(rows, columns);
  return {columns[0], columns[1], columns[2], columns[3]};
}

PLATEN_INLINE void to_rows(const Rotation<Simd> &q, Row *rows) {
  const Row columns[4] = {q.w.v, q.x.v, q.y.v, q.z.v};
  transpose(columns, rows);
}
// Lanes as rows {x, y, z, any}.
PLATEN_INLINE void to_rows(const Triple<Simd> &t, Row *rows) {
  const Row columns[4] = {t.x.v, t.y.v, t.z.v, t.z.v};
  transpose(columns, rows);
}

} // namespace
} // namespace platen::dem::kernels
