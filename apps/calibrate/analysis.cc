#include "apps/calibrate/analysis.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace platen::apps {
namespace {

constexpr double closely = 0.95; // correlated
constexpr double half = 0.4;     // change of a logarithm
// Of the largest eigenvalue: beneath it there is round-off, and an inverse would be of that.
constexpr double floor_of_eigenvalues = 1e-10;
constexpr double worth_telling = 0.2; // of a direction

// use(k, row, rows) of the rows that each goal has of the slopes, or of the responses.
template <class Use>
void for_goals(const Goals &goals, const Sensitivities &at, const Use &use) {
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < at.goals.size(); ++k) {
    const Eigen::Index rows = goals.all()[at.goals[k]].rows();
    use(k, row, rows);
    row += rows;
  }
}

Eigen::MatrixXd sensitivities_of(const Goals &goals, const Sensitivities &at) {
  Eigen::MatrixXd table(at.slopes.cols(), at.goals.size());
  for_goals(goals, at, [&](std::size_t k, Eigen::Index row, Eigen::Index rows) {
    for (Eigen::Index parameter = 0; parameter < table.rows(); ++parameter) {
      const Eigen::VectorXd slopes = at.slopes.col(parameter).segment(row, rows) / goals.scale(at.goals[k]);
      table(parameter, static_cast<Eigen::Index>(k)) =
          rows == 1 ? slopes[0] : slopes.norm() / std::sqrt(static_cast<double>(rows));
    }
  });
  return table;
}

std::string direction(const std::vector<ParameterFacts> &free, const Eigen::VectorXd &way) {
  std::string text;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const double share = way[static_cast<Eigen::Index>(k)];
    if (std::abs(share) >= worth_telling)
      text += fmt::format("{}{} {:+.2f}", text.empty() ? "" : ", ", free[k].words, share);
  }
  return text;
}

void correlate(const Sensitivities &at, double tolerance, Analysis &a) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(at.slopes.transpose() * at.slopes);
  const Eigen::VectorXd &values = solved.eigenvalues();
  const double least = floor_of_eigenvalues * std::max(values.maxCoeff(), tolerance * tolerance);
  const Eigen::MatrixXd inverse = solved.eigenvectors() * values.cwiseMax(least).cwiseInverse().asDiagonal() *
                                  solved.eigenvectors().transpose();
  const Eigen::VectorXd scales = inverse.diagonal().cwiseSqrt().cwiseInverse();
  a.correlations = scales.asDiagonal() * inverse * scales.asDiagonal();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (half * std::sqrt(std::max(values[k], 0.0)) < tolerance)
      a.undetermined.push_back(direction(at.free, solved.eigenvectors().col(k)));
    for (Eigen::Index other = 0; other < k; ++other)
      if (std::abs(a.correlations(k, other)) > closely)
        a.correlated.push_back(
            fmt::format("{} against {} ({:+.3f})", at.free[static_cast<std::size_t>(other)].words,
                        at.free[static_cast<std::size_t>(k)].words, a.correlations(k, other)));
  }
}

std::vector<std::string> missed(const Goals &goals, const Found &found) {
  const Sensitivities &at = found.sensitivities;
  std::vector<Eigen::VectorXd> pulls;
  for_goals(goals, at, [&](std::size_t, Eigen::Index row, Eigen::Index rows) {
    pulls.emplace_back(at.slopes.middleRows(row, rows).transpose() * at.responses.segment(row, rows));
  });
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < at.goals.size(); ++k) {
    const Goal &goal = goals.all()[at.goals[k]];
    if (goals.met(at.goals[k], found.measured)) continue;
    const double miss = goals.miss(at.goals[k], found.measured);
    std::string line = goal.words() + ": ";
    if (std::isnan(miss)) {
      lines.push_back(line + "was not measured");
      continue;
    }
    if (goal.curve)
      line += fmt::format("off by {:.3g}, tolerance {:.2g}", miss, goal.tolerance);
    else
      line += fmt::format("{:.4g} is out of reach, the nearest is {:.4g} ({:+.1f} %, tolerance {:.2g} %)",
                          goal.value / goal.unit(), (1 + miss) * goal.value / goal.unit(), 100 * miss,
                          100 * goal.tolerance);
    std::size_t against = k;
    for (std::size_t other = 0; other < pulls.size(); ++other)
      if (pulls[k].dot(pulls[other]) < std::min(0.0, pulls[k].dot(pulls[against]))) against = other;
    if (against != k)
      line += "; against it pulls " + goals.all()[at.goals[against]].words() +
              ": drop one of the two, or give it a wider tolerance";
    lines.push_back(line);
  }
  return lines;
}

} // namespace

Analysis analyse(const Goals &goals, const Found &found) {
  Analysis a;
  a.sensitivities = sensitivities_of(goals, found.sensitivities);
  if (!found.sensitivities.free.empty()) correlate(found.sensitivities, goals.asked().tolerance, a);
  a.missed = missed(goals, found);
  return a;
}

} // namespace platen::apps
