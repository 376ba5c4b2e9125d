// The ranks: owners of blocks, sums and cracks of all ranks.
#include "dist/ranks.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "base/clock.h"
#include "dem/model.h"
#include "dist/mpi_lists.h"

namespace platen::dist {
namespace {

enum Tag { motion_tag = 11, bonds_tag = 12, contacts_tag = 13 };

} // namespace

Ranks::Ranks(MPI_Comm ranks) {
  MPI_Comm_dup(ranks, &ranks_);
  MPI_Comm_rank(ranks_, &rank_);
  MPI_Comm_size(ranks_, &size_);
  const std::size_t n = static_cast<std::size_t>(size_);
  for (auto *lists : {&bond_ghosts_, &contact_ghosts_, &bonds_from_, &contacts_from_})
    lists->resize(n);
  for (auto *lists : {&index_of_ghost_, &halo_to_, &halo_from_, &motion_to_, &motion_from_})
    lists->resize(n);
  motion_.tag = motion_tag, bonds_.tag = bonds_tag, contacts_.tag = contacts_tag;
  for (Messages *messages : {&motion_, &bonds_, &contacts_})
    messages->out.resize(n), messages->in.resize(n);

  MPI_Type_contiguous(static_cast<int>(sizeof(Sums)), MPI_BYTE, &sums_type_);
  MPI_Type_commit(&sums_type_);
  MPI_Op_create(
      [](void *in, void *in_out, int *count, MPI_Datatype *) {
        for (int k = 0; k < *count; ++k) {
          Sums a{}, b{};
          std::memcpy(&a, static_cast<char *>(in) + k * static_cast<int>(sizeof a), sizeof a);
          std::memcpy(&b, static_cast<char *>(in_out) + k * static_cast<int>(sizeof b), sizeof b);
          b.fastest = std::max(a.fastest, b.fastest);
          b.not_finite += a.not_finite;
          b.breaks += a.breaks;
          for (std::size_t l = 0; l < b.limbs.size(); ++l)
            b.limbs[l] += a.limbs[l];
          std::memcpy(static_cast<char *>(in_out) + k * static_cast<int>(sizeof b), &b, sizeof b);
        }
      },
      1, &add_sums_);
}

// After a failure other ranks may be at another call: do not wait for them.
Ranks::~Ranks() {
  if (std::uncaught_exceptions() > 0) return;
  for (Messages *messages : {&motion_, &bonds_, &contacts_})
    finish_sends(*messages);
  MPI_Op_free(&add_sums_);
  MPI_Type_free(&sums_type_);
  MPI_Comm_free(&ranks_);
}

int Ranks::owner_of(int row) const {
  return partition_.rank[static_cast<std::size_t>(row) / block_rows];
}

std::size_t Ranks::halo_rows() const {
  std::size_t sum = 0;
  for (const std::vector<int> &rows : motion_from_)
    sum += rows.size();
  return sum;
}

double Ranks::expected_bytes() const {
  std::size_t rows = 0, ghosts = 0;
  for (std::size_t r = 0; r < motion_to_.size(); ++r)
    rows += motion_to_[r].size(), ghosts += bond_ghosts_[r].size();
  return static_cast<double>(rows) * (rotation_ ? 104 : 48) +
         static_cast<double>(ghosts) * (rotation_ ? 48 : 24);
}

long Ranks::expected_messages() const {
  long messages = 0;
  for (std::size_t r = 0; r < motion_to_.size(); ++r)
    messages += !motion_to_[r].empty() + !bond_ghosts_[r].empty() + !contact_ghosts_[r].empty();
  return messages;
}

// Called once: blocks do not change ranks during a run.
void Ranks::cut(const dem::Model &model) {
  const dem::Particles &p = model.particles;
  rows_ = p.size();
  rotation_ = p.has_rotation();
  dem::PairBlocks none;
  if (!model.bonds) none.rebuild(nullptr, nullptr, 0, p.size(), rotation_);
  partition_ = dist::partition(graph_of(model.bonds ? model.bonds->blocks : none, p), ranks_);
  is_cut_ = true;
}

void Ranks::start_sums(const dem::StepSums &own) {
  ExactSum squares = own.speed_squares;
  own_sums_ = {own.fastest, squares.not_finite(), own.breaks, squares.carried()};
  MPI_Iallreduce(&own_sums_, &all_sums_, 1, sums_type_, add_sums_, ranks_, &summing_);
}

dem::StepSums Ranks::finish_sums() {
  const auto start = Clock::now();
  MPI_Wait(&summing_, MPI_STATUS_IGNORE);
  traffic_.waited += seconds_since(start);
  return {all_sums_.fastest, ExactSum::of(all_sums_.limbs, all_sums_.not_finite),
          static_cast<long>(all_sums_.breaks)};
}

void Ranks::progress() {
  int any = 0;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, ranks_, &any, MPI_STATUS_IGNORE);
}

std::vector<dem::Crack> Ranks::all_cracks(const std::vector<dem::Crack> &own) {
  std::vector<dem::Crack> all = gather_list_of_all(ranks_, own);
  std::sort(all.begin(), all.end(), [](const dem::Crack &a, const dem::Crack &b) {
    return a.time != b.time ? a.time < b.time : a.record < b.record;
  });
  return all;
}

std::vector<char> Ranks::all_bytes(const std::vector<char> &own) {
  return gather_list_of_all(ranks_, own);
}

ExactSum Ranks::all(ExactSum own) {
  Sums sums{0, own.not_finite(), 0, own.carried()};
  MPI_Allreduce(MPI_IN_PLACE, &sums, 1, sums_type_, add_sums_, ranks_);
  return ExactSum::of(sums.limbs, sums.not_finite);
}

long Ranks::all(long own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_LONG, MPI_SUM, ranks_);
  return own;
}

long Ranks::largest(long own) {
  MPI_Allreduce(MPI_IN_PLACE, &own, 1, MPI_LONG, MPI_MAX, ranks_);
  return own;
}

} // namespace platen::dist
