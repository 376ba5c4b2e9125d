// A test as its program sees it, with numbers set by hand, and tasks and stages of it.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "coupling/program/drive.h"
#include "coupling/program/loading_stage.h"
#include "coupling/program/pressure_task.h"
#include "coupling/program/program.h"
#include "coupling/program/stress_task.h"

namespace platen::coupling::seen {

constexpr double dt = 1e-6, area = 2e-4; // s, m^2

struct Seen : Measures {
  double now = 0, closure = 0, stress = 0, pressure = 0, broken = 0, wider = 0;
  double time() const override { return now; }
  double time_step() const override { return dt; }
  double closure_strain() const override { return closure; }
  double closure_strain(int axis) const override { return axis == 2 ? closure : 0.1 * closure; }
  double widening(Widening) const override { return wider; }
  double axial_stress() const override { return stress; }
  double lateral_pressure() const override { return pressure; }
  double broken_bonds() const override { return broken; }
  Vector3 force(std::size_t) const override { return {0, 0, stress * area}; }
  double load(std::size_t) const override { return stress * area; }
  double moved_inward(std::size_t boundary) const override { return boundary < 2 ? 0.05 * closure : 0; }
  Vector3 inward(std::size_t boundary) const override { return {0, 0, boundary == 0 ? 1. : -1.}; }
  ServoLoad servo_load(std::size_t) const override { return {1e8, 100}; }
};

inline const PlatensOfAxis axial{{0, 1}, area, 0.1, 2}, top{{1}, area, 0.1, 2};
constexpr std::size_t lateral = 2; // place of what presses the lateral surface

using Stages = std::vector<std::unique_ptr<Stage>>;
using Tasks = std::vector<std::unique_ptr<Task>>;

inline Until until(Until::Reached what, double value, double direction = 1) {
  return {what, value, axial, direction, true};
}

inline std::unique_ptr<Stage> stage_of(const std::string &name, Tasks tasks, const StageEnd::Parameters &end,
                                       double expected = 0) {
  return std::make_unique<LoadingStage>(LoadingStage::Parameters{name, name == "consolidation", expected},
                                        std::move(tasks), StageEnd(end));
}

inline StageEnd::Parameters ends_at(Until::Reached what, double value) {
  StageEnd::Parameters end;
  end.any = {until(what, value)};
  return end;
}
inline Tasks one_task(std::unique_ptr<Task> task) {
  Tasks tasks;
  tasks.push_back(std::move(task));
  return tasks;
}

// Closes at a rate until a closure strain.
inline std::unique_ptr<Stage> at_rate(const std::shared_ptr<Drive> &drive, double rate, double ramp,
                                      const Until &end) {
  StageEnd::Parameters over;
  over.any = {end};
  over.ramp = ramp;
  return stage_of("compression", one_task(std::make_unique<RateTask>(drive, rate, ramp)), over,
                  end.value * 0.1 / std::abs(rate));
}

inline std::shared_ptr<Drive> drive_of_both(
    const std::optional<RateControl::Parameters> &control = std::nullopt) {
  return std::make_shared<Drive>(Drive::Parameters{axial, control});
}

inline StressTask::Parameters stress_of(double value, const PlatensOfAxis &platens = top) {
  StressTask::Parameters p;
  p.platens = platens, p.side = "top", p.value = value, p.servo = {10, 0.1};
  return p;
}
// What a stage before it asked of the lateral surface, Pa.
inline Transfer after_pressure(double pressure) {
  Transfer from;
  from.commands.resize(3);
  from.commands[lateral].pressure = pressure;
  return from;
}

inline std::unique_ptr<Task> stress_on_top(double stress, double ramp) {
  StressTask::Parameters p = stress_of(stress);
  p.ramp = ramp;
  p.settled_by = {axial};
  return std::make_unique<StressTask>(p);
}

inline PressureTask::Parameters to(double pressure, double ramp) {
  PressureTask::Parameters p;
  p.place = lateral;
  p.value = pressure;
  p.ramp = ramp;
  return p;
}

// All sides alike within 1 ms, and .5 ms more.
inline std::unique_ptr<Stage> consolidation(double pressure) {
  Tasks tasks;
  tasks.push_back(std::make_unique<PressureTask>(to(pressure, 1e-3)));
  tasks.push_back(stress_on_top(pressure, 1e-3));
  StageEnd::Parameters end;
  end.any = {until(Until::Reached::settled, 0)};
  end.ramp = 1e-3, end.least = 1.5e-3, end.latest = 3e-3;
  return stage_of("consolidation", std::move(tasks), end, 1.5e-3);
}

inline Stages list_of(std::unique_ptr<Stage> one) {
  Stages stages;
  stages.push_back(std::move(one));
  return stages;
}

// m/s, of a platen along z, once what a servo or a width asks of one task has come to rest.
inline double speed_of(Task &task, const Seen &seen, std::size_t boundary = 0) {
  Commands asked(3);
  for (int n = 0; n < 200; ++n)
    task.command(seen, asked);
  return asked[boundary].velocity[2];
}
inline double pressure_of(Task &task, const Seen &seen) {
  Commands asked(3);
  task.command(seen, asked);
  return asked[lateral].pressure;
}

inline Commands ask(Program &program) {
  Commands asked(3);
  program.command(asked);
  return asked;
}

} // namespace platen::coupling::seen
