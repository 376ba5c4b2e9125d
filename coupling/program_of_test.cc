#include "coupling/program_of_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coupling/program/drive.h"
#include "coupling/program/loading_stage.h"
#include "coupling/program/pressure_task.h"
#include "coupling/program/stress_task.h"
#include "coupling/program/widening_task.h"

namespace platen::coupling {
namespace {

using Mode = SideControl::Mode;
using Reached = Until::Reached;

// A stage whose stress does not settle ends after twice the time of ramp and hold.
constexpr double patience = 2;
// A stress that is a fraction of another, or on a path, follows with this lag in wave transits: long enough
// for waves to pass, and for the specimen's own response, which would oscillate otherwise.
constexpr double lag_of_fraction = 4;
// A pressure along a path follows with this lag, and with more where it rises more than the deviator and so
// feeds back on it: while platens accelerate within ten wave transits, it stays on its path within a percent.
constexpr double lag_of_path = 1.5;
// Velocity limit for fractions, relative to the largest closure rate.
constexpr double reserve_of_fraction = 10;
// Integral time in units of the servo's own time: the stress does not oscillate then.
constexpr double times_of_servo = 4;
// If the displacement at mid-span is prescribed, a bar oscillates in two halves, each like a bar that is
// clamped there: 6.2 times as fast as the full bar on its supports, 15.4 / (pi / 2)^2 of slender beams.
constexpr double frequency_ratio_of_halves = 6;

// Makes a program from a list of stages: groups of sides become platens by their indices.
class ProgramMaker {
public:
  ProgramMaker(const PlatenTest &test, const std::vector<StageSettings> &stages)
      : test_(test),
        settings_(stages),
        lateral_(test.sides().lateral),
        axis_(loaded_axis(test)),
        sense_(test.settings().loading.tension ? -1 : 1) {}

  std::unique_ptr<Program> operator()() {
    std::vector<std::unique_ptr<Stage>> stages;
    bool consolidates = true;
    for (const StageSettings &stage : settings_) {
      consolidates = consolidates && is_all_round(stage);
      stages.push_back(made(stage, consolidates));
    }
    return std::make_unique<Program>(test_, std::move(stages), std::move(drives_));
  }

private:
  PlatensOfAxis platens(SideGroup group) const {
    PlatensOfAxis all;
    for (const Side side : sides_of(group)) {
      const PlatensOfAxis one = test_.platens_of(side);
      all.area = one.area, all.length = one.length, all.axis = one.axis;
      all.places.insert(all.places.end(), one.places.begin(), one.places.end());
    }
    return all;
  }

  // The lateral platens of a box are two pairs.
  std::vector<SideControl> controls_of(const StageSettings &stage) const {
    std::vector<SideControl> all;
    for (const SideControl &control : stage.controls) {
      if (control.side != SideGroup::lateral || lateral_) {
        all.push_back(control);
        continue;
      }
      for (const SideGroup pair : {SideGroup::lateral_x, SideGroup::lateral_y})
        if (!platens(pair).places.empty()) all.push_back(control), all.back().side = pair;
    }
    return all;
  }

  // Whether the same stress is prescribed on all sides.
  bool is_all_round(const StageSettings &stage) const {
    const std::vector<SideControl> controls = controls_of(stage);
    std::array<bool, 3> axes{};
    for (const SideControl &control : controls) {
      if ((control.mode != Mode::stress && control.mode != Mode::pressure) ||
          control.value != controls.front().value)
        return false;
      if (lateral_ && control.side == SideGroup::lateral)
        axes[0] = axes[1] = true;
      else
        axes[static_cast<std::size_t>(platens(control.side).axis)] = true;
    }
    return !controls.empty() && axes[0] && axes[1] && axes[2];
  }

  std::shared_ptr<Drive> drive(const PlatensOfAxis &platens) {
    for (const auto &drive : drives_)
      if (drive->platens().places == platens.places) return drive;
    drives_.push_back(std::make_shared<Drive>(
        Drive::Parameters{platens, platens.axis == 2 ? test_.rate_control() : std::nullopt, sense_}));
    return drives_.back();
  }

