#include "apps/scene/program.h"

#include <algorithm>

namespace platen::apps {
namespace {

// "Loading/Stage" holds "Loading/Stage 3/Ramp" too, "Specimen/Flaw" all flaws.
bool holds(const std::string &part, const std::string &path) {
  if (path.rfind(part, 0) != 0) return false;
  const bool ends = path.size() == part.size() || path[part.size()] == '/';
  return ends || ((part == "Loading/Stage" || part == "Specimen/Flaw") && path[part.size()] == ' ');
}

// The length of the longest part that holds the path; 0 where none does.
std::size_t longest(const std::vector<std::string> &parts, const std::string &path) {
  std::size_t length = 0;
  for (const std::string &part : parts)
    if (holds(part, path)) length = std::max(length, part.size());
  return length;
}

} // namespace

bool Program::reads_entry(const std::string &path) const {
  if (!section.empty() && holds(section, path)) return true;
  return longest(reads, path) > longest(but, path);
}

} // namespace platen::apps
