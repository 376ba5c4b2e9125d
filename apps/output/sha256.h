// SHA-256 (FIPS 180-4) by OpenSSL, as `sha256sum` prints it: what files were when a run wrote or read them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace platen::apps {

std::string sha256_of(std::string_view text); // 64 hexadecimal digits
// Of the first `bytes` of a file, or of all if it has no more; nothing if it is no regular file or cannot be
// read.
std::optional<std::string> sha256_of_file(const std::filesystem::path &path,
                                          std::uint64_t bytes = UINT64_MAX);

} // namespace platen::apps
