// Command lines that are printed to be run again: what a POSIX shell makes of them is what was meant.
#pragma once

#include <string>
#include <string_view>

namespace platen::apps {

// One word of a command line: as it is where no shell sees more in it, else in single quotes.
inline std::string shell_word(const std::string &text) {
  constexpr std::string_view plain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  std::string quoted = "'";
  for (const char c : text)
    quoted += c == '\'' ? "'\\''" : std::string(1, c);
  return quoted + "'";
}

// An entry that a command line sets: " -s 'Bond/Gap = 0.05 R_min'".
inline std::string shell_entry(const std::string &assignment) {
  return " -s " + shell_word(assignment);
}

} // namespace platen::apps
