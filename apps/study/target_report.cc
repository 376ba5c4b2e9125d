#include "apps/study/target_report.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/study/tables.h"

namespace platen::apps {
namespace {

constexpr double percent = 0.01, pa_in_mpa = 1e-6, pa_in_gpa = 1e-9;

const StudyTarget &target_of(const TargetStudy &study) {
  return study.setup().scene.study.target;
}

std::string figure_words(const TargetStudy &study) {
  switch (target_of(study).figure) {
    case TargetFigure::strength:
      return "strength";
    case TargetFigure::modulus:
      return "Young's modulus";
    case TargetFigure::gain:
      return "gain of strength";
  }
  return "";
}

std::string parts_text(const ErrorParts &parts) {
  return fmt::format("packings {:.2g}, chaos {:.2g}, speed {:.2g}, step {:.2g} %", parts.packing / percent,
                     parts.chaos / percent, parts.speed / percent, parts.step / percent);
}

// Seconds of one core for so much work, by what runs took so far.
double seconds_of(const TargetStudy &study, double work) {
  return study.figures().work() > 0 ? work * study.figures().seconds() / study.figures().work()
                                    : std::nan("");
}

// "15: 9 packings (5 there), 60: 4 (0 there)"
std::string counts_text(const TargetStudy &study, const Counts &counts) {
  std::string text;
  for (std::size_t k = 0; k < counts.size(); ++k)
    if (counts[k] > 0)
      text += fmt::format("{}{:g}: {} packings ({} there)", text.empty() ? "" : ", ",
                          study.state().runs.transits[k], counts[k], study.state().made[k]);
  return text;
}

std::string plan_words(const TargetStudy &study, const TargetPlan &plan) {
  const ErrorParts parts = parts_of(plan.precision, plan.half, study.step_error());
  std::string text = fmt::format(
      "  plan, packings at so many wave crossings: {}\n  about {:.0f} s of one core more; predicted "
      "+- {:.2g} %: {}\n",
      counts_text(study, plan.counts), seconds_of(study, plan.cost), plan.half / percent, parts_text(parts));
  return text;
}

OneSpeed one_speed(const TargetStudy &study, const TargetEstimate &of) {
  return one_slow_speed(of.slope, of.spread, study.figures().linear_cost(),
                        study.state().runs.transits.front(), study.aim());
}

std::string one_speed_text(const TargetStudy &study, const TargetEstimate &of) {
  const OneSpeed slow = one_speed(study, of);
  const double accuracy = target_of(study).accuracy / percent;
  if (slow.packings == 0) return fmt::format("  one slow speed would not give {:.2g} % at all\n", accuracy);
  return fmt::format(
      "  one slow speed would cost {:.0f} s of one core for {:.2g} % ({:.0f} crossings, {} packings), if all "
      "of "
      "this were known beforehand: {:.2g} times what was run\n",
      seconds_of(study, slow.cost), accuracy, slow.transits, slow.packings,
      slow.cost / study.figures().work());
}

std::string size_text(const TargetStudy &study) {
  const SizeEffect size = size_effect(study);
  const double change = size.change / percent, wasted = std::abs(change);
  std::string text = fmt::format(
      "  spheres 1.25 times as large change the {} by {:+.2g}{} % ({}): beyond {:.2g} % more accuracy is "
      "wasted "
      "on one sphere size\n",
      figure_words(study), change, size.measured ? fmt::format(" +- {:.2g}", size.half / percent) : "",
      size.measured ? "measured at the fastest speed" : "by the law of bench/results/sizes.md", wasted);
  if (target_of(study).accuracy < std::abs(size.change))
    text += "  the accuracy that is ordered is tighter than that\n";
  return text;
}

const char *verdict_words(Verdict verdict) {
  switch (verdict) {
    case Verdict::reached:
      return "reached";
    case Verdict::more:
      return "stopped";
    case Verdict::out_of_runs:
      return "not reached";
    case Verdict::unknown:
      return "unknown";
  }
  return "";
}

Json parts_json(const ErrorParts &parts) {
  return {{"packing", parts.packing}, {"chaos", parts.chaos}, {"speed", parts.speed}, {"step", parts.step}};
}

// A strength in Pa, a gain without unit.
double figure_of(const TargetEstimate &of) {
  return std::exp(of.mean);
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

} // namespace

SizeEffect size_effect(const TargetStudy &study) {
  const StudyTarget &target = target_of(study);
  if (const auto measured = study.figures().of_coarser())
    return {std::expm1(measured->mean), measured->half(target.confidence), true};
  // Powers of the mean radius, bench/results/sizes.md: between dry platens and between greased ones.
  constexpr double dry = -0.049, greased = -0.118, modulus = -0.073, little_friction = 0.05;
  double power = modulus;
  if (target.figure == TargetFigure::gain) power = dry - greased;
  if (target.figure == TargetFigure::strength)
    power = study.setup().scene.platens.both.friction_static < little_friction ? greased : dry;
  return {std::pow(1.25, power) - 1, 0, false};
}

ErrorParts parts_of(const Precision &precision, double half, double step_error) {
  const double quantile = half / std::sqrt(precision.total() + step_error * step_error);
  return {quantile * std::sqrt(precision.packing), quantile * std::sqrt(precision.chaos),
          quantile * std::sqrt(precision.speed), quantile * step_error};
}

std::string estimate_text(const TargetStudy &study, const TargetEstimate &estimate, double half) {
  const double figure = figure_of(estimate);
  std::string value = fmt::format("{:.4g}", figure);
  if (target_of(study).figure == TargetFigure::strength)
    value = fmt::format("{:.4g} MPa", figure * pa_in_mpa);
  if (target_of(study).figure == TargetFigure::modulus) value = fmt::format("{:.4g} GPa", figure * pa_in_gpa);
  return fmt::format("{} +- {:.2g} %", value, half / percent);
}

std::string look_text(const TargetStudy &study) {
  const Decision &decision = study.decision();
  if (!decision.estimate) return "  too few runs gave the figure to tell more\n";
  const TargetFigures &figures = study.figures();
  std::string text =
      fmt::format("  {} runs, {:.0f} s of one core: {} {} ({})\n", figures.made(), figures.seconds(),
                  figure_words(study), estimate_text(study, *decision.estimate, decision.half),
                  parts_text(parts_of(decision.estimate->precision, decision.half, study.step_error())));
  if (decision.plan) text += plan_words(study, *decision.plan);
  return text;
}

std::string text_of(const TargetStudy &study) {
  const Decision &decision = study.decision();
  if (!decision.estimate) return "";
  const TargetEstimate &of = *decision.estimate;
  const StudyTarget &target = target_of(study);
  std::string text = fmt::format(
      "\n  {} of slow loading: {} with {:g} % confidence; {:.2g} % were ordered: {}\n  parts of the error, "
      "which "
      "add up in squares: {}\n  haste 1 + b / N with b = {:.2g} +- {:.2g}; packings scatter by {:.2g} %, "
      "chaos "
      "by {:.2g} %\n  {} runs of {} packings, {:.3g} steps times spheres, {:.0f} s of one core\n",
      figure_words(study), estimate_text(study, of, decision.half), target.confidence / percent,
      target.accuracy / percent, verdict_words(decision.verdict),
      parts_text(parts_of(of.precision, decision.half, study.step_error())), of.slope,
      std::sqrt(of.precision.slope), std::sqrt(of.spread.packing) / percent,
      std::sqrt(of.spread.chaos) / percent, study.figures().made(), study.seeds().size(),
      study.figures().work(), study.figures().seconds());
  if (decision.verdict == Verdict::out_of_runs)
    text += decision.plan
                ? fmt::format(
                      "  no more runs are allowed (Study/Target/Most runs = {}); what is still "
                      "missing:\n{}",
                      target.most_runs, plan_words(study, *decision.plan))
                : "  no plan of these speeds is enough: slower ones in Study/Wave crossings list, or a "
                  "smaller Step allowance may be\n";
  if (const auto step = study.figures().of_half_step())
    text += fmt::format("  half the step changes it by {:+.2g} +- {:.2g} %\n", step->mean / percent,
                        step->half(target.confidence) / percent);
  return text + size_text(study) + one_speed_text(study, of);
}

Json json_of(const TargetStudy &study) {
  const Decision &decision = study.decision();
  const StudyTarget &target = target_of(study);
  Json all{{"figure", figure_words(study)},
           {"unit", target.figure == TargetFigure::gain ? "" : "Pa"},
           {"accuracy", target.accuracy},
           {"confidence", target.confidence},
           {"verdict", verdict_words(decision.verdict)}};
  if (!decision.estimate) return all;
  const TargetEstimate &of = *decision.estimate;
  const OneSpeed slow = one_speed(study, of);
  const SizeEffect size = size_effect(study);
  all["mean"] = figure_of(of);
  all["low"] = figure_of(of) * std::exp(-decision.half),
  all["high"] = figure_of(of) * std::exp(decision.half);
  all["half_interval"] = decision.half;
  all["parts"] = parts_json(parts_of(of.precision, decision.half, study.step_error()));
  all["haste"] = {{"b", of.slope}, {"error", std::sqrt(of.precision.slope)}};
  all["scatter"] = {{"packing", std::sqrt(of.spread.packing)}, {"chaos", std::sqrt(of.spread.chaos)}};
  all["freedom"] = of.precision.freedom;
  all["without_figure"] = study.figures().without_figure();
  all["sphere_steps"] = study.figures().work();
  all["plan"] = plan_json(study, decision.plan ? decision.plan->counts : study.state().made);
  all["one_slow_speed"] = {
      {"wave_crossings", slow.transits}, {"packings", slow.packings}, {"sphere_steps", slow.cost}};
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
    costs["one_slow_speed_core_seconds"] =
        seconds_of(study, one_speed(study, *study.decision().estimate).cost);
  return costs;
}

} // namespace platen::apps
