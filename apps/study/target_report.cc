#include "apps/study/target_report.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/study/study_section.h"
#include "apps/study/tables.h"

namespace platen::apps {
namespace {

constexpr double percent = 0.01, pa_in_mpa = 1e-6, pa_in_gpa = 1e-9;

std::string parts_text(const ErrorParts &parts) {
  return fmt::format("packings {:.2g}, chaos {:.2g}, speed {:.2g}, step {:.2g} %", parts.packing / percent,
                     parts.chaos / percent, parts.speed / percent, parts.step / percent);
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

std::string words_of(const TargetStudy &study, const OneSpeed &slow, const std::string &known) {
  if (slow.packings == 0) return fmt::format("no number of packings would be enough, {}", known);
  return fmt::format("{:.0f} s of one core, {} ({:.0f} crossings, {} packings; {:.2g} times what was run)",
                     seconds_of(study, slow.cost), known, slow.transits, slow.packings,
                     slow.cost / study.figures().work());
}

std::string one_speed_text(const TargetStudy &study) {
  return fmt::format("  one slow speed for {:.2g} %: {};\n    {}\n", study.target().accuracy / percent,
                     words_of(study, one_speed_of_oracle(study), "were scatter and haste known beforehand"),
                     words_of(study, one_speed_of_pilot(study), "where the first batch had to tell them"));
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
  if (study.target().accuracy < std::abs(size.change))
    text += "  the accuracy that is ordered is tighter than that\n";
  return text;
}

} // namespace

std::string estimate_text(const TargetStudy &study, const TargetEstimate &estimate, double half) {
  const double figure = figure_of(estimate);
  std::string value = fmt::format("{:.4g}", figure);
  if (study.target().figure == TargetFigure::strength) value = fmt::format("{:.4g} MPa", figure * pa_in_mpa);
  if (study.target().figure == TargetFigure::modulus) value = fmt::format("{:.4g} GPa", figure * pa_in_gpa);
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
  const StudyTarget &target = study.target();
  std::string text = fmt::format(
      "\n  {} of slow loading: {} with {:g} % confidence; {:.2g} % were ordered: {}\n  parts of the error, "
      "which "
      "add up in squares: {}\n  haste 1 + b / N with b = {:.2g} +- {:.2g}; packings scatter by {:.2g} %, "
      "chaos "
      "by {:.2g} %\n  {} runs of {} packings, {:.3g} steps times spheres, {:.0f} s of one core\n",
      figure_words(study), estimate_text(study, of, decision.half), target.confidence / percent,
      target.accuracy / percent, verdict_words(decision.verdict),
      parts_text(parts_of(of.precision, decision.half, study.step_error())), of.slope,
      std::sqrt(of.precision.slope), std::sqrt(of.errors.spread.packing) / percent,
      std::sqrt(of.errors.spread.chaos) / percent, study.figures().made(), study.seeds().size(),
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
  return text + size_text(study) + one_speed_text(study);
}

} // namespace platen::apps
