// Files that name particles by their ids, one a line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <vector>

namespace platen::apps {

// The numbers of the file in its order: whole, not negative, one a line; empty lines and what follows a "#"
// are passed over. Throws InputError, naming file and line, where the file cannot be read, a line holds
// something else, or a number comes twice, or is not below the number of spheres that there are.
std::vector<int> read_id_list(const std::filesystem::path &path,
                              std::size_t spheres = std::numeric_limits<std::size_t>::max());

} // namespace platen::apps
