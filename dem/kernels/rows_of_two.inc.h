// Rows of four doubles as two vectors each, for SIMD vectors of two lanes: plain x86-64, whose registers hold
// two doubles (simd.inc.h).
#pragma once

namespace platen::dem::kernels {
namespace {

typedef double TwoInMemory __attribute__((vector_size(16), aligned(8), may_alias));

PLATEN_INLINE Native load_two(const double *from) {
  return *reinterpret_cast<const TwoInMemory *>(from);
}
PLATEN_INLINE void store_two(double *to, const Native &a) {
  *reinterpret_cast<TwoInMemory *>(to) = a;
}
PLATEN_INLINE Native first_of(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 0, 2);
}
PLATEN_INLINE Native second_of(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 1, 3);
}
PLATEN_INLINE Native ends_of(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 0, 3);
}
PLATEN_INLINE Native middle_of(const Native &a, const Native &b) {
  return __builtin_shufflevector(a, b, 1, 2);
}

struct Row {
  Native low, high;
};
PLATEN_INLINE Row operator+(const Row &a, const Row &b) {
  return {a.low + b.low, a.high + b.high};
}
PLATEN_INLINE Row operator-(const Row &a, const Row &b) {
  return {a.low - b.low, a.high - b.high};
}
PLATEN_INLINE Row load_row(const double *from) {
  return {load_two(from), load_two(from + 2)};
}
PLATEN_INLINE void store_row(double *to, const Row &a) {
  store_two(to, a.low);
  store_two(to + 2, a.high);
}

// One column of two consecutive rows.
PLATEN_INLINE Simd load(const double *from) {
  return load_two(from);
}

// Two consecutive vectors in memory.
PLATEN_INLINE Triple<Simd> load(const Vector3 *from) {
  const double *at = &from->x;
  const Native a = load_two(at), b = load_two(at + 2), c = load_two(at + 4); // x0 y0, z0 x1, y1 z1
  return {ends_of(a, b), middle_of(a, c), ends_of(b, c)};
}
PLATEN_INLINE void store(Vector3 *to, const Triple<Simd> &t) {
  double *at = &to->x;
  store_two(at, first_of(t.x.v, t.y.v));
  store_two(at + 2, ends_of(t.z.v, t.x.v));
  store_two(at + 4, second_of(t.y.v, t.z.v));
}

PLATEN_INLINE Rotation<Simd> to_columns(const Row *rows) {
  const Row &a = rows[0], &b = rows[1];
  return {first_of(a.low, b.low), second_of(a.low, b.low), first_of(a.high, b.high),
          second_of(a.high, b.high)};
}
PLATEN_INLINE void store(Quaternion *to, const Rotation<Simd> &q) {
  store_row(&to[0].w, {first_of(q.w.v, q.x.v), first_of(q.y.v, q.z.v)});
  store_row(&to[1].w, {second_of(q.w.v, q.x.v), second_of(q.y.v, q.z.v)});
}

PLATEN_INLINE void to_rows(const Rotation<Simd> &q, Row *rows) {
  rows[0] = {first_of(q.w.v, q.x.v), first_of(q.y.v, q.z.v)};
  rows[1] = {second_of(q.w.v, q.x.v), second_of(q.y.v, q.z.v)};
}
// Lanes as rows {x, y, z, any}.
PLATEN_INLINE void to_rows(const Triple<Simd> &t, Row *rows) {
  rows[0] = {first_of(t.x.v, t.y.v), first_of(t.z.v, t.z.v)};
  rows[1] = {second_of(t.x.v, t.y.v), second_of(t.z.v, t.z.v)};
}

} // namespace
} // namespace platen::dem::kernels
