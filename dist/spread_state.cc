#include "dist/spread_state.h"

#include <algorithm>
#include <array>
#include <utility>

#include "dem/model.h"
#include "dist/ranks.h"

namespace platen::dist {
namespace {

constexpr std::array<const char *, 8> moving{"position",        "velocity",   "force",
                                             "orientation",     "torque",     "angular_velocity",
                                             "excess_velocity", "excess_spin"};

// Adds own rows; joins them with the last run where both row numbers continue it.
void add_block(SpreadRows &rows, std::size_t own, std::size_t global, std::size_t count) {
  if (count == 0) return;
  if (!rows.runs.empty()) {
    SpreadRows::Run &last = rows.runs.back();
    if (last.own + last.count == own && last.global + last.count == global) {
      last.count += count;
      return;
    }
  }
  rows.runs.push_back({own, global, count});
}

// Rows of pairs, in the order of the blocks of their first particle: this rank has those of its own blocks.
template <class FirstOf>
SpreadRows spread_pairs(const Ranks &ranks, std::size_t own_rows, const FirstOf &first_of) {
  const std::vector<int> &owner = ranks.partition().rank;
  std::vector<std::int64_t> rows_of_block(owner.size(), 0);
  for (std::size_t k = 0; k < own_rows; ++k)
    ++rows_of_block[static_cast<std::size_t>(first_of(k)) / block_rows];
  MPI_Allreduce(MPI_IN_PLACE, rows_of_block.data(), static_cast<int>(rows_of_block.size()), MPI_INT64_T,
                MPI_SUM, ranks.communicator());
  SpreadRows rows;
  std::size_t own = 0;
  for (std::size_t b = 0; b < owner.size(); ++b) {
    const std::size_t count = static_cast<std::size_t>(rows_of_block[b]);
    if (owner[b] == ranks.rank()) {
      add_block(rows, own, rows.global, count);
      own += count;
    }
    rows.global += count;
  }
  return rows;
}

bool begins_with(const std::string &text, const std::string &begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

} // namespace

bool is_moving(const std::string &column) {
  return std::find(moving.begin(), moving.end(), column) != moving.end();
}

std::vector<FilePiece> SpreadRows::pieces(const void *data, std::size_t bytes_per_row) const {
  std::vector<FilePiece> own;
  for (const Run &run : runs)
    own.push_back({run.global * bytes_per_row, static_cast<const char *>(data) + run.own * bytes_per_row,
                   run.count * bytes_per_row});
  return own;
}

SpreadState::SpreadState(const Ranks &ranks, dem::Model &model, std::string name) : name_(std::move(name)) {
  particles_.global = model.particles.size();
  for (const int block : ranks.blocks().all) {
    const std::size_t first = static_cast<std::size_t>(block) * block_rows;
    add_block(particles_, first, first, std::min(block_rows, particles_.global - first));
  }
  if (const dem::Bonds *bonds = model.bonds.get())
    tables_["bonds/rows/"] =
        spread_pairs(ranks, bonds->size(), [&](std::size_t k) { return bonds->first[k]; });
  if (!model.contacts) return;
  const dem::Contacts &contacts = *model.contacts;
  tables_["contacts/rows/"] =
      spread_pairs(ranks, contacts.table.size(), [&](std::size_t k) { return contacts.first[k]; });
  std::vector<SpreadRows> lists;
  model.contacts->search_state().visit_lists([&](const auto &list) {
    lists.push_back(spread_pairs(ranks, list.size(), [&](std::size_t k) {
      const dem::IndexPair pair = list[k];
      return pair.first;
    }));
  });
  const std::string search = "contacts/search/";
  lists_[search + "wide"] = lists.at(0);
  lists_[search + "close"] = lists.at(1);
  lists_[search + "rest_pairs"] = lists_[search + "rest_distances"] = lists.at(2);
}

const SpreadRows *SpreadState::rows_of(const std::string &block) const {
  if (!begins_with(block, name_) || table_size_in(block)) return nullptr;
  const std::string of_model = block.substr(name_.size()), particles = "particles/";
  if (begins_with(of_model, particles))
    return is_moving(of_model.substr(particles.size())) ? &particles_ : nullptr;
  if (const auto list = lists_.find(of_model); list != lists_.end()) return &list->second;
  for (const auto &[name, rows] : tables_)
    if (begins_with(of_model, name)) return &rows;
  return nullptr;
}

std::optional<std::uint64_t> SpreadState::table_size_in(const std::string &block) const {
  for (const auto &[name, rows] : tables_)
    if (block == name_ + name + "size") return rows.global;
  return std::nullopt;
}

} // namespace platen::dist
