// Horizontal bars with a name before and words after each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/style.h"

namespace platen::apps::report {

struct Bar {
  std::string name, words;
  double value = 0; // not negative
  Colour colour = colours::blue;
};

// From above to below at one scale, the longest over the whole width. `mark`, where it is above 0, draws a
// line at that value. Throws OutputError.
void save_bars(const std::string &title, const std::string &subtitle, const std::vector<Bar> &bars,
               double mark, const std::filesystem::path &png);

} // namespace platen::apps::report
