// Body of the contact kernels; the including file sets PLATEN_LANES and PLATEN_KERNEL. Compiled without
// contraction: every instruction set finds the same rows.
#include "dem/kernels/contact_kernel.h"
#include "dem/kernels/pack.inc.h"

namespace platen::dem::kernels {
namespace {

// Which of the next rows touched, a bit each.
PLATEN_INLINE unsigned set_lanes(const int *from) {
#if PLATEN_LANES == 8
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(from));
  return _mm256_test_epi32_mask(all, all);
#else
  unsigned bits = 0;
  for (int l = 0; l < lanes; ++l)
    bits |= (from[l] != 0 ? 1u : 0u) << l;
  return bits;
#endif
}

PLATEN_INLINE unsigned lanes_at_work(const ContactColumns &c, std::size_t k) {
  const Triple<Pack> d = gather_difference(c.position, c.second + k, c.first + k);
  const Pack rest = load(c.rest_distance + k);
  const Pack square = d.x * d.x + d.y * d.y + d.z * d.z;
  return (all_lanes & ~lanes_at_least(square, rest * rest)) | set_lanes(c.touching + k);
}

PLATEN_INLINE bool is_at_work(const ContactColumns &c, std::size_t k) {
  const Vector3 &a = c.position[c.first[k]], &b = c.position[c.second[k]];
  const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, rest = c.rest_distance[k];
  return !(x * x + y * y + z * z >= rest * rest) || c.touching[k] != 0;
}

} // namespace

std::size_t PLATEN_KERNEL(const ContactColumns &c, std::size_t first, std::size_t last, int *rows) {
  std::size_t found = 0, k = first;
  for (; k + lanes <= last; k += lanes)
    for (unsigned bits = lanes_at_work(c, k); bits != 0; bits &= bits - 1)
      rows[found++] = static_cast<int>(k) + __builtin_ctz(bits);
  for (; k < last; ++k)
    if (is_at_work(c, k)) rows[found++] = static_cast<int>(k);
  return found;
}

} // namespace platen::dem::kernels
