// Numbers from text, the same in every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace platen::apps {

// The number that the whole text is (a leading + is allowed), correctly rounded; nothing where it is none.
inline std::optional<double> number_of(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

} // namespace platen::apps
