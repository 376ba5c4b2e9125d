// Tables and motion of all ranks, in the same order as on one rank.
#include <algorithm>
#include <cstring>

#include "dem/model.h"
#include "dist/mpi_lists.h"
#include "dist/ranks.h"
#include "dist/spread_state.h"

namespace platen::dist {
namespace {

std::size_t block_of(int row) {
  return static_cast<std::size_t>(row) / block_rows;
}

} // namespace

// Ranks send their blocks in order; the copy then restores the order of all blocks.
std::vector<char> Ranks::gather_bytes(const void *own, std::size_t width,
                                      const std::vector<std::int64_t> &rows_of_block) const {
  std::vector<int> counts(static_cast<std::size_t>(size_), 0);
  for (std::size_t b = 0; b < rows_of_block.size(); ++b)
    counts[static_cast<std::size_t>(partition_.rank[b])] += static_cast<int>(rows_of_block[b]);
  const std::vector<int> at = starts(counts);
  const std::size_t rows = static_cast<std::size_t>(at.back() + counts.back());
  std::vector<char> by_rank(rows * width), all(rows * width);
  const Bytes type(width);
  MPI_Allgatherv(own, counts[static_cast<std::size_t>(rank_)], type, by_rank.data(), counts.data(), at.data(),
                 type, ranks_);
  std::vector<std::size_t> next(at.begin(), at.end());
  std::size_t to = 0;
  for (std::size_t b = 0; b < rows_of_block.size(); ++b) {
    const std::size_t n = static_cast<std::size_t>(rows_of_block[b]);
    std::size_t &from = next[static_cast<std::size_t>(partition_.rank[b])];
    if (n > 0) std::memcpy(all.data() + to * width, by_rank.data() + from * width, n * width);
    from += n, to += n;
  }
  return all;
}

void Ranks::gather_columns(Table &table, const std::vector<std::int64_t> &rows_of_block) {
  std::vector<std::vector<char>> all;
  for (const auto &column : table.columns())
    all.push_back(gather_bytes(column->bytes(), column->bytes_per_row(), rows_of_block));
  std::size_t rows = 0;
  for (const std::int64_t n : rows_of_block)
    rows += static_cast<std::size_t>(n);
  table.resize(rows);
  for (std::size_t c = 0; c < all.size(); ++c)
    if (rows > 0) std::memcpy(table.columns()[c]->bytes(), all[c].data(), all[c].size());
}

void Ranks::gather_table(Table &table, const int *first, std::size_t rows) {
  std::vector<std::int64_t> rows_of_block(partition_.rank.size(), 0);
  for (std::size_t k = 0; k < rows; ++k)
    ++rows_of_block[block_of(first[k])];
  MPI_Allreduce(MPI_IN_PLACE, rows_of_block.data(), static_cast<int>(rows_of_block.size()), MPI_INT64_T,
                MPI_SUM, ranks_);
  gather_columns(table, rows_of_block);
}

template <class Row>
void Ranks::gather_list(std::vector<Row> &list) {
  std::vector<std::int64_t> rows_of_block(partition_.rank.size(), 0);
  for (const dem::IndexPair pair : list)
    ++rows_of_block[block_of(pair.first)];
  MPI_Allreduce(MPI_IN_PLACE, rows_of_block.data(), static_cast<int>(rows_of_block.size()), MPI_INT64_T,
                MPI_SUM, ranks_);
  const std::vector<char> all = gather_bytes(list.data(), sizeof(Row), rows_of_block);
  list.resize(all.size() / sizeof(Row));
  if (!all.empty()) std::memcpy(static_cast<void *>(list.data()), all.data(), all.size());
}

void Ranks::gather_particles(dem::Particles &p) {
  std::vector<std::int64_t> rows_of_block(partition_.rank.size());
  for (std::size_t b = 0; b < rows_of_block.size(); ++b)
    rows_of_block[b] = static_cast<std::int64_t>(std::min(block_rows, p.size() - b * block_rows));
  std::vector<char> own;
  for (const auto &column : p.table.columns()) {
    if (!is_moving(column->name())) continue;
    const std::size_t width = column->bytes_per_row();
    char *bytes = static_cast<char *>(column->bytes());
    own.clear();
    for (const int block : blocks_.all) {
      const std::size_t b = static_cast<std::size_t>(block);
      const char *from = bytes + b * block_rows * width;
      own.insert(own.end(), from, from + static_cast<std::size_t>(rows_of_block[b]) * width);
    }
    const std::vector<char> all = gather_bytes(own.data(), width, rows_of_block);
    std::memcpy(bytes, all.data(), all.size());
  }
}

void Ranks::gather(dem::Model &model) {
  gather_particles(model.particles);
  if (model.bonds) {
    dem::Bonds &bonds = *model.bonds;
    gather_table(bonds.table, bonds.first.data(), bonds.size());
    bonds.count_rows();
  }
  if (model.contacts) {
    dem::Contacts &contacts = *model.contacts;
    gather_table(contacts.table, contacts.first.data(), contacts.table.size());
    contacts.search_state().visit_lists([&](auto &list) { gather_list(list); });
    contacts.rows_changed();
  }
  model.visit_sums([&](ExactSum &sum) { sum = all(sum); });
}

void Ranks::gather_blocks(void *of_blocks, std::size_t bytes) {
  std::vector<char> own;
  const char *first = static_cast<const char *>(of_blocks);
  for (const int block : blocks_.all) {
    const char *of_block = first + static_cast<std::size_t>(block) * bytes;
    own.insert(own.end(), of_block, of_block + bytes);
  }
  const std::vector<char> all =
      gather_bytes(own.data(), bytes, std::vector<std::int64_t>(partition_.rank.size(), 1));
  std::memcpy(of_blocks, all.data(), all.size());
}

void Ranks::sum_up(dem::Model &model) {
  model.visit_sums([&](ExactSum &sum) {
    sum = all(sum);
    if (rank_ != 0) sum = {};
  });
}

void Ranks::gather_motion(dem::Particles &p) {
  std::vector<std::int64_t> rows_of_block(partition_.rank.size());
  for (std::size_t b = 0; b < rows_of_block.size(); ++b)
    rows_of_block[b] = static_cast<std::int64_t>(std::min(block_rows, p.size() - b * block_rows));
  const auto gather_column = [&](auto &column) {
    std::vector<std::decay_t<decltype(column[0])>> own;
    for (const int block : blocks_.all) {
      const std::size_t first = static_cast<std::size_t>(block) * block_rows;
      own.insert(own.end(), column.data() + first,
                 column.data() + first + rows_of_block[static_cast<std::size_t>(block)]);
    }
    const std::vector<char> all = gather_bytes(own.data(), column.bytes_per_row(), rows_of_block);
    std::memcpy(column.bytes(), all.data(), all.size());
  };
  gather_column(p.position);
  gather_column(p.velocity);
  if (!rotation_) return;
  gather_column(*p.orientation);
  gather_column(*p.angular_velocity);
}

} // namespace platen::dist
