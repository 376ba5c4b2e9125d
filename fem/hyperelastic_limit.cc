// The largest step of a HyperelasticSolid: the highest frequency of its assembled stiffness.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "fem/hyperelastic_solid.h"
#include "fem/largest_frequency.h"

namespace platen::fem {
namespace {

constexpr std::size_t cell_grain = 64;

} // namespace

// One block for each pair of nodes that share a cell.
void HyperelasticSolid::lay_out_stiffness() {
  std::vector<int> beside;
  stiffness_.begin.push_back(0);
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
    beside.clear();
    for (std::size_t k = mesh_.first_corner[n]; k < mesh_.first_corner[n + 1]; ++k)
      for (const int other : mesh_.cell_nodes[mesh_.corner[k] / 8])
        beside.push_back(other);
    std::sort(beside.begin(), beside.end());
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    stiffness_.column.insert(stiffness_.column.end(), beside.begin(), beside.end());
    stiffness_.begin.push_back(stiffness_.column.size());
  }
}

// The symmetric part: that of the pressure is symmetric but for its rims.
void HyperelasticSolid::assemble(const std::vector<CellStiffness> &cells, BlockRows &rows) const {
  rows.values.assign(9 * rows.column.size(), 0.0);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < 8; ++b) {
        double *block = rows.block(index(mesh_.cell_nodes[c][a]), mesh_.cell_nodes[c][b]);
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t m = 3 * a + i, n = 3 * b + j;
            block[3 * i + j] += 0.5 * (cells[c][24 * m + n] + cells[c][24 * n + m]);
          }
      }
}

// At most the largest of one cell, with the cell's own share of the masses (Irons, Treharne 1971; each
// pressed face belongs to one cell). Neighbours that share nodes seldom swing so all at once.
double HyperelasticSolid::stable_step() const {
  struct Largest {
    double value = 0;
    void operator+=(const Largest &other) { value = std::max(value, other.value); }
  };
  std::vector<CellStiffness> cells(mesh_.cells.size());
  const auto look = [&](std::size_t first, std::size_t last) {
    Largest largest;
    for (std::size_t c = first; c < last; ++c) {
      cells[c] = total_stiffness(c);
      largest += {eigenvalue_bound(cells[c], mesh_.cells[c].share) / material_.density};
    }
    return largest;
  };
  const double bound = ordered_sum<Largest>(mesh_.cells.size(), look, cell_grain).value;
  if (!(bound > 0)) return std::numeric_limits<double>::infinity();
  BlockRows rows = stiffness_;
  assemble(cells, rows);
  Held held(led_.size());
  for (std::size_t n = 0; n < led_.size(); ++n)
    for (std::size_t k = 0; k < 3; ++k)
      held[n][k] = is_led(n, k);
  return 2 / std::sqrt(largest_eigenvalue(rows, mass_, held, bound));
}

} // namespace platen::fem
