// Rows of four doubles as one vector each, for packs of four and eight lanes (pack.inc.h).
#pragma once

namespace platen::dem::kernels {
namespace {

typedef double Row __attribute__((vector_size(32)));
typedef double RowInMemory __attribute__((vector_size(32), aligned(8), may_alias));

inline Row load_row(const double *from) {
  return *reinterpret_cast<const RowInMemory *>(from);
}
inline void store_row(double *to, const Row &a) {
  *reinterpret_cast<RowInMemory *>(to) = a;
}

// The four lanes from 4 half on of a pack, and back.
inline Row part(const Pack &a, int half) {
#if PLATEN_LANES == 4
  (void)half;
  return a.v;
#else
  return half == 0 ? __builtin_shufflevector(a.v, a.v, 0, 1, 2, 3)
                   : __builtin_shufflevector(a.v, a.v, 4, 5, 6, 7);
#endif
}
inline Pack join(const Row *parts) {
#if PLATEN_LANES == 4
  return parts[0];
#else
  return __builtin_shufflevector(parts[0], parts[1], 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

// Rows of four become columns of four, or back.
inline void transpose(const Row *in, Row *out) {
  const Row a = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
  const Row b = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
  const Row c = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
  const Row d = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

// One column of `lanes` rows that follow each other.
inline Pack load(const double *from) {
  Row parts[lanes / 4];
  for (int h = 0; h < lanes / 4; ++h)
    parts[h] = load_row(from + 4 * h);
  return join(parts);
}

// `lanes` vectors that follow each other in memory.
inline Triple<Pack> load(const Vector3 *from) {
  Row x[lanes / 4], y[lanes / 4], z[lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    const double *at = &from[4 * h].x;
    const Row a = load_row(at), b = load_row(at + 4), c = load_row(at + 8);
    const Row p = __builtin_shufflevector(a, b, 0, 1, 6, 7); // x0 y0 x2 y2
    const Row q = __builtin_shufflevector(a, c, 2, 3, 4, 5); // z0 x1 z2 x3
    const Row r = __builtin_shufflevector(b, c, 0, 1, 6, 7); // y1 z1 y3 z3
    x[h] = __builtin_shufflevector(p, q, 0, 5, 2, 7);
    y[h] = __builtin_shufflevector(p, r, 1, 4, 3, 6);
    z[h] = __builtin_shufflevector(q, r, 0, 5, 2, 7);
  }
  return {join(x), join(y), join(z)};
}
inline void store(Vector3 *to, const Triple<Pack> &t) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Row x = part(t.x, h), y = part(t.y, h), z = part(t.z, h);
    const Row p = __builtin_shufflevector(x, y, 0, 4, 2, 6); // x0 y0 x2 y2
    const Row q = __builtin_shufflevector(z, x, 0, 5, 2, 7); // z0 x1 z2 x3
    const Row r = __builtin_shufflevector(y, z, 1, 5, 3, 7); // y1 z1 y3 z3
    double *at = &to[4 * h].x;
    store_row(at, __builtin_shufflevector(p, q, 0, 1, 4, 5));
    store_row(at + 4, __builtin_shufflevector(r, p, 0, 1, 6, 7));
    store_row(at + 8, __builtin_shufflevector(q, r, 2, 3, 6, 7));
  }
}
inline void store(Quaternion *to, const Rotation<Pack> &q) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Row columns[4] = {part(q.w, h), part(q.x, h), part(q.y, h), part(q.z, h)};
    Row rows[4];
    transpose(columns, rows);
    for (int l = 0; l < 4; ++l)
      store_row(&to[4 * h + l].w, rows[l]);
  }
}

inline Rotation<Pack> to_columns(const Row *rows) {
  Row c[4][lanes / 4];
  for (int h = 0; h < lanes / 4; ++h) {
    Row columns[4];
    transpose(rows + 4 * h, columns);
    for (int k = 0; k < 4; ++k)
      c[k][h] = columns[k];
  }
  return {join(c[0]), join(c[1]), join(c[2]), join(c[3])};
}

// Lanes as rows {x, y, z, any}.
inline void to_rows(const Triple<Pack> &t, Row *rows) {
  for (int h = 0; h < lanes / 4; ++h) {
    const Row columns[4] = {part(t.x, h), part(t.y, h), part(t.z, h), part(t.z, h)};
    transpose(columns, rows + 4 * h);
  }
}

} // namespace
} // namespace platen::dem::kernels
