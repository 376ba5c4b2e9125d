// An experiment whose specimen is cut over ranks. Each has all boundaries and the program, and computes them
// from the same numbers: what they read of the specimen is sent to all.
#include <algorithm>
#include <iterator>
#include <set>

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
  lists_shared_ = -1;
  share_rows_of_boundaries();
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
