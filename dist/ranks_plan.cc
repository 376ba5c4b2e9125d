// Plan of the messages: made when the specimen is cut, and when contacts are searched again.
#include <algorithm>
#include <iterator>

#include "dem/model.h"
#include "dist/mpi_lists.h"
#include "dist/ranks.h"

namespace platen::dist {
namespace {

void sort_once(std::vector<int> &rows) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

// Ghosts from other ranks, stored after the own ghosts, rank by rank.
template <class Ghosts>
std::vector<dem::PairBlocks::Remote> remote_ghosts(const Ghosts &from) {
  std::vector<dem::PairBlocks::Remote> remote;
  for (const auto &list : from)
    for (const auto &ghost : list)
      remote.push_back({ghost.particle, ghost.block});
  return remote;
}

} // namespace

void Ranks::scatter(dem::Model &model) {
  if (!is_cut_) cut(model);
  std::vector<char> own(partition_.rank.size(), 0);
  for (std::size_t b = 0; b < own.size(); ++b)
    own[b] = partition_.rank[b] == rank_;
  if (model.bonds) {
    model.bonds->keep_blocks(own);
    plan_bonds(model.bonds->blocks);
    model.bonds->count_and_cut();
    list_blocks(model.bonds->blocks);
  } else {
    list_blocks({});
  }
  if (model.contacts) {
    model.contacts->keep_blocks(own);
    plan_contacts(model);
  }
  plan_halo(model);
  plan_motion();
  if (rank_ != 0) // rank 0 keeps the previous sums
    model.visit_sums([](ExactSum &sum) { sum = {}; });
}

void Ranks::renew_contacts(dem::Model &model) {
  plan_contacts(model);
  plan_halo(model);
  plan_motion();
}

// Inner blocks are split into halves of equal cost, so that both messages have about the same time.
void Ranks::list_blocks(const dem::PairBlocks &bonds) {
  blocks_ = {};
  std::vector<char> outer(partition_.rank.size(), 0);
  for (const std::vector<Ghost> &list : bond_ghosts_)
    for (const Ghost &ghost : list)
      outer[static_cast<std::size_t>(ghost.block)] = 1;
  std::vector<int> inner;
  std::size_t pairs = 0, before = 0;
  const auto pairs_of = [&](int block) {
    const std::size_t b = static_cast<std::size_t>(block);
    return bonds.blocks() == 0 ? 1 : bonds.first_pair[b + 1] - bonds.first_pair[b];
  };
  for (std::size_t b = 0; b < partition_.rank.size(); ++b) {
    if (partition_.rank[b] != rank_) continue;
    blocks_.all.push_back(static_cast<int>(b));
    (outer[b] ? blocks_.outer : inner).push_back(static_cast<int>(b));
    if (!outer[b]) pairs += pairs_of(static_cast<int>(b));
  }
  for (const int block : inner) {
    (2 * before < pairs ? blocks_.first_inner : blocks_.last_inner).push_back(block);
    before += pairs_of(block);
  }
}

void Ranks::plan_bonds(dem::PairBlocks &blocks) {
  for (std::vector<Ghost> &list : bond_ghosts_)
    list.clear();
  for (std::size_t b = 0; b < blocks.blocks(); ++b)
    for (std::size_t g = blocks.first_ghost[b]; g < blocks.first_ghost[b + 1]; ++g)
      if (const int row = blocks.ghost_particle[g]; !is_own(row))
        bond_ghosts_[static_cast<std::size_t>(owner_of(row))].push_back({static_cast<int>(b), row});
  bonds_from_ = exchange_lists(ranks_, bond_ghosts_);
  blocks.remote = remote_ghosts(bonds_from_);
  cut_number_ = 0;
}

// Any near pair may come into contact, and any broken bond may become a contact.
void Ranks::plan_contacts(dem::Model &model) {
  contact_ghosts_ = bond_ghosts_;
  for (const dem::IndexPair &pair : model.contacts->search_state().wide_pairs())
    if (!is_own(pair.second))
      contact_ghosts_[static_cast<std::size_t>(owner_of(pair.second))].push_back(
          {pair.first / static_cast<int>(block_rows), pair.second});
  const auto before = [](const Ghost &a, const Ghost &b) {
    return a.block != b.block ? a.block < b.block : a.particle < b.particle;
  };
  const auto same = [](const Ghost &a, const Ghost &b) {
    return a.block == b.block && a.particle == b.particle;
  };
  for (std::vector<Ghost> &list : contact_ghosts_) {
    std::sort(list.begin(), list.end(), before);
    list.erase(std::unique(list.begin(), list.end(), same), list.end());
  }
  contacts_from_ = exchange_lists(ranks_, contact_ghosts_);
  model.contacts->blocks().remote = remote_ghosts(contacts_from_);
  model.contacts->rows_changed();
}

// Particles of other ranks in pairs of own blocks.
void Ranks::plan_halo(const dem::Model &model) {
  const auto &reached = model.contacts ? contact_ghosts_ : bond_ghosts_;
  for (std::size_t r = 0; r < reached.size(); ++r) {
    halo_from_[r].clear();
    for (const Ghost &ghost : reached[r])
      halo_from_[r].push_back(ghost.particle);
    sort_once(halo_from_[r]);
  }
  halo_to_ = exchange_lists(ranks_, halo_from_);
}

void Ranks::share_rows(const std::vector<int> *rows) {
  share_all_ = rows == nullptr;
  shared_.clear();
  if (rows != nullptr) shared_ = *rows;
  plan_motion();
}

// All ranks know the shared rows, so no message is needed for the plan.
void Ranks::plan_motion() {
  motion_to_ = halo_to_;
  motion_from_ = halo_from_;
  const auto add = [&](int row) {
    const int owner = owner_of(row);
    if (owner != rank_) {
      motion_from_[static_cast<std::size_t>(owner)].push_back(row);
      return;
    }
    for (int r = 0; r < size_; ++r)
      if (r != rank_) motion_to_[static_cast<std::size_t>(r)].push_back(row);
  };
  if (share_all_)
    for (int row = 0; row < static_cast<int>(rows_); ++row)
      add(row);
  for (const int row : shared_)
    add(row);
  for (auto *lists : {&motion_to_, &motion_from_})
    for (std::vector<int> &rows : *lists)
      sort_once(rows);
}

} // namespace platen::dist
