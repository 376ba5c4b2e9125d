#include "apps/calibrate/response_model.h"

#include <Eigen/Cholesky>
#include <nlopt.hpp>

#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

// What the guess weighs, as the square of a distance between trials: a guess off by a half is as good as what
// trials that scatter by a percent say over a thirtieth of a large change.
constexpr double guess_weight = 1e-3;
constexpr double known_weight = 1e6;
// Trials farther from the best than a fifth of a large change count less: responses are not linear.
constexpr double reach = 0.2;
// Of the square of the step, beside the responses': of steps that do the same, the shortest.
constexpr double shortness = 1e-4;
// Of parameters, that NLopt is asked for, over that within which they are the same.
constexpr double precision = 1e-4;

struct Fit {
  Eigen::MatrixXd slopes;
  Eigen::VectorXd from, responses; // of the best trial
};

// Sum of squares that the model has there, with its gradient.
double sum_of_squares(const std::vector<double> &x, std::vector<double> &gradient, void *data) {
  const Fit &fit = *static_cast<const Fit *>(data);
  const auto size = static_cast<Eigen::Index>(x.size());
  const Eigen::VectorXd step = Eigen::Map<const Eigen::VectorXd>(x.data(), size) - fit.from;
  const Eigen::VectorXd responses = fit.responses + fit.slopes * step;
  if (!gradient.empty())
    Eigen::Map<Eigen::VectorXd>(gradient.data(), size) =
        2 * (fit.slopes.transpose() * responses + shortness * step);
  return responses.squaredNorm() + shortness * step.squaredNorm();
}

} // namespace

ResponseModel::ResponseModel(std::vector<SearchParameter> parameters, Eigen::MatrixXd guess, double same)
    : parameters_(std::move(parameters)), guess_(std::move(guess)), same_(same) {}

void ResponseModel::add(const Eigen::VectorXd &parameters, const Eigen::VectorXd &responses) {
  tried_.push_back({parameters, responses});
}

Eigen::VectorXd ResponseModel::start() const {
  Eigen::VectorXd x(parameters_.size());
  for (std::size_t k = 0; k < parameters_.size(); ++k)
    x[static_cast<Eigen::Index>(k)] =
        std::clamp(parameters_[k].start, parameters_[k].low, parameters_[k].high);
  return x;
}

std::size_t ResponseModel::best() const {
  const auto least = std::min_element(tried_.begin(), tried_.end(), [](const Tried &a, const Tried &b) {
    return a.responses.squaredNorm() < b.responses.squaredNorm();
  });
  return static_cast<std::size_t>(least - tried_.begin());
}

// Least squares over the differences to the best trial, with the guess as one more observation (ridge).
Eigen::MatrixXd ResponseModel::slopes() const {
  if (parameters_.empty()) return guess_;
  const Tried &from = tried_.at(best());
  const auto size = static_cast<Eigen::Index>(parameters_.size());
  Eigen::VectorXd weights(size);
  for (Eigen::Index k = 0; k < size; ++k)
    weights[k] = parameters_[static_cast<std::size_t>(k)].known ? known_weight : guess_weight;
  Eigen::MatrixXd left = weights.asDiagonal();
  Eigen::MatrixXd right = weights.asDiagonal() * guess_.transpose();
  for (const Tried &t : tried_) {
    const Eigen::VectorXd d = t.parameters - from.parameters;
    double far = 0;
    for (Eigen::Index k = 0; k < size; ++k)
      if (!parameters_[static_cast<std::size_t>(k)].known) far += d[k] * d[k];
    const double weight = 1 / (1 + far / (reach * reach));
    left += weight * d * d.transpose();
    right += weight * d * (t.responses - from.responses).transpose();
  }
  return left.ldlt().solve(right).transpose();
}

std::optional<Eigen::VectorXd> ResponseModel::next() const {
  if (parameters_.empty()) return std::nullopt;
  const Tried &from = tried_.at(best());
  Fit fit{slopes(), from.parameters, from.responses};
  std::vector<double> low, high, x(from.parameters.data(), from.parameters.data() + from.parameters.size());
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    low.push_back(std::max(parameters_[k].low, x[k] - parameters_[k].step));
    high.push_back(std::min(parameters_[k].high, x[k] + parameters_[k].step));
  }
  nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(x.size()));
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_min_objective(sum_of_squares, &fit);
  search.set_xtol_abs(precision * same_);
  search.set_maxeval(1000);
  double least = 0;
  try {
    search.optimize(x, least);
  } catch (const nlopt::roundoff_limited &) { // x is the best that was found
  }
  Eigen::VectorXd to = Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
  for (const Tried &t : tried_)
    if ((t.parameters - to).lpNorm<Eigen::Infinity>() < same_) return std::nullopt;
  return to;
}

} // namespace platen::apps
