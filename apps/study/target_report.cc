#include "apps/study/target_report.h"

#include <fmt/format.h>

#include <cmath>

namespace platen::apps {
namespace {

constexpr double percent = 0.01;

// By TargetFigure; in study.json, and on the screen in multiples of a unit.
struct FigureWords {
  const char *name, *si_unit, *shown;
  double unit;
};
constexpr FigureWords all_figures[] = {{"strength", "Pa", " MPa", 1e-6},
                                       {"Young's modulus", "Pa", " GPa", 1e-9},
                                       {"gain of strength", "", "", 1}};

const FigureWords &words_of(const TargetStudy &study) {
  return all_figures[static_cast<std::size_t>(study.target().figure)];
}

const char *verdict_words(Verdict verdict) {
  constexpr const char *words[] = {"unknown", "reached", "stopped", "not reached"}; // as Verdict
  return words[static_cast<std::size_t>(verdict)];
}

// Seconds of one core for so much work, by what runs took so far.
double seconds_of(const TargetStudy &study, double work) {
  const TargetFigures &figures = study.figures();
  return figures.work() > 0 ? work * figures.seconds() / figures.work() : std::nan("");
}

// What another size of spheres does to the figure: that of spheres 1.25 times as large, relative.
struct SizeEffect {
  double change = 0;
  double half = 0; // of its interval; 0: by the law of bench/results/sizes.md
  bool measured = false;
};

SizeEffect size_effect(const TargetStudy &study) {
  const StudyTarget &target = study.target();
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

// Parts of the half interval, relative to the figure; their squares sum up to its square.
struct ErrorParts {
  double packing = 0, chaos = 0, speed = 0, step = 0;

  ErrorParts(const TargetStudy &study, const Precision &precision, double half) {
    const double step_error = study.step_error(),
                 quantile = half / std::sqrt(precision.total() + step_error * step_error);
    packing = quantile * std::sqrt(precision.packing), chaos = quantile * std::sqrt(precision.chaos);
    speed = quantile * std::sqrt(precision.speed), step = quantile * step_error;
  }
  std::string text() const {
    return fmt::format("packings {:.2g}, chaos {:.2g}, speed {:.2g}, step {:.2g} %", packing / percent,
                       chaos / percent, speed / percent, step / percent);
  }
  Json json() const { return {{"packing", packing}, {"chaos", chaos}, {"speed", speed}, {"step", step}}; }
};

// One slow speed in place of the study: all known beforehand, or by the runs of the first look.
OneSpeed one_speed(const TargetStudy &study, const OneSpeedKnown &known) {
  return one_slow_speed(known, study.figures().linear_cost(), study.state().runs.transits.front(),
                        study.aim());
}

OneSpeed one_speed_of_oracle(const TargetStudy &study) {
  const TargetEstimate &of = *study.decision().estimate;
  return one_speed(study, {std::abs(of.slope), of.errors.spread});
}

OneSpeed one_speed_of_pilot(const TargetStudy &study) {
  const TargetLook &pilot = study.looks().front();
  return one_speed(study,
                   known_by_pilot(pilot.estimate, pilot.packings, pilot.work, study.target().confidence));
}

// Packings by speed as "15: 9 packings (5 there), 60: 4 (0 there)", what they cost, and how far they lead.
std::string plan_words(const TargetStudy &study, const TargetPlan &plan) {
  std::string counts;
  for (std::size_t k = 0; k < plan.counts.size(); ++k)
    if (plan.counts[k] > 0)
      counts += fmt::format("{}{:g}: {} packings ({} there)", counts.empty() ? "" : ", ",
                            study.state().runs.transits[k], plan.counts[k], study.state().made[k]);
  return fmt::format(
      "  plan, packings at so many wave crossings: {}\n  about {:.0f} s of one core more; predicted "
      "+- {:.2g} %: {}\n",
      counts, seconds_of(study, plan.cost), plan.half / percent,
      ErrorParts(study, plan.precision, plan.half).text());
}

std::string one_speed_text(const TargetStudy &study, const OneSpeed &slow, const std::string &known) {
  if (slow.packings == 0) return fmt::format("no number of packings would be enough, {}", known);
  return fmt::format("{:.0f} s of one core, {} ({:.0f} crossings, {} packings; {:.2g} times what was run)",
                     seconds_of(study, slow.cost), known, slow.transits, slow.packings,
                     slow.cost / study.figures().work());
}

std::string size_text(const TargetStudy &study) {
  const SizeEffect size = size_effect(study);
  const double change = size.change / percent, wasted = std::abs(change);
  std::string text = fmt::format(
      "  spheres 1.25 times as large change the {} by {:+.2g}{} % ({}): beyond {:.2g} % more accuracy is "
      "wasted on one sphere size\n",
      words_of(study).name, change, size.measured ? fmt::format(" +- {:.2g}", size.half / percent) : "",
      size.measured ? "measured at the fastest speed" : "by the law of bench/results/sizes.md", wasted);
  if (study.target().accuracy < std::abs(size.change))
    text += "  the accuracy that is ordered is tighter than that\n";
  return text;
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

std::string estimate_text(const TargetStudy &study, const TargetEstimate &estimate, double half) {
  const FigureWords &words = words_of(study);
  return fmt::format("{:.4g}{} +- {:.2g} %", std::exp(estimate.mean) * words.unit, words.shown,
                     half / percent);
}

std::string look_text(const TargetStudy &study) {
  const Decision &decision = study.decision();
  if (!decision.estimate) return "  too few runs gave the figure to tell more\n";
  const TargetFigures &figures = study.figures();
  return fmt::format("  {} runs, {:.0f} s of one core: {} {} ({})\n", figures.made(), figures.seconds(),
                     words_of(study).name, estimate_text(study, *decision.estimate, decision.half),
                     ErrorParts(study, decision.estimate->precision, decision.half).text()) +
         (decision.plan ? plan_words(study, *decision.plan) : "");
}

std::string text_of(const TargetStudy &study) {
  const Decision &decision = study.decision();
  if (!decision.estimate) return "";
  const TargetEstimate &of = *decision.estimate;
  const StudyTarget &target = study.target();
  std::string text = fmt::format(
      "\n  {} of slow loading: {} with {:g} % confidence; {:.2g} % were ordered: {}\n  parts of the error, "
      "which add up in squares: {}\n  haste 1 + b / N with b = {:.2g} +- {:.2g}; packings scatter by "
      "{:.2g} %, chaos by {:.2g} %\n  {} runs of {} packings, {:.3g} steps times spheres, {:.0f} s of one "
      "core\n",
      words_of(study).name, estimate_text(study, of, decision.half), target.confidence / percent,
      target.accuracy / percent, verdict_words(decision.verdict),
      ErrorParts(study, of.precision, decision.half).text(), of.slope, std::sqrt(of.precision.slope),
      std::sqrt(of.errors.spread.packing) / percent, std::sqrt(of.errors.spread.chaos) / percent,
      study.figures().made(), study.seeds().size(), study.figures().work(), study.figures().seconds());
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
  return text + size_text(study) +
         fmt::format(
             "  one slow speed for {:.2g} %: {};\n    {}\n", target.accuracy / percent,
             one_speed_text(study, one_speed_of_oracle(study), "were scatter and haste known beforehand"),
             one_speed_text(study, one_speed_of_pilot(study), "where the first batch had to tell them"));
}

Json json_of(const TargetStudy &study) {
  const Decision &decision = study.decision();
  const StudyTarget &target = study.target();
  const TargetFigures &figures = study.figures();
  Json all{{"figure", words_of(study).name},
           {"unit", words_of(study).si_unit},
           {"accuracy", target.accuracy},
           {"confidence", target.confidence},
           {"verdict", verdict_words(decision.verdict)}};
  if (!decision.estimate) return all;
  const TargetEstimate &of = *decision.estimate;
  const SizeEffect size = size_effect(study);
  const double figure = std::exp(of.mean);
  all["mean"] = figure;
  all["low"] = figure * std::exp(-decision.half);
  all["high"] = figure * std::exp(decision.half);
  all["half_interval"] = decision.half;
  all["parts"] = ErrorParts(study, of.precision, decision.half).json();
  all["haste"] = {{"b", of.slope}, {"error", std::sqrt(of.precision.slope)}};
  all["scatter"] = {{"packing", std::sqrt(of.errors.spread.packing)},
                    {"chaos", std::sqrt(of.errors.spread.chaos)}};
  all["freedom"] = of.precision.freedom;
  all["without_figure"] = figures.without_figure();
  all["sphere_steps"] = figures.work();
  all["plan"] = plan_json(study, decision.plan ? decision.plan->counts : study.state().made);
  all["one_slow_speed"] = one_speed_json(one_speed_of_oracle(study));
  all["one_slow_speed_after_pilot"] = one_speed_json(one_speed_of_pilot(study));
  all["sphere_size"] = {{"change", size.change}, {"half_interval", size.half}, {"measured", size.measured}};
  if (const auto step = figures.of_half_step())
    all["half_step"] = {{"change", step->mean}, {"half_interval", step->half(target.confidence)}};
  all["looks"] = Json::array();
  for (const TargetLook &look : study.looks())
    all["looks"].push_back({{"runs", look.runs},
                            {"sphere_steps", look.work},
                            {"mean", std::exp(look.estimate.mean)},
                            {"half_interval", look.half},
                            {"parts", ErrorParts(study, look.estimate.precision, look.half).json()}});
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
