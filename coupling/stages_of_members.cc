// The settings of a cell and of the axial loading as stages.
#include "coupling/program_of_test.h"

#include <cmath>

namespace platen::coupling {
namespace {

using Mode = SideControl::Mode;
using Reached = Until::Reached;

SideControl side_control(SideGroup side, Mode mode, double value) {
  SideControl one;
  one.side = side, one.mode = mode, one.value = value;
  return one;
}

StageSettings consolidation(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  const double pressure = loading.cell->pressure;
  StageSettings stage;
  stage.name = "consolidation";
  stage.controls = {side_control(SideGroup::lateral, Mode::pressure, pressure),
                    side_control(SideGroup::top, Mode::stress, pressure)};
  stage.ramp = test.cell_ramp();
  stage.hold = loading.hold;
  stage.until = {{Reached::settled}};
  return stage;
}

StageSettings constant_stress(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  StageSettings stage;
  stage.name = "stress";
  SideControl control = side_control(SideGroup::top, Mode::stress, loading.top_stress);
  control.servo = test.servo_of_top();
  control.lead = 0;
  stage.controls = {control};
  stage.ramp = test.ramp();
  stage.hold = loading.hold;
  stage.until = {{Reached::time, stage.ramp + stage.hold}};
  if (std::isfinite(loading.target_strain))
    stage.until.push_back({Reached::strain, loading.target_strain, SideGroup::axial});
  return stage;
}

// Several stages, one after the other, where the platens reverse.
std::vector<StageSettings> axial_stages(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  StageSettings stage;
  stage.name = loading.tension ? "tension" : "compression";
  stage.ramp = test.ramp();
  const double rate = (loading.tension ? -1 : 1) * loading.rate;
  if (rate != 0) stage.controls = {side_control(SideGroup::axial, Mode::rate, rate)};
  if (loading.cell) {
    SideControl control = side_control(SideGroup::lateral, Mode::pressure, loading.cell->pressure);
    control.path = loading.cell->path;
    stage.controls.push_back(control);
  }
  std::vector<StageSettings> all;
  for (const double turn : loading.unload_at) {
    all.push_back(stage);
    all.back().until = {{Reached::strain, turn, SideGroup::axial}};
    all.push_back(stage);
    all.back().name = "unloading";
    if (rate != 0) all.back().controls.front().value = -rate;
    all.back().until = {{Reached::fraction_of_start, loading.unload_to, SideGroup::axial}};
  }
  if (std::isfinite(loading.target_strain))
    stage.until = {{Reached::strain, loading.target_strain, SideGroup::axial}};
  all.push_back(stage);
  return all;
}

} // namespace

std::vector<StageSettings> stages_of_members(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  std::vector<StageSettings> stages;
  if (loading.cell) stages.push_back(consolidation(test));
  if (loading.cell && loading.cell->alone) return stages;
  if (loading.servo) {
    stages.push_back(constant_stress(test));
    return stages;
  }
  const std::vector<StageSettings> axial = axial_stages(test);
  stages.insert(stages.end(), axial.begin(), axial.end());
  return stages;
}

} // namespace platen::coupling
