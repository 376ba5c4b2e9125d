// Numbers as texts of messages and files.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>

namespace platen {

// The shortest decimal text that reads back to the same double; "" for NaN.
inline std::string shortest_text(double value) {
  if (std::isnan(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  std::string shortest(text.data(), end);
  const auto exponent = shortest.find('e'); // 1e+06 is read more easily as 1e6
  if (exponent == std::string::npos) return shortest;
  const std::size_t sign = shortest[exponent + 1] == '-' ? 1 : 0;
  const std::size_t digits = shortest.find_first_not_of("+-0", exponent + 1);
  return shortest.substr(0, exponent + 1) + std::string(sign, '-') + shortest.substr(digits);
}

// With six digits, for messages.
inline std::string text_of(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

} // namespace platen
