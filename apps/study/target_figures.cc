#include "apps/study/target_figures.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

#include "apps/run/needs.h"
#include "apps/run/specimen_setup.h"
#include "apps/study/study_section.h"
#include "apps/study/tables.h"
#include "apps/study/target_prior.h"

namespace platen::apps {
namespace {

// What a packing costs, in steps of its spheres: 1.8 s of the cylinder of study_quality_cylinder, a step of
// which takes 0.6 ms on the same core.
constexpr double steps_of_packing = 3000;

// Of study_target_cylinder by wave crossings. Another height or width of spheres changes all in proportion.
constexpr LinearCost usual_steps{1400, 285, steps_of_packing};

// Where the packing is a file's, of which nothing has been read yet.
constexpr double usual_spheres = 5000;

} // namespace

double MeasuredChange::half(double confidence) const {
  return boost::math::quantile(boost::math::students_t(freedom), 0.5 + confidence / 2) * error;
}

bool MeasuredChange::is_certain(double confidence) const {
  return std::abs(mean) > half(confidence);
}

LinearCost line_through(const std::vector<double> &transits, const std::vector<double> &costs) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < transits.size(); ++k)
    if (costs[k] > 0)
      n += 1, x += transits[k], y += costs[k], xx += transits[k] * transits[k], xy += transits[k] * costs[k];
  if (n < 2) return {0, n > 0 ? y / x : 0, 0};
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {(y - slope * x) / n, slope, 0};
}

TargetFigures::TargetFigures(const Scene &scene)
    : figure_(study_of(scene).target.figure), cases_(target_cases(scene)), transits_(target_transits(scene)) {
  works_.resize(cases_.scenes * (cases_.speeds + 2));
  const bool packed = scene.specimen.packing != PackingKind::file;
  counted_spheres_ = packed ? counted_costs(scene, specimen_shape(scene)).spheres : usual_spheres;
}

double TargetFigures::spheres() const {
  return with_spheres_ == 0 ? counted_spheres_ : spheres_ / static_cast<double>(with_spheres_);
}

void TargetFigures::add(const TestRun &run, std::size_t packing, const RunOutcome &outcome) {
  const Json &summary = outcome.summary;
  while (logs_.size() <= packing) {
    logs_.emplace_back(works_.size(), std::nan(""));
    was_packed_.push_back(false);
  }
  const char *key = figure_ == TargetFigure::modulus ? "youngs_modulus_gauge_pa" : "strength_pa";
  const bool counts = outcome.done && (figure_ == TargetFigure::modulus || StudyTables::peaked(summary));
  const double value = counts ? number_in(summary, key) : std::nan("");
  logs_[packing][run.of] = value > 0 ? std::log(value) : std::nan("");
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

// Of a case and, of a gain, the case of the other scene, `stride` further on.
double TargetFigures::figure_of(std::size_t packing, std::size_t of_first_scene, std::size_t stride) const {
  const double first = logs_[packing][of_first_scene];
  return cases_.scenes == 1 ? first : first - logs_[packing][of_first_scene + stride];
}

TargetRuns TargetFigures::runs() const {
  TargetRuns runs{transits_, {}};
  for (std::size_t s = 0; s < logs_.size(); ++s) {
    runs.logs.emplace_back();
    for (std::size_t k = 0; k < cases_.speeds; ++k)
      runs.logs.back().push_back(figure_of(s, cases_.at(0, k), cases_.speeds));
  }
  return runs;
}

double TargetFigures::curvature_of_scenes() const {
  double largest = 0;
  for (std::size_t scene = 0; cases_.scenes > 1 && scene < cases_.scenes; ++scene) {
    TargetRuns runs{transits_, {}};
    for (const std::vector<double> &logs : logs_) {
      const auto first = logs.begin() + static_cast<std::ptrdiff_t>(cases_.at(scene, 0));
      runs.logs.emplace_back(first, first + static_cast<std::ptrdiff_t>(cases_.speeds));
    }
    if (const auto found = estimate(runs, expected_spread(TargetFigure::strength, spheres())))
      largest = std::max(largest, found->slope * found->slope);
  }
  return largest;
}

TargetCosts TargetFigures::costs() const {
  TargetCosts costs;
  costs.runs.assign(cases_.speeds, 0);
  costs.packing = steps_of_packing * spheres();
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

std::vector<double> TargetFigures::figures_of(std::size_t of_first_scene, std::size_t stride) const {
  std::vector<double> figures;
  for (std::size_t s = 0; s < logs_.size(); ++s)
    figures.push_back(figure_of(s, of_first_scene, stride));
  return figures;
}

std::optional<MeasuredChange> TargetFigures::of_half_step() const {
  if (!cases_.half_step) return std::nullopt;
  const std::vector<double> half = figures_of(cases_.of_half_step(0), 1),
                            whole = figures_of(cases_.at(0, 0), cases_.speeds);
  SeedStatistics changes;
  for (std::size_t s = 0; s < half.size(); ++s)
    changes.add(half[s] - whole[s]);
  const double count = static_cast<double>(changes.count());
  if (changes.count() < 2) return std::nullopt;
  return MeasuredChange{changes.mean(), changes.deviation() / std::sqrt(count), count - 1};
}

// Of other packings: Welch's error and a freedom that is no larger than his.
std::optional<MeasuredChange> TargetFigures::of_coarser() const {
  if (!cases_.coarser) return std::nullopt;
  SeedStatistics coarse, fine;
  for (const double value : figures_of(cases_.of_coarser(0), 1))
    coarse.add(value);
  for (const double value : figures_of(cases_.at(0, 0), cases_.speeds))
    fine.add(value);
  if (coarse.count() < 2 || fine.count() < 2) return std::nullopt;
  const double variance = std::pow(coarse.deviation(), 2) / static_cast<double>(coarse.count()) +
                          std::pow(fine.deviation(), 2) / static_cast<double>(fine.count());
  return MeasuredChange{coarse.mean() - fine.mean(), std::sqrt(variance),
                        static_cast<double>(std::min(coarse.count(), fine.count()) - 1)};
}

} // namespace platen::apps
