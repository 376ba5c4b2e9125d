#include "apps/output/sha256.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <vector>

namespace platen::apps {
namespace {

constexpr std::uint64_t chunk_bytes = 1 << 16; // of a file that is read

class Sha256 {
public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }
  void add(std::string_view bytes) { EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()); }
  std::string text() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int bytes = 0;
    EVP_DigestFinal_ex(context_.get(), digest.data(), &bytes);
    std::string text;
    for (unsigned int k = 0; k < bytes; ++k)
      text += fmt::format("{:02x}", digest[k]);
    return text;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

} // namespace

std::string sha256_of(std::string_view text) {
  Sha256 sum;
  sum.add(text);
  return sum.text();
}

std::optional<std::string> sha256_of_file(const std::filesystem::path &path, std::uint64_t bytes) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt; // a pipe might never end
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  Sha256 sum;
  std::vector<char> chunk(chunk_bytes);
  while (bytes > 0 && file) {
    file.read(chunk.data(), static_cast<std::streamsize>(std::min(chunk_bytes, bytes)));
    sum.add({chunk.data(), static_cast<std::size_t>(file.gcount())});
    bytes -= static_cast<std::uint64_t>(file.gcount());
  }
  if (file.bad()) return std::nullopt;
  return sum.text();
}

} // namespace platen::apps
