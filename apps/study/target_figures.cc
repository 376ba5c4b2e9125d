#include "apps/study/target_figures.h"

#include <algorithm>
#include <cmath>

#include "apps/output/seed_statistics.h"
#include "apps/run/needs.h"
#include "apps/run/specimen_setup.h"
#include "apps/study/tables.h"

namespace platen::apps {
namespace {

// What a packing costs, in steps of its spheres: 1.8 s of the cylinder of study_quality_cylinder, a step of
// which takes 0.6 ms on the same core.
constexpr double steps_of_packing = 3000;

// Of study_target_cylinder by wave crossings. Another height or width of spheres changes all in proportion.
constexpr LinearCost usual_steps{1400, 285, steps_of_packing};

// Where the packing is a file's, of which nothing has been read yet.
constexpr double usual_spheres = 5000;

// Deviations of the logarithm for one sphere, both of which fall as 1 / sqrt(spheres), of concrete between
// dry platens, docs/accuracy.md. Strength of 728 and of 5 018 spheres: packings 6 and 2.5 %, chaos 2.5 and 1
// %. Modulus: packings 4.3 and 1.6 %, chaos .5 and .3 %. Gain by platen friction of cubes of 5 021: 1.7 and
// 0.9 %. Gains over other scenes may share less, or more, of what packings do.
struct Deviations {
  double packing, chaos;
};
constexpr Deviations of_one_sphere[] = {{1.7, 0.7}, {1.15, 0.2}, {1.2, 0.7}}; // as TargetFigure

// Slope and height of the straight line through points, by least squares; through the origin of one.
LinearCost line_through(const std::vector<double> &transits, const std::vector<double> &costs) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < transits.size(); ++k)
    if (costs[k] > 0)
      n += 1, x += transits[k], y += costs[k], xx += transits[k] * transits[k], xy += transits[k] * costs[k];
  if (n < 2) return {0, n > 0 ? y / x : 0, 0};
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {(y - slope * x) / n, slope, 0};
}

SeedStatistics statistics_of(const std::vector<double> &values) {
  SeedStatistics all;
  for (const double value : values)
    all.add(value);
  return all;
}

} // namespace

SpreadPrior expected_spread(TargetFigure figure, double spheres) {
  // One degree: of another material, spheres or loading the spread may well be half or twice as large. Its
  // parts go together more closely.
  constexpr double sum_freedom = 1, ratio_freedom = 4;
  const Deviations one = of_one_sphere[static_cast<std::size_t>(figure)];
  return {{one.packing * one.packing / spheres, one.chaos * one.chaos / spheres}, sum_freedom, ratio_freedom};
}

RunErrors expected_errors(TargetFigure figure, double spheres) {
  constexpr double haste = 1.5;
  const SpreadPrior prior = expected_spread(figure, spheres);
  return {prior.about, prior, haste * haste};
}

double MeasuredChange::half(double confidence) const {
  return quantile_of(freedom, 0.5 + confidence / 2) * error;
}

TargetFigures::TargetFigures(const Scene &scene)
    : figure_(study_of(scene).target.figure),
      cases_(target_cases(scene)),
      transits_(target_transits(scene)),
      logs_(cases_.scenes * (cases_.speeds + 2)),
      works_(logs_.size()) {
  const bool packed = scene.specimen.packing != PackingKind::file;
  counted_spheres_ = packed ? counted_costs(scene, specimen_shape(scene)).spheres : usual_spheres;
}

double TargetFigures::spheres() const {
  return with_spheres_ == 0 ? counted_spheres_ : spheres_ / static_cast<double>(with_spheres_);
}

void TargetFigures::add(const TestRun &run, std::size_t packing, const RunOutcome &outcome) {
  const Json &summary = outcome.summary;
  if (was_packed_.size() <= packing) {
    was_packed_.resize(packing + 1, false);
    for (std::vector<double> &of_case : logs_)
      of_case.resize(packing + 1, std::nan(""));
  }
  const bool modulus = figure_ == TargetFigure::modulus,
             counts = outcome.done && (modulus || has_peaked(summary));
  const double value =
      counts ? number_in(summary, modulus ? "youngs_modulus_gauge_pa" : "strength_pa") : std::nan("");
  logs_[run.of][packing] = value > 0 ? std::log(value) : std::nan("");
  ++made_;
  if (!(value > 0)) ++without_;
  if (!outcome.done) return;
  const double spheres = number_in(summary, "particles"), steps = number_in(summary, "steps") * spheres;
  works_[run.of].sum += steps, works_[run.of].runs += 1;
  work_ += steps;
  if (!was_packed_[packing]) work_ += steps_of_packing * spheres;
  was_packed_[packing] = true;
  if (run.of < cases_.scenes * cases_.speeds) spheres_ += spheres, ++with_spheres_;
  seconds_ += number_in(summary, "wall_seconds");
}

