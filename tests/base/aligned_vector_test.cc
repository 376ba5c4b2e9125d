#include "base/aligned_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

namespace platen::aligned_vector_test {
namespace {

template <class T>
std::uintptr_t beside_line(const AlignedVector<T> &v) {
  return reinterpret_cast<std::uintptr_t>(v.data()) % cache_line;
}

TEST(AlignedVector, begins_at_a_cache_line_however_it_grows) {
  for (std::size_t n = 1; n < 3000; n = 3 * n + 1) {
    AlignedVector<float> single(n);
    AlignedVector<double> pushed;
    for (std::size_t k = 0; k < n; ++k)
      pushed.push_back(static_cast<double>(k));
    EXPECT_EQ(beside_line(single), 0u) << n;
    EXPECT_EQ(beside_line(pushed), 0u) << n;
    const AlignedVector<double> copy = pushed;
    EXPECT_EQ(beside_line(copy), 0u) << n;
    EXPECT_EQ(std::accumulate(copy.begin(), copy.end(), 0.0), 0.5 * static_cast<double>(n * (n - 1)));
  }
}

} // namespace
} // namespace platen::aligned_vector_test
