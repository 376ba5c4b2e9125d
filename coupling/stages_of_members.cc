// The settings of a cell and of the axial loading as stages.
#include "coupling/program_of_test.h"

#include <cmath>

namespace platen::coupling {
namespace {

using Ask = SideAsk::Ask;
using Reached = Until::Reached;

SideAsk asked(SideGroup side, Ask ask, double value) {
  SideAsk one;
  one.side = side, one.ask = ask, one.value = value;
  return one;
}

StageSettings consolidation(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  const double pressure = loading.cell->pressure;
  StageSettings stage;
  stage.name = "consolidation";
  stage.asks = {asked(SideGroup::lateral, Ask::pressure, pressure),
                asked(SideGroup::top, Ask::stress, pressure)};
  stage.ramp = test.cell_ramp();
  stage.hold = loading.hold;
  stage.until = {{Reached::settled}};
  return stage;
}

StageSettings held_stress(const PlatenTest &test) {
  const LoadingSettings &loading = test.settings().loading;
  StageSettings stage;
  stage.name = "stress";
  SideAsk ask = asked(SideGroup::top, Ask::stress, loading.top_stress);
  ask.servo = test.servo_of_top();
  ask.lead = 0;
  stage.asks = {ask};
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
  if (rate != 0) stage.asks = {asked(SideGroup::axial, Ask::rate, rate)};
  if (loading.cell) {
    SideAsk ask = asked(SideGroup::lateral, Ask::pressure, loading.cell->pressure);
    ask.path = loading.cell->path;
    stage.asks.push_back(ask);
  }
  std::vector<StageSettings> all;
  for (const double turn : loading.unload_at) {
    all.push_back(stage);
    all.back().until = {{Reached::strain, turn, SideGroup::axial}};
    all.push_back(stage);
    all.back().name = "unloading";
    if (rate != 0) all.back().asks.front().value = -rate;
    all.back().until = {{Reached::share_of_start, loading.unload_to, SideGroup::axial}};
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
    stages.push_back(held_stress(test));
    return stages;
  }
  const std::vector<StageSettings> axial = axial_stages(test);
  stages.insert(stages.end(), axial.begin(), axial.end());
  return stages;
}

} // namespace platen::coupling
