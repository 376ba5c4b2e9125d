// How a problem is loaded: the cell, the servo, the platens' speeds, cycles.
#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/problem.h"

namespace platen::coupling {
namespace {

// A cell's pressure rises over this many wave crossings where nothing else is said.
constexpr double crossings_of_cell = 60;
// Of a specimen in contact the servo may be as quick as it can. Its time constant is then that of its
// dashpot, ten impedances, over the specimen's stiffness: ten wave crossings, more where ends are soft. What
// it is told runs ahead by that, so that the stress on the platens keeps up with the pressure. A slower servo
// gets as much more time.
constexpr double gain_of_cell = 10, crossings_ahead = 9;
// The platens take over when the axial stress is as near to the pressure as this share of it, or after as
// much time again as pressure and hold have had.
constexpr double settled_share = 0.01, patience = 2;
// The servo may move the platen this many times as fast as the specimen shortens under the rising pressure.
constexpr double servo_reserve = 10;
// A path follows the deviator with this lag in wave crossings: long enough for waves to pass, and for the
// specimen's own answer to the pressure, which would ring otherwise.
constexpr double lag_of_path = 4;
// Areas of the skin are looked at in every step that is a multiple of this.
constexpr long steps_between_skins = 400;

double smooth_start(double x) {
  return x >= 1 ? 1.0 : x * x * (3 - 2 * x);
}

} // namespace

void Problem::start_cell(const CellSettings &cell, double bond) {
  const double gain = settings_.loading.servo_gain > 0 ? settings_.loading.servo_gain : gain_of_cell;
  slowness_ = gain_of_cell / gain;
  cell_ramp_ = cell.ramp > 0 ? cell.ramp : slowness_ * crossings_of_cell * wave_crossing_;
  if (!(cell_ramp_ > 0))
    throw BadSetup("Loading/Confining ramp",
                   "has to be given: without bonds there is no wave to take it from.");
  cell_end_ = std::numeric_limits<double>::infinity();
  try {
    if (cell.sleeve)
      start_sleeve(cell, bond, std::max(1.0, cell.sleeve->mass_scaling));
    else
      confinement_ = std::make_unique<dem::Confinement>(model.particles, model.bonds.get(), shape_,
                                                        end_planes(), cell.area);
  } catch (const std::invalid_argument &e) {
    throw BadSetup("Loading/Confinement", std::string("cannot be: ") + e.what() + ".");
  }
  const double stiffness = voigt_modulus_ > 0 ? voigt_modulus_ : std::numeric_limits<double>::infinity();
  const double fastest = servo_reserve * cell.pressure / stiffness * shape_.height / cell_ramp_;
  servo_ = std::make_unique<Servo>(Servo::Parameters{gain, std::max(fastest, settings_.loading.rate)});
}

double Problem::cell_pressure() const {
  const CellSettings &cell = *settings_.loading.cell;
  if (cell.path != 0 && axial_stage()) return std::max(0.0, cell.pressure + cell.path * path_deviator_);
  return smooth_start(model.time / cell_ramp_) * cell.pressure;
}

// Time constant of the servo times the rate of the pressure, Pa.
double Problem::lead_of_cell(double time) const {
  const double x = time / cell_ramp_;
  const double rate = x < 1 ? 6 * x * (1 - x) / cell_ramp_ * settings_.loading.cell->pressure : 0.0;
  return slowness_ * crossings_ahead * wave_crossing_ * rate;
}

void Problem::look_at_cell() {
  const double stress = 0.5 * (stress_top() + stress_bottom()), pressure = confining_pressure();
  if (model.time >= cell_end_) {
    const double share = std::min(1.0, time_step_ / (lag_of_path * wave_crossing_));
    path_deviator_ += share * (stress - pressure - path_deviator_);
    return;
  }
  const double least = cell_ramp_ + settings_.loading.cell->hold;
  const bool near = std::abs(stress - pressure) < settled_share * pressure;
  if (model.time >= least && (near || model.time >= patience * least)) {
    cell_end_ = model.time;
    cell_closure_ = closure_strain();
  }
}

void Problem::set_platen_speeds() {
  const LoadingSettings &loading = settings_.loading;
  const double middle = model.time - 0.5 * time_step_;
  const bool confining = cell() && middle < cell_end_;
  const double begun = confining || !cell() ? middle : middle - cell_end_;
  const double whole = confining ? cell_ramp_ : ramp_;
  const double start = whole > 0 ? smooth_start(begun / whole) : 1.0;
  if (servo_ && (confining || loading.servo)) {
    const double wanted =
        (confining ? start * loading.cell->pressure + lead_of_cell(middle) : start * loading.top_stress) *
        nominal_area();
    top.set_velocity(
        {0, 0, -servo_->velocity(wanted, reaction_top_, top_layer.servo_load(model.particles), time_step_)});
    bottom.set_velocity({0, 0, 0});
    return;
  }
  double speed = (loading.tension ? -0.5 : 0.5) * loading.rate * start;
  if (!loading.unload_at.empty()) {
    const double most = ramp_ > 0 ? 2 * time_step_ / ramp_ : 2.0;
    cycle_.speed += std::clamp(cycle_.direction - cycle_.speed, -most, most);
    speed *= cycle_.speed;
  }
  if (pace_ && axial_stage()) speed *= pace_->factor(model.time, time_step_);
  top.set_velocity({0, 0, -speed});
  bottom.set_velocity({0, 0, speed});
}

double Problem::confining_pressure() const {
  if (confinement_) return confinement_->pressure();
  if (sleeve_) return sleeve_->pressure();
  if (!wall_) return 0;
  const dem::EndPlanes planes = end_planes();
  return wall_->pressure(planes.high - planes.low);
}

void Problem::turn_round() {
  const LoadingSettings &loading = settings_.loading;
  const double pressure = cell() ? confining_pressure() : 0.0;
  const double deviator = 0.5 * (stress_top() + stress_bottom()) - pressure;
  const double stress = loading.tension ? -deviator : deviator;
  const std::size_t turns = static_cast<std::size_t>(cycle_.turns);
  if (cycle_.direction > 0 && turns < loading.unload_at.size() && loaded_strain() >= loading.unload_at[turns])
    cycle_ = {-1, cycle_.speed, cycle_.turns + 1, loaded_strain(), stress};
  else if (cycle_.direction < 0 && stress <= loading.unload_to * cycle_.stress)
    cycle_.direction = 1;
}

void Problem::press_skin() {
  confinement_->add_forces(model.particles, model.bonds.get(), end_planes(), cell_pressure(), time_step_,
                           model.last_motion().fastest * time_step_, steps_ % steps_between_skins == 0);
}

} // namespace platen::coupling
