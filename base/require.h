// Check of a caller's arguments.
#pragma once

#include <stdexcept>
#include <string>

namespace platen {

// Throws std::invalid_argument with the text, "part: what is wrong".
inline void require(bool holds, const std::string &text) {
  if (!holds) throw std::invalid_argument(text);
}

} // namespace platen
