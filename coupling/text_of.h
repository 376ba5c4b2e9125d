// A number as messages show it.
#pragma once

#include <sstream>
#include <string>

namespace platen::coupling {

inline std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

} // namespace platen::coupling
