// Figures of a study of a target that its words and its study.json share.
#include <cmath>

#include "apps/study/study_section.h"
#include "apps/study/target_report.h"

namespace platen::apps {
namespace {

OneSpeed one_speed(const TargetStudy &study, const OneSpeedKnown &known) {
  return one_slow_speed(known, study.figures().linear_cost(), study.state().runs.transits.front(),
                        study.aim());
}

} // namespace

std::string figure_words(const TargetStudy &study) {
  switch (study.target().figure) {
    case TargetFigure::strength:
      return "strength";
    case TargetFigure::modulus:
      return "Young's modulus";
    case TargetFigure::gain:
      return "gain of strength";
  }
  return "";
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

double seconds_of(const TargetStudy &study, double work) {
  return study.figures().work() > 0 ? work * study.figures().seconds() / study.figures().work()
                                    : std::nan("");
}

double figure_of(const TargetEstimate &of) {
  return std::exp(of.mean);
}

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

ErrorParts parts_of(const Precision &precision, double half, double step_error) {
  const double quantile = half / std::sqrt(precision.total() + step_error * step_error);
  return {quantile * std::sqrt(precision.packing), quantile * std::sqrt(precision.chaos),
          quantile * std::sqrt(precision.speed), quantile * step_error};
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

} // namespace platen::apps
