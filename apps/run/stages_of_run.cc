#include "apps/run/stages_of_run.h"

#include "base/largest.h"

namespace platen::apps {
namespace {

Json controls_of_stage(const coupling::PlatenTest &problem, std::size_t stage) {
  Json all = Json::array();
  for (const coupling::Controlled &c : problem.program().controls(stage))
    all.push_back({{"quantity", c.quantity},
                   {"side", c.side},
                   {"asked", c.target},
                   {"reached", c.reached},
                   {"unit", c.unit},
                   {"met", c.is_met()}});
  return all;
}

// Null for a checkpoint of an older version, which does not have it.
Json ended_by(std::size_t stage, const TestRecord &test) {
  const coupling::Program &program = test.problem.program();
  if (stage < program.stages_ended()) {
    const std::string word = program.stage(stage).ended_by();
    return word.empty() ? Json() : Json(word);
  }
  const double share = test.scene.loading.stop_at_residual;
  return share > 0 && test.results.fallen_to(share) ? "stop at residual" : "stopped";
}

} // namespace

Json stages_of(const TestRecord &test) {
  const coupling::PlatenTest &problem = test.problem;
  Json stages = Json::array();
  const std::vector<Sample> &samples = test.results.samples();
  Largest largest;
  double largest_time = not_measured;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Sample &s = samples[k];
    if (!(s.stress() <= largest.value())) largest_time = s.time;
    largest.add(s.stress());
    if (k + 1 < samples.size() && samples[k + 1].stage == s.stage) continue;
    Json stage;
    stage["stage"] = static_cast<int>(s.stage);
    stage["ended_by"] = ended_by(static_cast<std::size_t>(s.stage) - 1, test);
    stage["consolidation"] =
        problem.program().stage(static_cast<std::size_t>(s.stage) - 1).is_consolidation();
    stage["end_s"] = s.time;
    stage["axial_strain_platen"] = s.strain_platen;
    stage["axial_strain_gauge"] = s.strain_gauge;
    stage["lateral_strain"] = s.lateral_strain;
    stage["axial_stress_pa"] = s.stress();
    stage["largest_axial_stress_pa"] = largest.value();
    stage["largest_axial_stress_time_s"] = largest_time;
    stage["confining_pressure_pa"] = s.confining_pressure;
    for (const int axis : {0, 1})
      if (!problem.platens_along(axis).places.empty()) {
        stage[std::string("strain_") + "xy"[axis]] = s.*platen_strain(axis);
        stage[std::string("stress_") + "xy"[axis] + "_pa"] = s.stress(axis);
      }
    stage["controls"] = controls_of_stage(problem, static_cast<std::size_t>(s.stage) - 1);
    stages.push_back(stage);
    largest = {};
  }
  return stages;
}

Json controls_of(const TestRecord &test) {
  const coupling::Program &program = test.problem.program();
  Json all = Json::array();
  for (std::size_t stage = 0; stage <= program.stage_number(); ++stage)
    for (const Json &control : controls_of_stage(test.problem, stage)) {
      Json one{{"stage", program.stage(stage).name()}};
      one.update(control);
      all.push_back(one);
    }
  return all;
}

} // namespace platen::apps