  bool prescribes_stress(const StageSettings &stage) const {
    return std::any_of(stage.controls.begin(), stage.controls.end(), [](const SideControl &control) {
      return control.mode == Mode::stress || control.mode == Mode::fraction ||
             control.mode == Mode::pressure || control.mode == Mode::free;
    });
  }
  double ramp_of(const StageSettings &stage) const {
    if (stage.ramp > 0) return stage.ramp;
    return prescribes_stress(stage) ? test_.ramp_of_stress() : test_.ramp();
  }

  Servo::Parameters servo(const SideControl &control, const PlatensOfAxis &platens, double ramp) const {
    if (control.servo) return *control.servo;
    const bool follows = control.mode == Mode::fraction || control.mode == Mode::free;
    double stress = 0, rate = test_.axial_rate(); // largest prescribed values, Pa, m/s
    for (const StageSettings &stage : settings_)
      for (const SideControl &one : stage.controls) {
        if (one.mode == Mode::stress || one.mode == Mode::pressure) stress = std::max(stress, one.value);
        if (one.mode == Mode::rate) rate = std::max(rate, std::abs(rate_of(one)));
      }
    return test_.servo_for(stress, platens.axis, ramp,
                           follows ? reserve_of_fraction * rate : test_.axial_rate());
  }

  std::unique_ptr<Task> stress_task(const SideControl &control, double ramp, bool consolidates) const {
    StressTask::Parameters p;
    p.platens = platens(control.side);
    p.side = words_of(control.side);
    p.value = control.mode == Mode::free ? 0 : control.value;
    p.ramp = ramp;
    p.ramp_to_rest = test_.ramp();
    p.lead = std::isnan(control.lead) ? test_.lead_of_servo(p.platens) : control.lead;
    if (std::isnan(control.lead)) p.compliance = test_.machine_compliance(p.platens);
    p.servo = servo(control, p.platens, ramp);
    if (!consolidates && !control.servo && control.mode != Mode::fraction)
      p.integral_time = times_of_servo * test_.time_of_servo(p.platens);
    if (control.mode == Mode::fraction)
      p.quantity = words_of_fraction(control), p.followed = platens(control.of), p.lag = lag();
    if (p.platens.places.size() == 1) {
      p.settled_by = {test_.platens_along(p.platens.axis)};
    }
    return std::make_unique<StressTask>(p);
  }

  static std::string words_of_fraction(const SideControl &control) {
    return "share of " + words_of(control.of);
  }

  double lag() const { return lag_of_fraction * test_.facts().wave_transit; }

  std::unique_ptr<Task> pressure_task(const SideControl &control, double ramp) const {
    if (control.mode == Mode::hold) return std::make_unique<HoldPressureTask>(*lateral_);
    PressureTask::Parameters p;
    p.place = *lateral_;
    p.value = control.mode == Mode::free ? 0 : control.value;
    p.ramp = ramp;
    p.path = control.path;
    if (control.mode == Mode::fraction)
      p.quantity = words_of_fraction(control), p.followed = platens(control.of);
    if (p.path != 0) p.quantity = "stress path";
    if (p.path != 0 || p.followed) p.lag = lag();
    if (p.path != 0) p.lag = std::max(1.0, p.path) * lag_of_path * test_.facts().wave_transit;
    return std::make_unique<PressureTask>(p);
  }

  double rate_of(const SideControl &control) const {
    return (control.back ? -1 : 1) * (std::isnan(control.value) ? test_.axial_rate() : control.value);
  }

  std::unique_ptr<Task> task(const SideControl &control, double ramp, bool consolidates) {
    if (lateral_ && control.side == SideGroup::lateral) return pressure_task(control, ramp);
    const PlatensOfAxis of = platens(control.side);
    switch (control.mode) {
      case Mode::rate:
        return std::make_unique<RateTask>(drive(of), rate_of(control), ramp, words_of(control.side));
      case Mode::hold:
        return std::make_unique<HoldTask>(of, test_.ramp());
      case Mode::circumferential:
      case Mode::mouth_opening:
        return widening_task(control, of, ramp);
      default:
        return stress_task(control, ramp, consolidates);
    }
  }

