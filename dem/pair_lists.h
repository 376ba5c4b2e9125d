// Rows sorted by a pair of particles, in one list per block of first particles, so that adding a pair moves
// rows of its block only.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "dem/cell_grid.h"

namespace platen::dem {

// Row converts to the IndexPair by which it is sorted.
template <class Row>
class PairLists {
public:
  // Rows must be sorted.
  void assign(const std::vector<Row> &rows) {
    blocks_.clear();
    auto from = rows.begin();
    while (from != rows.end()) {
      const std::size_t block = block_of(*from);
      const auto to =
          std::partition_point(from, rows.end(), [&](const Row &r) { return block_of(r) == block; });
      list_of(block).assign(from, to);
      from = to;
    }
    size_ = rows.size();
  }
  // Returns whether the pair is new. Otherwise its row is not changed.
  bool insert(const Row &row) {
    std::vector<Row> &list = list_of(block_of(row));
    const auto at = place(list, row);
    if (at != list.end() && IndexPair(*at) == IndexPair(row)) return false;
    moved_ += static_cast<std::size_t>(list.end() - at) + 1;
    list.insert(at, row);
    ++size_;
    return true;
  }
  // Null if there is none.
  const Row *find(IndexPair pair) const {
    const std::size_t block = block_of(pair);
    if (block >= blocks_.size()) return nullptr;
    const auto at = place(blocks_[block], pair);
    return at != blocks_[block].end() && IndexPair(*at) == pair ? &*at : nullptr;
  }
  Row *find(IndexPair pair) { return const_cast<Row *>(std::as_const(*this).find(pair)); }
  // Rows for which keep(row) is true.
  template <class Keep>
  std::vector<Row> rows_if(const Keep &keep) const {
    std::vector<Row> rows;
    for (const std::vector<Row> &list : blocks_)
      std::copy_if(list.begin(), list.end(), std::back_inserter(rows), keep);
    return rows;
  }
  // All rows, in order.
  std::vector<Row> rows() const {
    std::vector<Row> rows;
    rows.reserve(size_);
    for (const std::vector<Row> &list : blocks_)
      rows.insert(rows.end(), list.begin(), list.end());
    return rows;
  }
  std::size_t size() const { return size_; }
  std::size_t bytes() const { // in memory
    std::size_t sum = blocks_.capacity() * sizeof(blocks_[0]);
    for (const std::vector<Row> &list : blocks_)
      sum += list.capacity() * sizeof(Row);
    return sum;
  }
  // Written by insert() so far.
  std::size_t bytes_moved() const { return moved_ * sizeof(Row); }

private:
  static std::size_t block_of(IndexPair pair) { return static_cast<std::size_t>(pair.first) / block_rows; }
  template <class List>
  static auto place(List &list, IndexPair pair) {
    return std::lower_bound(list.begin(), list.end(), pair, [](IndexPair a, IndexPair b) { return a < b; });
  }
  std::vector<Row> &list_of(std::size_t block) {
    if (block >= blocks_.size()) blocks_.resize(block + 1);
    return blocks_[block];
  }

  std::vector<std::vector<Row>> blocks_;
  std::size_t size_ = 0, moved_ = 0;
};

} // namespace platen::dem
