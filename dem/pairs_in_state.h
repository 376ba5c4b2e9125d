// What pairs of particles must be in a state that is about to be read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace platen::dem {

// Pairs of particle rows from two columns, or of a list of both. Throws StateError, naming the block and the
// row, where a pair names a row at or beyond `rows`, is not (lower, higher), or does not stand behind the one
// before it: searches and sums go by that order.
void require_ascending_pairs(const std::string &block, const std::vector<int> &first,
                             const std::vector<int> &second, std::size_t rows);

} // namespace platen::dem