  std::unique_ptr<Task> widening_task(const SideControl &control, const PlatensOfAxis &of,
                                      double ramp) const {
    WideningTask::Parameters p;
    p.platens = of;
    p.rate = control.value;
    p.ramp = ramp;
    p.transit = test_.facts().wave_transit;
    p.fastest = test_.axial_rate();
    p.of = *widening_of(control.mode);
    if (p.of == Widening::mouth) {
      p.transit = test_.bending_period() / frequency_ratio_of_halves;
      // Of a broken bar, whose halves turn by phi about its upper face: phi L / 2 over 2 phi d.
      p.closure = test_.three_points().span / (4 * test_.three_points().depth);
    }
    return std::make_unique<WideningTask>(p);
  }

  // Sides without a prescribed value hold.
  void add_holds(const std::vector<SideControl> &controls, std::vector<std::unique_ptr<Task>> &tasks) const {
    const auto is_prescribed = [&](Side side) {
      return std::any_of(controls.begin(), controls.end(), [&](const SideControl &control) {
        const std::vector<Side> sides = sides_of(control.side);
        return (control.side != SideGroup::lateral || !lateral_) &&
               std::count(sides.begin(), sides.end(), side) > 0;
      });
    };
    for (const Side side : all_sides)
      if (test_.platen(side) != nullptr && !is_prescribed(side))
        tasks.push_back(std::make_unique<HoldTask>(test_.platens_of(side), test_.ramp()));
    const bool pressed = std::any_of(controls.begin(), controls.end(), [](const SideControl &control) {
      return control.side == SideGroup::lateral;
    });
    if (lateral_ && !pressed) tasks.push_back(std::make_unique<HoldPressureTask>(*lateral_));
  }

  StageEnd end_of(const StageSettings &stage, double ramp) const {
    StageEnd::Parameters end;
    end.ramp = ramp;
    end.least = ramp + stage.hold;
    for (const StageUntil &one : stage.until) {
      Until until{one.what, one.what == Reached::settled ? 0 : one.value, platens(one.of),
                  direction(stage, one.of), lateral_.has_value()};
      if (one.what == Reached::settled)
        end.latest = std::isnan(stage.latest) ? patience * end.least : stage.latest;
      end.any.push_back(std::move(until));
    }
    return StageEnd(std::move(end));
  }

  // A strain falls where its axis is unloaded.
  double direction(const StageSettings &stage, SideGroup of) const {
    for (const SideControl &control : stage.controls)
      if (control.mode == Mode::rate && platens(control.side).axis == platens(of).axis &&
          rate_of(control) * sense_ < 0)
        return -1;
    return 1;
  }

  // s, as far as it is known.
  double expected_seconds(const StageSettings &stage, double ramp) const {
    double seconds = 0;
    for (const StageUntil &end : stage.until) {
      if (end.what == Reached::time) return end.value;
      const bool strain = end.what == Reached::strain || end.what == Reached::strain_change;
      for (const SideControl &control : stage.controls)
        if (strain && control.mode == Mode::rate && platens(control.side).axis == platens(end.of).axis &&
            direction(stage, end.of) > 0) {
          const double before = strain_before(stage, end);
          const double displacement = (end.value - before) * platens(end.of).length;
          const bool from_rest = before <= test_.settings().loading.start_strain;
          seconds =
              std::max(seconds, (from_rest ? 0.5 * ramp : 0.0) + displacement / std::abs(rate_of(control)));
        }
    }
    for (const SideControl &control : stage.controls) // the platens move as far as the specimen widens
      for (const StageUntil &end : stage.until)
        if (const auto of = widening_of(control.mode); of && of == widening_of(end.what))
          seconds = 0.5 * ramp + end.value / control.value;
    return seconds > 0 || !prescribes_stress(stage) ? seconds : ramp + stage.hold;
  }

