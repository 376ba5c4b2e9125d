#include "apps/calibrate/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/calibrate/calibrate_section.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

// Where no run comes to a peak the bonds are too strong for the largest strain.
constexpr double weaker = 0.5;
constexpr int most_weaker = 4;
// Static solves are cheap and have no scatter but that of the packings.
constexpr double elastic_precision = 1e-4, elastic_same = 1e-6;
constexpr int most_elastic = 30;
// Trials nearer to each other than that, in large changes, tell the same.
constexpr double same = 1e-3;
// Differences, in large changes: well above the scatter of the trials; those about a best trial that is near.
constexpr double difference = 0.2, near_difference = 0.1;

// One search, over some of the goals by some of the parameters.
class Pass {
public:
  Pass(const Scene &scene, const Goals &goals, const Measurement &test, Space space,
       std::vector<std::size_t> of, bool elastic, bool exact)
      : scene_(scene),
        goals_(goals),
        test_(test),
        space_(std::move(space)),
        of_(std::move(of)),
        elastic_(elastic),
        exact_(exact),
        model_(space_.parameters(exact), space_.guess(goals, of_), elastic ? elastic_same : same) {}

  Found operator()();
  // Goes on with what was tried, corrected. False where no trial is left.
  bool correct(const Correction &by);

private:
  bool done() const { return met_.has_value(); }
  bool ends(const Measured &measured) const;
  int most() const { return elastic_ ? most_elastic : calibrate_of(scene_).most_trials; }
  bool bends_a_curve() const; // by a parameter whose effect on it no formula tells
  void learn(std::size_t trial);
  void settle();
  bool try_all(const std::vector<Eigen::VectorXd> &x);
  void take_differences(const Eigen::VectorXd &x, double size);
  Found found() const;

  const Scene &scene_;
  const Goals &goals_;
  const Measurement &test_;
  Space space_;
  std::vector<std::size_t> of_;
  bool elastic_, exact_;
  std::optional<std::size_t> met_; // the trial that ended it
  int differences_ = 0;            // how often they were taken
  ResponseModel model_;
  std::vector<Eigen::VectorXd> at_;
  std::vector<Choice> tried_;
  std::vector<Measured> measured_; // as measured
  Correction correction_;
  int trials_ = 0;
  std::string too_fast_; // why the first trial that told nothing was no quasi-static one
};

bool Pass::ends(const Measured &measured) const {
  return std::all_of(of_.begin(), of_.end(), [&](std::size_t k) {
    return elastic_ ? std::abs(goals_.miss(k, measured)) <= elastic_precision
                    : goals_.surely_met(k, measured);
  });
}

bool Pass::bends_a_curve() const {
  return space_.free(FreeParameter::compression_limits) &&
         std::any_of(of_.begin(), of_.end(),
                     [&](std::size_t k) { return goals_.all()[k].curve.has_value(); });
}

// Whether any of them tells something.
bool Pass::try_all(const std::vector<Eigen::VectorXd> &x) {
  std::vector<Choice> choices;
  for (const Eigen::VectorXd &one : x)
    choices.push_back(space_.choice(one));
  const std::vector<Measured> measured = test_(choices, elastic_);
  trials_ += static_cast<int>(x.size());
  bool told = false;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Eigen::VectorXd responses = goals_.responses(of_, measured[k]);
    if (responses.size() == 0) {
      if (too_fast_.empty()) too_fast_ = measured[k].too_fast;
      continue;
    }
    told = true;
    at_.push_back(x[k]), tried_.push_back(choices[k]), measured_.push_back(measured[k]);
    learn(tried_.size() - 1);
  }
  return told;
}

void Pass::learn(std::size_t trial) {
  const Measured measured = corrected(measured_[trial], correction_);
  model_.add(at_[trial], goals_.responses(of_, measured));
  if (!done() && ends(measured)) met_ = trial;
}

// Half of the trials are for a margin. After them the tolerance itself is enough: what is left is for
// packings that miss all the same.
void Pass::settle() {
  if (done() || elastic_ || 2 * trials_ <= most()) return;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t trial = 0; trial < tried_.size(); ++trial) {
    const Measured measured = corrected(measured_[trial], correction_);
    const double size = goals_.responses(of_, measured).squaredNorm();
    const bool met =
        std::all_of(of_.begin(), of_.end(), [&](std::size_t k) { return goals_.met(k, measured); });
    if (met && size < least) least = size, met_ = trial;
  }
}

