// Check of the pairs of particles in a state before it is read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace platen::dem {

// Pairs of particle rows from two columns, or of a list of both. Throws StateError with the block and the row
// if a pair has a row at or beyond `rows`, is not (lower, higher), or is not larger than the pair before it:
// searches and sums need that order.
void require_ascending_pairs(const std::string &block, const std::vector<int> &first,
                             const std::vector<int> &second, std::size_t rows);

} // namespace platen::dem