  // The closure strain reached by the stages before, for a strain that counts from the start.
  double strain_before(const StageSettings &stage, const StageUntil &end) const {
    if (end.what != Reached::strain) return 0;
    double most = test_.settings().loading.start_strain;
    for (const StageSettings &before : settings_) {
      if (&before == &stage) break;
      for (const StageUntil &one : before.until)
        if (one.what == Reached::strain && one.of == end.of && one.value < end.value)
          most = std::max(most, one.value);
    }
    return most;
  }

  bool is_loaded(const SideControl &control) const {
    return !(lateral_ && control.side == SideGroup::lateral) && platens(control.side).axis == axis_;
  }

  // Prescribed values on sides that the test does not load are the previous ones, or new ones. A fraction
  // from the start grows with the stress that it follows, which is not a change of its own.
  void add_sides(const std::vector<SideControl> &controls, LoadingStage::Parameters &of) {
    bool changed = false;
    for (const SideControl &control : controls) {
      if (is_loaded(control) || control.mode == Mode::hold) continue;
      for (const Side side : sides_of(control.side)) {
        SideControl &last = of_sides_[static_cast<std::size_t>(side)];
        const bool same =
            last.mode == control.mode && last.of == control.of &&
            (last.value == control.value || (std::isnan(last.value) && std::isnan(control.value)));
        changed = changed || !same;
        of.changes_sides = of.changes_sides || (!same && !(control.mode == Mode::fraction && setting_ == 0));
        last = control;
      }
    }
    if (changed) ++setting_;
    of.setting = setting_;
  }

  std::unique_ptr<Stage> made(const StageSettings &stage, bool consolidates) {
    const double ramp = ramp_of(stage);
    const std::vector<SideControl> controls = controls_of(stage);
    LoadingStage::Parameters parameters{stage.name, consolidates, expected_seconds(stage, ramp), sense_};
    add_sides(controls, parameters);
    std::vector<std::unique_ptr<Task>> tasks;
    for (const SideControl &control : controls) {
      if (is_loaded(control) && control.mode != Mode::hold) parameters.loading.push_back(tasks.size());
      parameters.parts = parameters.parts || (control.mode == Mode::rate && rate_of(control) * sense_ < 0);
      tasks.push_back(task(control, ramp, consolidates));
    }
    add_holds(controls, tasks);
    return std::make_unique<LoadingStage>(std::move(parameters), std::move(tasks), end_of(stage, ramp));
  }

  const PlatenTest &test_;
  const std::vector<StageSettings> &settings_;
  std::optional<std::size_t> lateral_;
  int axis_;                                       // the loaded axis
  double sense_;                                   // 1 in compression, -1 in tension
  std::array<SideControl, side_count> of_sides_{}; // last prescribed on each side that is not loaded
  int setting_ = 0;                                // number of changes of these
  std::vector<std::shared_ptr<Drive>> drives_;
};

} // namespace

int loaded_axis(const PlatenTest &test) {
  constexpr int axial = 2;
  std::optional<int> first;
  for (const StageSettings &stage : test.settings().loading.stages)
    for (const SideControl &control : stage.controls) {
      if (control.mode != Mode::rate && !widening_of(control.mode)) continue;
      for (const Side side : sides_of(control.side)) {
        if (test.platen(side) == nullptr) continue;
        if (axis_of(side) == axial) return axial;
        if (!first) first = axis_of(side);
      }
    }
  return first.value_or(axial);
}

std::unique_ptr<Program> make_program(const PlatenTest &test) {
  const PlatenTestSettings &settings = test.settings();
  std::vector<std::unique_ptr<Stage>> own;
  for (const MadeFor<Stage> &make : settings.stages)
    own.push_back(make(test));
  if (!own.empty()) return std::make_unique<Program>(test, std::move(own));
  if (settings.loading.stages.empty()) return ProgramMaker(test, stages_of_members(test))();
  return ProgramMaker(test, settings.loading.stages)();
}

} // namespace platen::coupling
