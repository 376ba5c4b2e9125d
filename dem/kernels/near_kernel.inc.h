// Body of the search kernel; the including file sets the name PLATEN_FIND_NEAR. Runs along a row of cells are
// short: most fit into one vector of eight. Compiled without contraction, so that every instruction set finds
// the same. Everything else is in an unnamed namespace (simd.inc.h gives the reason).
#include "dem/kernels/near_kernel.h"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

namespace platen::dem::kernels {
namespace {

#if defined(__AVX2__)
constexpr int lanes = 8;
static_assert(near_spare >= lanes);

inline __m256 less(const float *from, float own) {
  return _mm256_sub_ps(_mm256_loadu_ps(from), _mm256_set1_ps(own));
}

// A bit for each of the next eight members that is near.
inline unsigned near_bits(const NearColumns &c, const NearBall &own, int m, __m256i ball) {
  const __m256 x = less(c.x + m, own.x), y = less(c.y + m, own.y), z = less(c.z + m, own.z);
  const __m256 reach = _mm256_add_ps(_mm256_loadu_ps(c.reach + m), _mm256_set1_ps(own.reach));
  const __m256 square =
      _mm256_add_ps(_mm256_add_ps(_mm256_mul_ps(x, x), _mm256_mul_ps(y, y)), _mm256_mul_ps(z, z));
  const __m256 near = _mm256_cmp_ps(square, _mm256_mul_ps(reach, reach), _CMP_LT_OQ);
  const __m256i self = _mm256_cmpeq_epi32(ball, _mm256_set1_epi32(own.ball));
  return static_cast<unsigned>(_mm256_movemask_ps(_mm256_andnot_ps(_mm256_castsi256_ps(self), near)));
}

// Writes the numbers whose bits are set, one after another; spare ones may follow.
inline void write_set(unsigned bits, __m256i ball, int *to) {
#if defined(__AVX512VL__)
  _mm256_storeu_si256(reinterpret_cast<__m256i *>(to),
                      _mm256_maskz_compress_epi32(static_cast<__mmask8>(bits), ball));
#else
  alignas(32) int number[lanes];
  _mm256_store_si256(reinterpret_cast<__m256i *>(number), ball);
  for (; bits != 0; bits &= bits - 1)
    *to++ = number[__builtin_ctz(bits)];
#endif
}
#endif

} // namespace

std::size_t PLATEN_FIND_NEAR(const NearColumns &c, const NearBall &own, int first, int last, int *found) {
  std::size_t count = 0;
#if defined(__AVX2__)
  for (int m = first; m < last; m += lanes) {
    const __m256i ball = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(c.ball + m));
    const int left = last - m;
    const unsigned bits = near_bits(c, own, m, ball) & (left < lanes ? (1u << left) - 1 : 0xffu);
    write_set(bits, ball, found + count);
    count += static_cast<std::size_t>(__builtin_popcount(bits));
  }
#else
  for (int m = first; m < last; ++m) { // no branch, because one in eight is near
    const float x = c.x[m] - own.x, y = c.y[m] - own.y, z = c.z[m] - own.z, reach = c.reach[m] + own.reach;
    found[count] = c.ball[m];
    count += (x * x + y * y + z * z < reach * reach) & (c.ball[m] != own.ball) ? 1 : 0;
  }
#endif
  return count;
}

} // namespace platen::dem::kernels