std::vector<double> TargetFigures::figures_of(std::size_t of_first_scene, std::size_t stride) const {
  std::vector<double> figures = logs_[of_first_scene];
  for (std::size_t s = 0; cases_.scenes > 1 && s < figures.size(); ++s)
    figures[s] -= logs_[of_first_scene + stride][s];
  return figures;
}

template <class Figures>
TargetRuns TargetFigures::runs_of(const Figures &of) const {
  TargetRuns runs{transits_, std::vector<std::vector<double>>(was_packed_.size())};
  for (std::size_t k = 0; k < cases_.speeds; ++k) {
    const std::vector<double> figures = of(k);
    for (std::size_t s = 0; s < figures.size(); ++s)
      runs.logs[s].push_back(figures[s]);
  }
  return runs;
}

TargetRuns TargetFigures::runs() const {
  return runs_of([&](std::size_t k) { return figures_of(cases_.at(0, k), cases_.speeds); });
}

double TargetFigures::curvature_of_scenes() const {
  double largest = 0;
  for (std::size_t scene = 0; cases_.scenes > 1 && scene < cases_.scenes; ++scene) {
    const TargetRuns runs = runs_of([&](std::size_t k) { return logs_[cases_.at(scene, k)]; });
    if (const auto found = estimate(runs, expected_spread(TargetFigure::strength, spheres())))
      largest = std::max(largest, found->slope * found->slope);
  }
  return largest;
}

TargetCosts TargetFigures::costs() const {
  TargetCosts costs{std::vector<double>(cases_.speeds, 0), steps_of_packing * spheres()};
  if (with_spheres_ == 0) {
    for (std::size_t k = 0; k < cases_.speeds; ++k)
      costs.runs[k] = usual_steps.at(transits_[k]) * spheres() * static_cast<double>(cases_.scenes);
    return costs;
  }
  for (std::size_t scene = 0; scene < cases_.scenes; ++scene) {
    std::vector<double> own(cases_.speeds, 0);
    for (std::size_t k = 0; k < cases_.speeds; ++k)
      if (const Work &work = works_[cases_.at(scene, k)]; work.runs > 0) own[k] = work.sum / work.runs;
    const LinearCost line = line_through(transits_, own);
    for (std::size_t k = 0; k < cases_.speeds; ++k)
      costs.runs[k] += own[k] > 0 ? own[k] : line.at(transits_[k]);
  }
  return costs;
}

LinearCost TargetFigures::linear_cost() const {
  const TargetCosts of = costs();
  LinearCost line = line_through(transits_, of.runs);
  line.packing = of.packing;
  return line;
}

std::optional<MeasuredChange> TargetFigures::of_half_step() const {
  if (!cases_.half_step) return std::nullopt;
  std::vector<double> changes = figures_of(cases_.of_half_step(0), 1);
  const std::vector<double> whole = figures_of(cases_.at(0, 0), cases_.speeds);
  for (std::size_t s = 0; s < changes.size(); ++s)
    changes[s] -= whole[s];
  const SeedStatistics all = statistics_of(changes);
  if (all.count() < 2) return std::nullopt;
  return MeasuredChange{all.mean(), all.error_of_mean(), static_cast<double>(all.count()) - 1};
}

// Of other packings: Welch's error and a freedom that is no larger than his.
std::optional<MeasuredChange> TargetFigures::of_coarser() const {
  if (!cases_.coarser) return std::nullopt;
  const SeedStatistics coarse = statistics_of(figures_of(cases_.of_coarser(0), 1)),
                       fine = statistics_of(figures_of(cases_.at(0, 0), cases_.speeds));
  if (coarse.count() < 2 || fine.count() < 2) return std::nullopt;
  const double variance = std::pow(coarse.deviation(), 2) / static_cast<double>(coarse.count()) +
                          std::pow(fine.deviation(), 2) / static_cast<double>(fine.count());
  return MeasuredChange{coarse.mean() - fine.mean(), std::sqrt(variance),
                        static_cast<double>(std::min(coarse.count(), fine.count()) - 1)};
}

} // namespace platen::apps
