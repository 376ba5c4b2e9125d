// When a test writes, and when it is over.
#include <algorithm>
#include <cmath>

#include "apps/run/compression_run.h"

namespace platen::apps {
namespace {

// Steps between two looks at signals and progress.
constexpr double most_unobserved = 16;

} // namespace

// Steps from one look to the next: as given, or `automatic` looks on the way to the target.
double CompressionRun::every(const Interval &interval, double automatic) const {
  const double every =
      interval.kind == Interval::Kind::steps ? interval.value : std::ceil(expected_steps_ / automatic);
  return std::max(1.0, every);
}

// Steps: every n-th. Times: the first step at or after each multiple. Neither: `automatic` of them on the
// way.
bool CompressionRun::due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return std::floor(problem_->time() / interval.value) >
           std::floor((problem_->time() - problem_->time_step()) / interval.value);
  return std::fmod(static_cast<double>(problem_->steps()), every(interval, automatic)) == 0;
}

// A lower bound; 1 at least.
double CompressionRun::steps_until_due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return (1 - std::fmod(problem_->time() / interval.value, 1.0)) * interval.value / problem_->time_step() -
           1;
  const double n = every(interval, automatic);
  return n - std::fmod(static_cast<double>(problem_->steps()), n);
}

// Steps that can be made before output, checkpoint or the end of the test is looked at.
long CompressionRun::steps_unobserved() const {
  const coupling::Problem &p = *problem_;
  double steps = steps_until_due(scene_.output.every, automatic_rows);
  if (fields_) steps = std::min(steps, steps_until_due(scene_.output.fields_every, automatic_frames));
  if (scene_.checkpoint.every.kind == Interval::Kind::steps)
    steps = std::min(steps, steps_until_due(scene_.checkpoint.every, 1));
  if (!scene_.loading.hydrostatic()) {
    const double step_closes = p.fastest_rate() * p.time_step() / p.shape().height;
    steps = std::min(steps, (scene_.loading.target_strain - std::abs(p.axial_closure())) / step_closes - 1);
  }
  if (by_time()) steps = std::min(steps, (end_time() - p.time()) / p.time_step() - 1);
  return static_cast<long>(std::clamp(steps, 1.0, most_unobserved));
}

bool CompressionRun::checkpoint_due() const {
  const Interval &every = scene_.checkpoint.every;
  if (every.kind == Interval::Kind::time) return seconds_since(last_checkpoint_) > every.value;
  return every.kind == Interval::Kind::steps &&
         std::fmod(static_cast<double>(problem_->steps()), every.value) == 0;
}

bool CompressionRun::by_time() const {
  return scene_.platens.top_control == PlatenControl::stress || scene_.loading.hydrostatic();
}

double CompressionRun::end_time() const {
  return (scene_.loading.hydrostatic() ? problem_->cell_ramp() : problem_->ramp()) + scene_.loading.hold;
}

bool CompressionRun::finished() const {
  if (scene_.loading.hydrostatic()) return problem_->axial_stage();
  if (by_time() && problem_->time() >= end_time()) return true;
  if (std::abs(problem_->axial_closure()) >= scene_.loading.target_strain) return true;
  return scene_.loading.stop_at_residual > 0 && results_.fallen_to(scene_.loading.stop_at_residual);
}

ProgressSample CompressionRun::where() const {
  ProgressSample p;
  p.fraction = std::min(1.0, by_time() ? problem_->time() / end_time()
                                       : std::abs(problem_->axial_closure()) / scene_.loading.target_strain);
  p.step = static_cast<std::uint64_t>(problem_->steps());
  p.time = problem_->time();
  p.strain = problem_->closure_strain();
  p.stress = 0.5 * (problem_->stress_top() + problem_->stress_bottom());
  p.broken_bonds = problem_->model.broken_tension + problem_->model.broken_shear;
  return p;
}

} // namespace platen::apps
