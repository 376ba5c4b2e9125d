#include "apps/calibrate/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
      : asked_(calibrate_of(scene)),
        goals_(goals),
        test_(test),
        space_(std::move(space)),
        of_(std::move(of)),
        elastic_(elastic),
        exact_(exact),
        model_(without_trials()) {}

  Found operator()();

  // Goes on with what was tried, corrected. False where no trial is left.
  bool correct(const Correction &by) {
    if (trials_ >= most()) return false;
    correction_ = by;
    model_ = without_trials();
    met_.reset();
    for (std::size_t k = 0; k < tried_.size(); ++k)
      learn(k);
    settle();
    return true;
  }

private:
  struct Tried {
    Eigen::VectorXd at;
    Choice choice;
    Measured measured; // not corrected
  };

  bool done() const { return met_.has_value(); }
  int most() const { return elastic_ ? most_elastic : asked_.most_trials; }
  ResponseModel without_trials() const {
    return {space_.parameters(exact_), space_.guess(goals_, of_), elastic_ ? elastic_same : same};
  }
  Measured measured(std::size_t trial) const { return corrected(tried_[trial].measured, correction_); }
  template <class Holds>
  bool all_goals(const Holds &hold) const {
    return std::all_of(of_.begin(), of_.end(), hold);
  }

  // How a curve goes with a parameter that bends it no formula tells.
  bool takes_differences() const {
    const bool bends_a_curve = space_.free(FreeParameter::compression_limits) &&
                               !all_goals([&](std::size_t k) { return !goals_.all()[k].curve; });
    return !elastic_ && (asked_.measures_differences() || bends_a_curve);
  }

  void learn(std::size_t trial) {
    const Measured m = measured(trial);
    model_.add(tried_[trial].at, goals_.responses(of_, m));
    const bool ends = all_goals([&](std::size_t k) {
      return elastic_ ? std::abs(goals_.miss(k, m)) <= elastic_precision : goals_.surely_met(k, m);
    });
    if (!done() && ends) met_ = trial;
  }

  // Half of the trials are for a margin. After them the tolerance itself is enough: what is left is for
  // packings that miss all the same.
  void settle() {
    if (done() || elastic_ || 2 * trials_ <= most()) return;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t trial = 0; trial < tried_.size(); ++trial) {
      const Measured m = measured(trial);
      const double size = goals_.responses(of_, m).squaredNorm();
      if (all_goals([&](std::size_t k) { return goals_.met(k, m); }) && size < least)
        least = size, met_ = trial;
    }
  }

  bool try_all(const std::vector<Eigen::VectorXd> &x);
  void take_differences(const Eigen::VectorXd &x, double size);
  Found found() const;

  const Calibrate &asked_;
  const Goals &goals_;
  const Measurement &test_;
  Space space_;
  std::vector<std::size_t> of_;
  bool elastic_, exact_;
  std::optional<std::size_t> met_; // the trial that ended it
  int differences_ = 0;            // how often they were taken
  ResponseModel model_;
  std::vector<Tried> tried_; // that told something
  Correction correction_;
  int trials_ = 0;
  std::string too_fast_; // why the first trial that told nothing was no quasi-static one
};

// Whether any of them tells something.
bool Pass::try_all(const std::vector<Eigen::VectorXd> &x) {
  std::vector<Choice> choices;
  for (const Eigen::VectorXd &one : x)
    choices.push_back(space_.choice(one));
  const std::vector<Measured> measured = test_(choices, elastic_);
  trials_ += static_cast<int>(x.size());
  bool told = false;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (goals_.responses(of_, measured[k]).size() == 0) {
      if (too_fast_.empty()) too_fast_ = measured[k].too_fast;
      continue;
    }
    told = true;
    tried_.push_back({x[k], choices[k], measured[k]});
    learn(tried_.size() - 1);
  }
  return told;
}

// One parameter after the other, away from the nearer bound; all at once, so that threads share them.
void Pass::take_differences(const Eigen::VectorXd &x, double size) {
  std::vector<Eigen::VectorXd> all;
  for (const SearchParameter &parameter : space_.parameters(exact_)) {
    Eigen::VectorXd to = x;
    double &moved = to[static_cast<Eigen::Index>(all.size())];
    const double up = parameter.high - moved, down = moved - parameter.low;
    moved += up >= down ? std::min(size, up) : -std::min(size, down);
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
    if (takes_differences() && differences_ == 0 && !done()) take_differences(*x, difference);
    settle();
    x = model_.next();
    if (x || done() || !takes_differences() || differences_ > 1 || trials_ >= most()) continue;
    take_differences(tried_.at(model_.best()).at, near_difference); // the slopes there may be others
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
  const Choice &choice = tried_[best].choice;
  return {choice,
          measured(best),
          elastic_ ? 0 : trials_,
          {of_, space_.free(), space_.by_logarithms(model_.slopes(), choice),
           goals_.responses(of_, measured(best)), differences_ > 0},
          space_.at_bounds(choice)};
}

// Strengths of brittle bonds are proportional to theirs.
bool proportional(const Scene &scene) {
  const Calibrate &c = calibrate_of(scene);
  return !c.wants({TargetKind::strain_at_peak, TargetKind::curve}) && c.free.empty() &&
         !c.measures_differences() && !has_parameter(scene, FreeParameter::compression_limits);
}

} // namespace

Found search(const Scene &scene, const Goals &goals, const Measurement &test, const Judge &judge) {
  std::vector<ParameterFacts> free = parameters_of(scene), elastic;
  std::copy_if(free.begin(), free.end(), std::back_inserter(elastic),
               [](const ParameterFacts &parameter) { return parameter.elastic; });
  const std::vector<std::size_t> wanted = goals.wanted(), by_solves = goals.wanted(true);
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
