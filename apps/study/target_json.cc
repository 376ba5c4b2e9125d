// A study of a target for study.json.
#include <cmath>

#include "apps/study/study_section.h"
#include "apps/study/target_report.h"

namespace platen::apps {
namespace {

Json parts_json(const ErrorParts &parts) {
  return {{"packing", parts.packing}, {"chaos", parts.chaos}, {"speed", parts.speed}, {"step", parts.step}};
}

Json look_json(const TargetStudy &study, const TargetLook &look) {
  return {{"runs", look.runs},
          {"sphere_steps", look.work},
          {"mean", figure_of(look.estimate)},
          {"half_interval", look.half},
          {"parts", parts_json(parts_of(look.estimate.precision, look.half, study.step_error()))}};
}

Json plan_json(const TargetStudy &study, const Counts &counts) {
  const TargetCosts costs = study.figures().costs();
  Json plan = Json::array();
  for (std::size_t k = 0; k < counts.size(); ++k)
    plan.push_back({{"wave_crossings", study.state().runs.transits[k]},
                    {"packings", counts[k]},
                    {"made", study.state().made[k]},
                    {"sphere_steps_of_a_run", costs.runs[k]}});
  return plan;
}

Json one_speed_json(const OneSpeed &slow) {
  return {{"wave_crossings", slow.transits}, {"packings", slow.packings}, {"sphere_steps", slow.cost}};
}

} // namespace

Json json_of(const TargetStudy &study) {
  const Decision &decision = study.decision();
  const StudyTarget &target = study.target();
  Json all{{"figure", figure_words(study)},
           {"unit", target.figure == TargetFigure::gain ? "" : "Pa"},
           {"accuracy", target.accuracy},
           {"confidence", target.confidence},
           {"verdict", verdict_words(decision.verdict)}};
  if (!decision.estimate) return all;
  const TargetEstimate &of = *decision.estimate;
  const SizeEffect size = size_effect(study);
  all["mean"] = figure_of(of);
  all["low"] = figure_of(of) * std::exp(-decision.half),
  all["high"] = figure_of(of) * std::exp(decision.half);
  all["half_interval"] = decision.half;
  all["parts"] = parts_json(parts_of(of.precision, decision.half, study.step_error()));
  all["haste"] = {{"b", of.slope}, {"error", std::sqrt(of.precision.slope)}};
  all["scatter"] = {{"packing", std::sqrt(of.errors.spread.packing)},
                    {"chaos", std::sqrt(of.errors.spread.chaos)}};
  all["freedom"] = of.precision.freedom;
  all["without_figure"] = study.figures().without_figure();
  all["sphere_steps"] = study.figures().work();
  all["plan"] = plan_json(study, decision.plan ? decision.plan->counts : study.state().made);
  all["one_slow_speed"] = one_speed_json(one_speed_of_oracle(study));
  all["one_slow_speed_after_pilot"] = one_speed_json(one_speed_of_pilot(study));
  all["sphere_size"] = {{"change", size.change}, {"half_interval", size.half}, {"measured", size.measured}};
  if (const auto step = study.figures().of_half_step())
    all["half_step"] = {{"change", step->mean}, {"half_interval", step->half(target.confidence)}};
  all["looks"] = Json::array();
  for (const TargetLook &look : study.looks())
    all["looks"].push_back(look_json(study, look));
  return all;
}

Json costs_of(const TargetStudy &study) {
  Json costs{{"core_seconds", study.figures().seconds()}, {"looks_core_seconds", Json::array()}};
  for (const TargetLook &look : study.looks())
    costs["looks_core_seconds"].push_back(look.seconds);
  if (study.decision().estimate)
    costs["one_slow_speed_core_seconds"] = seconds_of(study, one_speed_of_oracle(study).cost);
  return costs;
}

} // namespace platen::apps