bool Pass::correct(const Correction &by) {
  if (trials_ >= most()) return false;
  correction_ = by;
  model_ =
      ResponseModel(space_.parameters(exact_), space_.guess(goals_, of_), elastic_ ? elastic_same : same);
  met_.reset();
  for (std::size_t k = 0; k < tried_.size(); ++k)
    learn(k);
  settle();
  return true;
}

// One parameter after the other, away from the nearer bound; all at once, so that threads share them.
void Pass::take_differences(const Eigen::VectorXd &x, double size) {
  const std::vector<SearchParameter> parameters = space_.parameters(exact_);
  std::vector<Eigen::VectorXd> all;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const auto place = static_cast<Eigen::Index>(k);
    Eigen::VectorXd to = x;
    const double up = parameters[k].high - x[place], down = x[place] - parameters[k].low;
    to[place] += up >= down ? std::min(size, up) : -std::min(size, down);
    all.push_back(to);
  }
  try_all(all);
  ++differences_;
}

Found Pass::operator()() {
  std::optional<Eigen::VectorXd> x = tried_.empty() ? model_.start() : model_.next();
  for (int in_vain = 0; x && !done() && trials_ < most();) {
    if (!try_all({*x})) {
      if (!too_fast_.empty()) break; // weaker bonds fail sooner still
      if (++in_vain > most_weaker || !space_.free(FreeParameter::tensile_strength)) break;
      x = space_.scaled(*x, FreeParameter::tensile_strength, weaker);
      continue;
    }
    const bool differences = !elastic_ && (calibrate_of(scene_).measures_differences() || bends_a_curve());
    if (differences && differences_ == 0 && !done()) take_differences(*x, difference);
    settle();
    x = model_.next();
    if (x || done() || !differences || differences_ > 1 || trials_ >= most()) continue;
    take_differences(at_.at(model_.best()), near_difference); // the slopes there may be others
    x = model_.next();
  }
  if (tried_.empty() && !too_fast_.empty())
    throw NumericsError("no trial counts, " + too_fast_ +
                        ". A lower Loading/Axial rate helps; in tension Calibrate/Tension rate, of one "
                        "target one that its line sets; trials.csv has every trial");
  if (tried_.empty())
    throw NumericsError(
        elastic_ ? "no static solve came to an end; trials.csv says why"
                 : "no run came to a peak; a larger Loading/Target strain, or weaker bonds to begin with, "
                   "help");
  return found();
}

Found Pass::found() const {
  const std::size_t best = met_.value_or(model_.best());
  Found to;
  to.choice = tried_[best], to.measured = corrected(measured_[best], correction_);
  to.trials = elastic_ ? 0 : trials_;
  to.at_bounds = space_.at_bounds(to.choice);
  to.sensitivities = {of_, space_.free(), space_.by_logarithms(model_.slopes(), to.choice),
                      goals_.responses(of_, to.measured), differences_ > 0};
  return to;
}

// Strengths of brittle bonds are proportional to theirs.
bool proportional(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  const bool strengths = std::none_of(c.targets.begin(), c.targets.end(), [](const Target &target) {
    return target.kind == TargetKind::strain_at_peak || target.kind == TargetKind::curve;
  });
  return strengths && c.free.empty() && !c.measures_differences() &&
         scene.bond.list("compression_limits").empty();
}

} // namespace

Found search(const Scene &scene, const Goals &goals, const Measurement &test, const Judge &judge) {
  std::vector<FreeParameter> free = parameters_of(scene), elastic;
  std::copy_if(free.begin(), free.end(), std::back_inserter(elastic),
               [&](FreeParameter parameter) { return facts_of(calibrate_of(scene), parameter).elastic; });
  const std::vector<std::size_t> wanted = goals.wanted(), by_solves = goals.wanted_elastic();
  Found found;
  found.choice = choice_of(scene);
  if (!by_solves.empty() && !elastic.empty())
    found = Pass(scene, goals, test, {scene, found.choice, elastic}, by_solves, true, true)();
  if (by_solves.size() == wanted.size() && !elastic.empty()) return found;
  Pass pass(scene, goals, test, {scene, found.choice, free}, wanted, false, proportional(scene));
  found = pass();
  while (judge) {
    const std::optional<Correction> correction = judge(found);
    if (!correction || !pass.correct(*correction)) break;
    found = pass();
  }
  return found;
}

} // namespace platen::apps
