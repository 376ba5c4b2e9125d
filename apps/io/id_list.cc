#include "apps/io/id_list.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <map>
#include <string>
#include <string_view>

#include "apps/io/errors.h"

namespace platen::apps {

std::vector<int> read_id_list(const std::filesystem::path &path, std::size_t spheres) {
  std::error_code error;
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": error: cannot be read");
  std::vector<int> ids;
  std::map<int, int> line_of;
  int number = 0;
  for (std::string whole; std::getline(stream, whole);) {
    ++number;
    constexpr const char *blanks = " \t\r";
    std::string_view text = std::string_view(whole).substr(0, whole.find('#'));
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) continue;
    text = text.substr(first, text.find_last_not_of(blanks) - first + 1);
    int id = -1;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), id);
    if (failure != std::errc() || end != text.data() + text.size() || id < 0)
      throw InputError(
          fmt::format("{}:{}: error: \"{}\" is no id. Allowed: a whole number, 0 or more, a line.",
                      path.string(), number, text.substr(0, 60)));
    if (static_cast<std::size_t>(id) >= spheres)
      throw InputError(
          fmt::format("{}:{}: error: names sphere {}, but the specimen has {}. Allowed: 0 ... {}.",
                      path.string(), number, id, spheres, spheres - 1));
    const auto [found, fresh] = line_of.try_emplace(id, number);
    if (!fresh)
      throw InputError(
          fmt::format("{}:{}: error: {} stands in line {} too.", path.string(), number, id, found->second));
    ids.push_back(id);
  }
  if (stream.bad()) throw InputError(path.string() + ": error: cannot be read to its end");
  return ids;
}

} // namespace platen::apps
