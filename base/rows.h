// Rows are numbered by int everywhere.
#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace platen {

constexpr std::size_t most_rows = std::numeric_limits<int>::max();

// Throws std::length_error for more spheres, bonds, pairs than can be numbered.
inline void require_rows(std::size_t rows) {
  if (rows > most_rows)
    throw std::length_error(std::to_string(rows) + " rows are more than can be numbered: " +
                            std::to_string(most_rows) + " at most. Larger spheres need fewer");
}

} // namespace platen
