// An experiment whose specimen is divided over ranks. Each rank has all boundaries and the program, and
// computes them from the same numbers: the data of the specimen that they read are sent to all.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>

#include "base/parallel.h"
#include "coupling/experiment.h"

namespace platen::coupling {

long Experiment::lists_made() const {
  long lists = 0;
  for (const auto &boundary : boundaries_)
    lists += boundary->lists_made();
  return lists;
}

bool Experiment::any_rank(bool here) const {
  return model.is_cut() ? model.exchange()->all(static_cast<long>(here)) > 0 : here;
}

void Experiment::begin_sharing() {
  if (model.exchange() == nullptr || model.is_cut()) return;
  model.scatter();
  std::vector<char> own(number_of_blocks(model.particles.size()), 0);
  for (const int block : model.exchange()->blocks().all)
    own[static_cast<std::size_t>(block)] = 1;
  shared_.clear();
  for (const auto &boundary : boundaries_)
    if (SharedContacts *contacts = boundary->shared_contacts()) shared_.push_back(contacts);
  for (SharedContacts *contacts : shared_)
    contacts->compute_only(own);
  lists_shared_ = -1;
  share_rows_of_boundaries();
}

// Data of boundaries on their rows.
void Experiment::gather_rows() {
  if (!model.is_cut()) return;
  for (SharedContacts *contacts : shared_) {
    std::vector<char> own;
    contacts->put_rows(own);
    contacts->take_rows(model.exchange()->all_bytes(own));
  }
}

void Experiment::gather() {
  gather_rows();
  model.gather();
}

void Experiment::gather_motion() {
  gather_rows();
  model.gather_motion();
}

void Experiment::settle_state() {
  gather_rows();
  model.settle_state();
}

// For all boundaries in one message: the number of bytes of each, then the bytes.
void Experiment::send_loads() {
  if (model.exchange()->ranks() == 1) return;
  std::vector<char> bytes(shared_.size() * sizeof(std::uint64_t));
  std::size_t most = bytes.size();
  for (std::size_t b = 0; b < shared_.size(); ++b) {
    const std::size_t before = bytes.size();
    shared_[b]->put_loads(bytes);
    const std::uint64_t count = bytes.size() - before;
    std::memcpy(bytes.data() + b * sizeof count, &count, sizeof count);
    most += shared_[b]->most_bytes();
  }
  model.exchange()->send_to_all(bytes, most);
}

void Experiment::receive_loads() {
  if (model.exchange()->ranks() == 1) return;
  dem::StageClock::Lap lap(model.clock, dem::Stage::surfaces);
  std::vector<std::vector<char>> of_contacts(shared_.size());
  for (const dem::Exchange::Received &bytes : model.exchange()->receive_from_all()) {
    std::size_t at = shared_.size() * sizeof(std::uint64_t);
    for (std::size_t b = 0; b < shared_.size(); ++b) {
      std::uint64_t count = 0;
      std::memcpy(&count, bytes.data + b * sizeof count, sizeof count);
      of_contacts[b].insert(of_contacts[b].end(), bytes.data + at, bytes.data + at + count);
      at += count;
    }
  }
  for (std::size_t b = 0; b < shared_.size(); ++b)
    shared_[b]->take_loads(of_contacts[b]);
}

void Experiment::gather_for_boundaries(const Step &step) {
  if (!model.is_cut()) return;
  const bool any = std::any_of(boundaries_.begin(), boundaries_.end(),
                               [&](const auto &boundary) { return boundary->reads_all(step); });
  if (!any) return;
  model.settle();
  model.exchange()->gather_motion(model.particles);
}

void Experiment::share_rows_of_boundaries() {
  if (!model.is_cut() || lists_made() == lists_shared_) return;
  lists_shared_ = lists_made();
  std::set<int> rows;
  const std::vector<int> measured = rows_measured();
  rows.insert(measured.begin(), measured.end());
  for (const auto &boundary : boundaries_) {
    const std::optional<std::vector<int>> read = boundary->rows_read();
    if (!read) return model.exchange()->share_rows(nullptr);
    rows.insert(read->begin(), read->end());
  }
  const std::vector<int> all(rows.begin(), rows.end());
  model.exchange()->share_rows(&all);
}

double Experiment::work_from_outside() const {
  dem::EnergyLedger around;
  for (const auto &boundary : boundaries_)
    boundary->add_energy(around);
  const double weight = model.is_cut() ? model.exchange()->all(model.works.weight) : model.works.weight;
  return around.boundary + machine_work_ + weight;
}

} // namespace platen::coupling
