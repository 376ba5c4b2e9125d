// Four doubles as one value, and rows of four as columns: by the compiler's vector extension, so that a
// machine without 256-bit registers compiles the same text.
#pragma once

#include <cmath>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace platen::bench {

typedef double HalfPack __attribute__((vector_size(4 * lanes)));

inline Pack root(Pack a) {
#ifdef __AVX__
  return _mm256_sqrt_pd(a);
#else
  return Pack{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
#endif
}

// Four rows as columns. Halves of rows 0 and 2, and of 1 and 3, are loaded side by side, which leaves one
// shuffle per column.
inline void load_columns(const Pack *const rows[lanes], Pack columns[lanes]) {
  const auto side_by_side = [&](int half, int a, int b) {
    return __builtin_shufflevector(reinterpret_cast<const HalfPack *>(rows[a])[half],
                                   reinterpret_cast<const HalfPack *>(rows[b])[half], 0, 1, 2, 3);
  };
  for (int half = 0; half < 2; ++half) {
    const Pack even = side_by_side(half, 0, 2), odd = side_by_side(half, 1, 3);
    columns[2 * half] = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
    columns[2 * half + 1] = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
  }
}

// Columns x, y, z as four rows; the spare fourth entry of a row gets another row's z.
inline void store_rows(Pack x, Pack y, Pack z, Pack rows[lanes]) {
  const Pack even = __builtin_shufflevector(x, y, 0, 4, 2, 6),
             odd = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  const Pack swapped = __builtin_shufflevector(z, z, 1, 0, 3, 2);
  rows[0] = __builtin_shufflevector(even, z, 0, 1, 4, 5);
  rows[1] = __builtin_shufflevector(odd, swapped, 0, 1, 4, 5);
  rows[2] = __builtin_shufflevector(even, z, 2, 3, 6, 7);
  rows[3] = __builtin_shufflevector(odd, swapped, 2, 3, 6, 7);
}

} // namespace platen::bench
