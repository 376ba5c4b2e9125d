// When a test writes, and when it is over.
#include <algorithm>
#include <cmath>

#include "apps/run/compression_run.h"

namespace platen::apps {
namespace {

// Steps between two checks of signals and progress.
constexpr double most_unobserved = 16;
// Of the loaded length: what is pressed further is rubble between two plates, and no specimen of its height
// and section. Laboratories end tests of soil at half of this.
constexpr double most_shortened = 0.3;

} // namespace

// Steps from one check to the next: as given, or `automatic` checks on the way to the target.
double CompressionRun::every(const Interval &interval, double automatic) const {
  const double every =
      interval.kind == Interval::Kind::steps ? interval.value : std::ceil(expected_steps_ / automatic);
  return std::max(1.0, every);
}

// Steps: every n-th. Times: the first step at or after each multiple. Neither: `automatic` of them on the
// way.
bool CompressionRun::due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return std::floor(test_->time() / interval.value) >
           std::floor((test_->time() - test_->time_step()) / interval.value);
  return std::fmod(static_cast<double>(test_->steps()), every(interval, automatic)) == 0;
}

// A lower bound; 1 at least.
double CompressionRun::steps_until_due(const Interval &interval, double automatic) const {
  if (interval.kind == Interval::Kind::time)
    return (1 - std::fmod(test_->time() / interval.value, 1.0)) * interval.value / test_->time_step() - 1;
  const double n = every(interval, automatic);
  return n - std::fmod(static_cast<double>(test_->steps()), n);
}

// Steps that can be made before output or checkpoint is due.
long CompressionRun::steps_unobserved() const {
  double steps = steps_until_due(scene_.output.every, automatic_rows);
  if (fields_) steps = std::min(steps, steps_until_due(scene_.output.fields_every, automatic_frames));
  if (scene_.checkpoint.every.kind == Interval::Kind::steps)
    steps = std::min(steps, steps_until_due(scene_.checkpoint.every, 1));
  return static_cast<long>(std::clamp(steps, 1.0, most_unobserved));
}

bool CompressionRun::checkpoint_due() const {
  const Interval &every = scene_.checkpoint.every;
  if (every.kind == Interval::Kind::time) return seconds_since(last_checkpoint_) > every.value;
  return every.kind == Interval::Kind::steps &&
         std::fmod(static_cast<double>(test_->steps()), every.value) == 0;
}

std::string CompressionRun::ended_by() const {
  if (test_->program().finished()) return "target";
  if (scene_.loading.stop_at_residual > 0 && results_.fallen_to(scene_.loading.stop_at_residual))
    return "stop at residual";
  if (std::abs(test_->closure_strain(results_.axis())) > most_shortened) return "shortened too far";
  return "";
}

ProgressSample CompressionRun::where() const {
  ProgressSample p;
  p.fraction = test_->program().progress();
  p.step = static_cast<std::uint64_t>(test_->steps());
  p.time = test_->time();
  p.strain = test_->closure_strain(results_.axis());
  p.stress = test_->platens_along(results_.axis()).stress(*test_);
  p.broken_bonds = test_->model.broken_tension + test_->model.broken_shear;
  return p;
}

} // namespace platen::apps
