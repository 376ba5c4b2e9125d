// Numbers and cells from text, the same in every locale.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace platen::apps {

// The number that the whole text is (a leading + is allowed), correctly rounded; nothing where it is none.
inline std::optional<double> number_of(std::string_view text) {
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

// Without the blanks around it, those of CR LF among them.
inline std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// The texts between the commas of a line without quotes: "time_s,stress_pa". None in an empty line.
inline std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0, comma = 0; !line.empty() && comma != line.npos; begin = comma + 1) {
    comma = line.find(',', begin);
    cells.emplace_back(line.substr(begin, comma - begin));
  }
  return cells;
}

} // namespace platen::apps
