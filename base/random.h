// A small generator of random numbers that gives the same stream on every machine and with every standard
// library: xoshiro256++ (Blackman and Vigna 2021, ACM TOMS 47:36), seeded through splitmix64 (Steele et al.
// 2014).
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/vector3.h"

namespace platen {

// The next word of splitmix64, very different for neighbouring seeds.
inline std::uint64_t split_mix(std::uint64_t &state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

class Random {
public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t &word : state_)
      word = split_mix(seed);
  }

  std::uint64_t next() {
    const std::uint64_t result = rotated(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0], state_[3] ^= state_[1], state_[1] ^= state_[2], state_[0] ^= state_[3];
    state_[2] ^= t, state_[3] = rotated(state_[3], 45);
    return result;
  }
  // In [0, 1), multiples of 2^-53.
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // In [0, n), n > 0; the bias of the multiplication is below n / 2^32.
  std::uint64_t below(std::uint64_t n) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(n));
  }
  // Uniform on the unit sphere, by rejection (no sine or cosine, whose last bit differs between libraries).
  Vector3 direction() {
    for (;;) {
      const Vector3 v{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      const double s = norm_squared(v);
      if (s > 1e-4 && s <= 1.0) return v / std::sqrt(s);
    }
  }
  // Fisher-Yates; Values has size() and operator[].
  template <class Values>
  void shuffle(Values &values) {
    for (std::size_t k = values.size(); k > 1; --k) {
      const std::size_t other = static_cast<std::size_t>(below(k));
      const auto kept = values[k - 1];
      values[k - 1] = values[other], values[other] = kept;
    }
  }

private:
  static std::uint64_t rotated(std::uint64_t x, int k) { return (x << k) | (x >> (64 - k)); }
  std::uint64_t state_[4];
};

} // namespace platen
