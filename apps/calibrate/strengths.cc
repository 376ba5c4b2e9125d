#include "apps/calibrate/strengths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/calibrate/response_model.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

// Where no run comes to a peak the bonds are too strong for the largest strain.
constexpr double weaker = 0.5;
constexpr int most_weaker = 4;
// A strength that is off by more is told as missed.
constexpr double out_of_reach = 0.05;
// A confined specimen that comes to no peak counts as so many times too strong.
constexpr double without_peak = 2;
// Large changes of the logarithm of shear over tensile strength, of the moment contribution and of the
// friction angle (rad), and how much of one is tried at once.
constexpr double ratio_unit = 2.5, moments_unit = 0.6, friction_unit = 1, one_step = 0.35;
// Of the tensile strength, to which strengths are proportional: no bound that matters.
constexpr double scale_step = 10;
// Where the model begins: what was seen of a concrete of parallel bonds (scenes/parts/concrete.prm), changes
// of the logarithm of a strength with each parameter.
constexpr double compressive_by_ratio = 0.25, compressive_by_moments = -2.5, compressive_by_friction = 0.1;
constexpr double triaxial_by_ratio = 0.5, triaxial_by_friction = 0.5;
constexpr double largest_friction =
    1.0471975511965976; // rad; where a triaxial strength alone frees the angle

class Search {
public:
  Search(const Scene &scene, const BondChoice &start)
      : c_(scene.calibrate), may_(strength_parameters(scene)), start_(start) {
    if (wanted(c_.compressive_strength)) responses_.push_back(compressive);
    if (wanted(c_.tensile_strength)) responses_.push_back(tensile);
    if (wanted(c_.triaxial_strength)) responses_.push_back(triaxial);
  }

  FoundStrengths operator()(const StrengthTest &test);

private:
  enum Response { compressive, tensile, triaxial };

  ResponseModel model() const;
  BondChoice choice(const Eigen::VectorXd &x) const;
  Eigen::VectorXd misses(const Strengths &s) const;
  double off(const Eigen::VectorXd &misses) const {
    return misses.unaryExpr([](double miss) { return std::abs(std::expm1(miss)); }).maxCoeff();
  }
  double goal(Response r) const {
    return r == compressive ? c_.compressive_strength
                            : (r == tensile ? c_.tensile_strength : c_.triaxial_strength);
  }
  std::string story(const FoundStrengths &found, const Eigen::VectorXd &misses) const;

  const Calibrate &c_;
  StrengthParameters may_;
  BondChoice start_;
  std::vector<Response> responses_;
};

// Parameters in the order of their columns.
ResponseModel Search::model() const {
  std::vector<SearchParameter> parameters;
  std::vector<Eigen::Vector3d> slopes; // of each response
  const double own = std::log(start_.tensile_strength);
  // A pressure does not grow with the bonds: of a confined strength the rest does.
  const double share = std::min(1.0, c_.compressive_strength / c_.triaxial_strength);
  parameters.push_back({own, own - scale_step, own + scale_step, scale_step, true});
  slopes.emplace_back(1, 1, wanted(share) ? share : 1);
  const double step = one_step;
  if (may_.shear) {
    const double u = ratio_unit, ratio = std::log(start_.shear_strength / start_.tensile_strength);
    parameters.push_back(
        {ratio / u, std::log(c_.strengths_low) / u, std::log(c_.strengths_high) / u, step, false});
    slopes.emplace_back(u * compressive_by_ratio, 0, u * triaxial_by_ratio);
  }
  if (may_.moments) {
    const double u = moments_unit, moments = start_.moment_contribution;
    parameters.push_back({moments / u, c_.moments_low / u, moments / u, step, false});
    slopes.emplace_back(u * compressive_by_moments, 0, u * compressive_by_moments);
  }
  if (may_.friction) {
    const double u = friction_unit;
    parameters.push_back(
        {start_.friction_angle / u, may_.friction_low / u, may_.friction_high / u, step, false});
    slopes.emplace_back(u * compressive_by_friction, 0, u * triaxial_by_friction);
  }
  Eigen::MatrixXd guess(responses_.size(), parameters.size());
  for (Eigen::Index r = 0; r < guess.rows(); ++r)
    for (Eigen::Index k = 0; k < guess.cols(); ++k)
      guess(r, k) = slopes[static_cast<std::size_t>(k)][responses_[static_cast<std::size_t>(r)]];
  return {parameters, guess};
}

