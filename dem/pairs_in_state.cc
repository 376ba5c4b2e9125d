#include "dem/pairs_in_state.h"

#include "base/state.h"
#include "dem/cell_grid.h"

namespace platen::dem {

void require_ascending_pairs(const std::string &block, const std::vector<int> &first,
                             const std::vector<int> &second, std::size_t rows) {
  for (std::size_t k = 0; k < first.size(); ++k) {
    const IndexPair pair{first[k], second[k]};
    const bool is_pair =
        pair.first >= 0 && pair.first < pair.second && static_cast<std::size_t>(pair.second) < rows;
    if (!is_pair || (k > 0 && !(IndexPair{first[k - 1], second[k - 1]} < pair)))
      refuse_row(block, k, std::to_string(pair.first) + " and " + std::to_string(pair.second),
                 "pairs of rows, the lower first, below " + std::to_string(rows) + " and ascending");
  }
}

} // namespace platen::dem
