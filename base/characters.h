// Characters of a text (UTF-8) that are invisible or look like others, and its line ends.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace platen {

struct Character {
  std::size_t at = 0, bytes = 0; // from the start of the text
  std::size_t column = 1;        // in characters, the first is 1
  std::string name;              // "U+00A0 (no-break space)"
};

// The first character that is invisible, a blank other than the ASCII one, or a byte that is not UTF-8. ASCII
// blanks, tabs, line ends and other controls do not count.
std::optional<Character> first_unseen(std::string_view text);
// The first character that looks like an ASCII character but is another one: Cyrillic, Greek (except the
// micro sign), full-width letters, dashes, quotes, dots.
std::optional<Character> first_look_alike(std::string_view text);
// "U+00A0 (no-break space) in column 18" for the first one of either kind; "" where there is none.
std::string text_of_odd_character(std::string_view text);

// With \n in place of \r\n and of \r.
std::string with_plain_line_ends(const std::string &text);
// With the micro sign (U+00B5) in place of the Greek letter (U+03BC).
std::string with_micro_sign(const std::string &text);

} // namespace platen