BondChoice Search::choice(const Eigen::VectorXd &x) const {
  BondChoice to = start_;
  Eigen::Index k = 0;
  to.tensile_strength = std::exp(x[k++]);
  const double own = start_.shear_strength / start_.tensile_strength;
  to.shear_strength = to.tensile_strength * (may_.shear ? std::exp(ratio_unit * x[k++]) : own);
  if (may_.moments) to.moment_contribution = moments_unit * x[k++];
  if (may_.friction) to.friction_angle = friction_unit * x[k++];
  return to;
}

// Empty where no run came to a peak, be it in compression or in tension.
Eigen::VectorXd Search::misses(const Strengths &s) const {
  Eigen::VectorXd all(responses_.size());
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    const Response r = responses_[k];
    double measured = r == compressive ? s.compressive : (r == tensile ? s.tensile : s.triaxial);
    if (std::isnan(measured) && r != triaxial) return {};
    if (std::isnan(measured)) measured = without_peak * goal(r);
    all[static_cast<Eigen::Index>(k)] = std::log(measured / goal(r));
  }
  return all;
}

FoundStrengths Search::operator()(const StrengthTest &test) {
  ResponseModel responses = model();
  FoundStrengths found;
  std::vector<BondChoice> tried;
  std::vector<Eigen::VectorXd> missed;
  std::optional<Eigen::VectorXd> x = responses.start();
  for (int in_vain = 0; x && found.trials < c_.most_trials;) {
    const BondChoice now = choice(*x);
    const Eigen::VectorXd miss = misses(test(now, ++found.trials));
    if (miss.size() == 0) {
      if (++in_vain > most_weaker) break;
      (*x)[0] += std::log(weaker);
      continue;
    }
    tried.push_back(now), missed.push_back(miss);
    responses.add(*x, miss);
    if (off(miss) <= c_.tolerance) break;
    x = responses.next();
  }
  if (tried.empty())
    throw NumericsError(
        "no run came to a peak; a larger Loading/Target strain, or weaker bonds to begin with, help");
  const std::size_t best = responses.best();
  found.choice = tried[best];
  if (off(missed[best]) > out_of_reach) found.missed.push_back(story(found, missed[best]));
  return found;
}

std::string Search::story(const FoundStrengths &found, const Eigen::VectorXd &misses) const {
  constexpr const char *words[] = {"compressive", "tensile", "triaxial"};
  std::string text =
      fmt::format("the wanted strengths were not reached in {} trials: the nearest are", found.trials);
  for (std::size_t k = 0; k < responses_.size(); ++k) {
    const double wish = goal(responses_[k]);
    text += fmt::format("{} {} {:.4g} MPa for {:.4g} MPa", k == 0 ? "" : ",", words[responses_[k]],
                        1e-6 * wish * std::exp(misses[static_cast<Eigen::Index>(k)]), 1e-6 * wish);
  }
  const BondChoice &c = found.choice;
  if (may_.shear)
    text += fmt::format("; shear over tensile strength of the bond {:.4g} (searched from {:.4g} to {:.4g})",
                        c.shear_strength / c.tensile_strength, c_.strengths_low, c_.strengths_high);
  if (may_.moments)
    text += fmt::format("; moment contribution {:.4g} (searched from {:.4g} to {:.4g})",
                        c.moment_contribution, c_.moments_low, start_.moment_contribution);
  if (may_.friction)
    text += fmt::format("; friction angle {:.4g} degree (searched from {:.4g} to {:.4g})",
                        c.friction_angle / degree, may_.friction_low / degree, may_.friction_high / degree);
  return text;
}

} // namespace

StrengthParameters strength_parameters(const Scene &scene) {
  const Calibrate &c = scene.calibrate;
  const int goals = int(wanted(c.compressive_strength)) + int(wanted(c.tensile_strength));
  StrengthParameters to;
  to.shear = goals == 2;
  // Elasto-damage-plastic bonds have neither; without moments there is nothing to count.
  const std::optional<dem::BondParameters> bond = scene.bond.parameters();
  to.moments = goals == 2 && scene.bond.has("moment_contribution") && scene.model.rotation &&
               dem::bends(dem::bond_law(*bond)) && c.moments_low < scene.bond.number("moment_contribution");
  const bool free = wanted(c.triaxial_strength);
  to.friction_low =
      wanted(c.friction_low) ? c.friction_low : (free ? 0 : scene.bond.number("friction_angle"));
  to.friction_high = wanted(c.friction_high)
                         ? c.friction_high
                         : (free ? largest_friction : scene.bond.number("friction_angle"));
  to.friction =
      scene.bond.has("friction_angle") && (goals == 2 || free) && to.friction_low < to.friction_high;
  return to;
}

FoundStrengths search_strengths(const Scene &scene, const BondChoice &start, const StrengthTest &test) {
  return Search(scene, start)(test);
}

} // namespace platen::apps
