// What a checkpoint keeps of a problem.
#include <stdexcept>
#include <utility>

#include "coupling/problem.h"

namespace platen::coupling {

std::vector<double> Problem::numbers() const {
  std::vector<double> all{servo_ ? servo_->state()[0] : 0.0,
                          model.time,
                          time_step_,
                          static_cast<double>(steps_),
                          static_cast<double>(near_at_choice_),
                          boundary_work_,
                          reaction_top_,
                          reaction_bottom_,
                          model.works.damping,
                          model.works.fracture,
                          model.works.weight,
                          static_cast<double>(model.broken_tension),
                          static_cast<double>(model.broken_shear),
                          model.contacts ? model.contacts->friction_work : 0.0,
                          model.contacts ? model.contacts->damping_work : 0.0,
                          top_layer.friction_work,
                          top_layer.damping_work,
                          bottom_layer.friction_work,
                          bottom_layer.damping_work,
                          static_cast<double>(top_layer.closed),
                          static_cast<double>(bottom_layer.closed)};
  if (!settings_.loading.unload_at.empty())
    all.insert(all.end(), {cycle_.direction, cycle_.speed, cycle_.turns, cycle_.strain, cycle_.stress});
  if (quasi_static())
    for (const auto &[loads, body] : {std::pair{&top_loads_, &top}, std::pair{&bottom_loads_, &bottom}}) {
      const std::vector<double> more = loads->numbers(body->surface().vertices.size());
      all.insert(all.end(), more.begin(), more.end());
    }
  if (confinement_) {
    const std::vector<double> more = confinement_->numbers();
    all.insert(all.end(), more.begin(), more.end());
  }
  if (sleeve_)
    all.insert(all.end(), {sleeve_->layer.friction_work, sleeve_->layer.damping_work,
                           static_cast<double>(sleeve_->layer.closed)});
  if (cell()) all.insert(all.end(), {cell_end_, cell_closure_, path_deviator_});
  if (pace_) {
    const std::vector<double> more = pace_->state();
    all.insert(all.end(), more.begin(), more.end());
  }
  all.push_back(given_energy_);
  return all;
}

void Problem::set_numbers(const std::vector<double> &n) {
  if (n.size() != numbers().size()) throw std::invalid_argument("a checkpoint of another version");
  auto end = n.end();
  given_energy_ = *--end;
  if (pace_) {
    end -= Pace::states;
    pace_->set_state({end, end + Pace::states});
  }
  if (cell()) {
    path_deviator_ = *--end;
    cell_closure_ = *--end;
    cell_end_ = *--end;
  }
  if (sleeve_) {
    sleeve_->layer.closed = static_cast<std::size_t>(*--end);
    sleeve_->layer.damping_work = *--end;
    sleeve_->layer.friction_work = *--end;
  }
  if (confinement_) {
    const auto own = static_cast<std::ptrdiff_t>(confinement_->numbers().size());
    confinement_->set_numbers({end - own, end});
  }
  if (!settings_.loading.unload_at.empty()) cycle_ = {n[21], n[22], n[23], n[24], n[25]};
  if (quasi_static()) {
    const auto size = [](const fem::Body &body) {
      return static_cast<std::ptrdiff_t>(2 + 3 * body.surface().vertices.size());
    };
    const auto first = n.begin() + (settings_.loading.unload_at.empty() ? 21 : 26);
    top_loads_.set_numbers({first, first + size(top)});
    bottom_loads_.set_numbers({first + size(top), first + size(top) + size(bottom)});
  }
  if (servo_) servo_->set_state({n[0]});
  model.time = n[1];
  time_step_ = n[2];
  steps_ = static_cast<long>(n[3]);
  near_at_choice_ = static_cast<std::size_t>(n[4]);
  boundary_work_ = n[5];
  reaction_top_ = n[6];
  reaction_bottom_ = n[7];
  model.works = {n[8], n[9], n[10]};
  model.broken_tension = static_cast<long>(n[11]);
  model.broken_shear = static_cast<long>(n[12]);
  if (model.contacts) model.contacts->friction_work = n[13], model.contacts->damping_work = n[14];
  top_layer.friction_work = n[15];
  top_layer.damping_work = n[16];
  bottom_layer.friction_work = n[17];
  bottom_layer.damping_work = n[18];
  top_layer.closed = static_cast<std::size_t>(n[19]);
  bottom_layer.closed = static_cast<std::size_t>(n[20]);
}

void Problem::restored() {
  top_layer.restored();
  bottom_layer.restored();
  if (wall_) wall_->forget();
  if (sleeve_) sleeve_->layer.restored();
  if (model.bonds) model.bonds->restored();
  if (model.contacts) model.contacts->restored();
}

} // namespace platen::coupling
