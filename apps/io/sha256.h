// SHA-256 (FIPS 180-4), as `sha256sum` gives it: what files were when a run wrote or read them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace platen::apps {

// Of a stream of bytes; a copy goes on by itself.
class Sha256 {
public:
  void update(std::string_view bytes);
  std::string text() const; // of all bytes until now, 64 hexadecimal digits

private:
  static constexpr std::size_t block_bytes = 64;
  void take_block(const unsigned char *block);
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, block_bytes> open_{}; // bytes of a block that is not whole yet
  std::uint64_t bytes_ = 0;
};

std::string sha256_of(std::string_view text);
// Of the first `bytes` of a file, all where it has no more; nothing where it is no regular file, or cannot be
// read.
std::optional<std::string> sha256_of_file(const std::filesystem::path &path,
                                          std::uint64_t bytes = UINT64_MAX);

} // namespace platen::apps
