#include "apps/io/sha256.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <vector>

namespace platen::apps {
namespace {

// First 32 bits of the fractions of the cube roots of the first 64 primes (FIPS 180-4, 4.2.2).
constexpr std::array<std::uint32_t, 64> K{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

constexpr std::uint32_t turned(std::uint32_t x, int by) {
  return (x >> by) | (x << (32 - by));
}

constexpr std::size_t chunk_bytes = 1 << 16; // of a file that is read

} // namespace

// Letters as in the standard (6.2.2).
void Sha256::take_block(const unsigned char *block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t t = 0; t < 16; ++t)
    for (std::size_t k = 0; k < 4; ++k)
      w[t] = w[t] << 8 | block[4 * t + k];
  for (std::size_t t = 16; t < 64; ++t) {
    const std::uint32_t s0 = turned(w[t - 15], 7) ^ turned(w[t - 15], 18) ^ (w[t - 15] >> 3),
                        s1 = turned(w[t - 2], 17) ^ turned(w[t - 2], 19) ^ (w[t - 2] >> 10);
    w[t] = s1 + w[t - 7] + s0 + w[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = state_;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t t1 = h + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) + ((e & f) ^ (~e & g)) +
                             K[t] + w[t],
                        t2 = (turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + t1, d = c, c = b, b = a, a = t1 + t2;
  }
  const std::array<std::uint32_t, 8> more{a, b, c, d, e, f, g, h};
  for (std::size_t k = 0; k < more.size(); ++k)
    state_[k] += more[k];
}

void Sha256::update(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t held = bytes_ % block_bytes, taken = std::min(block_bytes - held, bytes.size());
    std::memcpy(open_.data() + held, bytes.data(), taken);
    bytes_ += taken;
    bytes.remove_prefix(taken);
    if (held + taken == block_bytes) take_block(open_.data());
  }
}

std::string Sha256::text() const {
  Sha256 whole = *this;
  std::string end(1, '\x80'); // then zeros until eight bytes are left of a block, for the length in bits
  end.resize(1 + (block_bytes + 55 - bytes_ % block_bytes) % block_bytes, '\0');
  for (int shift = 56; shift >= 0; shift -= 8)
    end += static_cast<char>((8 * bytes_) >> shift);
  whole.update(end);
  std::string text;
  for (const std::uint32_t word : whole.state_)
    text += fmt::format("{:08x}", word);
  return text;
}

std::string sha256_of(std::string_view text) {
  Sha256 sum;
  sum.update(text);
  return sum.text();
}

std::optional<std::string> sha256_of_file(const std::filesystem::path &path, std::uint64_t bytes) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt; // a pipe might never end
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  Sha256 sum;
  std::vector<char> chunk(chunk_bytes);
  while (bytes > 0) {
    const auto wanted = static_cast<std::streamsize>(std::min<std::uint64_t>(chunk_bytes, bytes));
    file.read(chunk.data(), wanted);
    const auto got = static_cast<std::size_t>(file.gcount());
    sum.update({chunk.data(), got});
    bytes -= got;
    if (static_cast<std::streamsize>(got) < wanted) break;
  }
  if (file.bad()) return std::nullopt;
  return sum.text();
}

} // namespace platen::apps
