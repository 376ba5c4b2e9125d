// Masks per lane, for kernels whose lanes take different branches; an addition to simd.inc.h.
#pragma once

#include "dem/kernels/simd.inc.h"

namespace platen::dem::kernels {
namespace {

// All bits of a lane are set, or none.
struct LaneMask {
  typedef long long Bits __attribute__((vector_size(8 * PLATEN_LANES)));
  Bits v{};
};
PLATEN_INLINE LaneMask operator&(const LaneMask &a, const LaneMask &b) {
  return {a.v & b.v};
}
PLATEN_INLINE LaneMask operator|(const LaneMask &a, const LaneMask &b) {
  return {a.v | b.v};
}
// A bit for each lane.
PLATEN_INLINE unsigned bits_of(const LaneMask &a) {
#if PLATEN_LANES == 8 && defined(__AVX512DQ__)
  return _mm512_movepi64_mask((__m512i)a.v);
#elif PLATEN_LANES == 4
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)a.v));
#elif PLATEN_LANES == 2 && defined(__SSE2__)
  return static_cast<unsigned>(_mm_movemask_pd((__m128d)a.v));
#else
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l)
    bits |= (a.v[l] != 0 ? 1u : 0u) << l;
  return bits;
#endif
}

// Operations that code for one number and for SIMD vectors needs of its type (dem/laws/lanes.h).
struct OfLanes {
  PLATEN_INLINE static LaneMask above(const Simd &a, const Simd &b) { return {a.v > b.v}; }
  PLATEN_INLINE static LaneMask at_least(const Simd &a, const Simd &b) { return {a.v >= b.v}; }
  PLATEN_INLINE static LaneMask negated(const LaneMask &a) { return {~a.v}; }
  PLATEN_INLINE static bool any(const LaneMask &a) { return bits_of(a) != 0; }
  PLATEN_INLINE static Simd choose(const LaneMask &where, const Simd &a, const Simd &b) {
    return where.v ? a.v : b.v;
  }
  PLATEN_INLINE static Simd root(const Simd &a) { return kernels::root(a); }
  PLATEN_INLINE static Simd magnitude(const Simd &a) { return kernels::magnitude(a); }
  PLATEN_INLINE static Simd with_sign(const Simd &size, const Simd &of) {
    return kernels::with_sign(size, of);
  }
};

} // namespace
} // namespace platen::dem::kernels
