#include "apps/calibrate/analysis.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include "apps/calibrate/calibrate_section.h"

namespace platen::apps {
namespace {

constexpr double closely = 0.95; // correlated
constexpr double half = 0.4;     // change of a logarithm
// Of the largest eigenvalue: beneath it there is round-off, and an inverse would be of that.
constexpr double floor_of_eigenvalues = 1e-10;
constexpr double worth_telling = 0.2; // of a direction

// The rows of each goal.
template <class Use>
void for_rows(const Goals &goals, const std::vector<std::size_t> &of, const Use &use) {
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < of.size(); ++k) {
    use(k, row, goals.rows(of[k]));
    row += goals.rows(of[k]);
  }
}

Eigen::MatrixXd sensitivities_of(const Goals &goals, const Sensitivities &at) {
  Eigen::MatrixXd table(at.slopes.cols(), at.goals.size());
  for_rows(goals, at.goals, [&](std::size_t k, Eigen::Index row, Eigen::Index rows) {
    const double scale = goals.scale(at.goals[k]);
    for (Eigen::Index parameter = 0; parameter < table.rows(); ++parameter) {
      const Eigen::VectorXd slopes = at.slopes.col(parameter).segment(row, rows) / scale;
      table(parameter, static_cast<Eigen::Index>(k)) =
          rows == 1 ? slopes[0] : slopes.norm() / std::sqrt(static_cast<double>(rows));
    }
  });
  return table;
}

std::string direction(const Calibrate &asked, const std::vector<FreeParameter> &free,
                      const Eigen::VectorXd &way) {
  std::string text;
  for (std::size_t k = 0; k < free.size(); ++k) {
    const double share = way[static_cast<Eigen::Index>(k)];
    if (std::abs(share) >= worth_telling)
      text += fmt::format("{}{} {:+.2f}", text.empty() ? "" : ", ", facts_of(asked, free[k]).words, share);
  }
  return text;
}

} // namespace

Analysis analyse(const Goals &goals, double tolerance, const Sensitivities &at) {
  Analysis a;
  a.sensitivities = sensitivities_of(goals, at);
  if (at.free.empty()) return a;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(at.slopes.transpose() * at.slopes);
  const Eigen::VectorXd &values = solved.eigenvalues();
  const double least = floor_of_eigenvalues * std::max(values.maxCoeff(), tolerance * tolerance);
  const Eigen::MatrixXd inverse = solved.eigenvectors() * values.cwiseMax(least).cwiseInverse().asDiagonal() *
                                  solved.eigenvectors().transpose();
  const Eigen::VectorXd scales = inverse.diagonal().cwiseSqrt().cwiseInverse();
  a.correlations = scales.asDiagonal() * inverse * scales.asDiagonal();
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (half * std::sqrt(std::max(values[k], 0.0)) < tolerance)
      a.undetermined.push_back(direction(goals.asked(), at.free, solved.eigenvectors().col(k)));
    for (Eigen::Index other = 0; other < k; ++other)
      if (std::abs(a.correlations(k, other)) > closely)
        a.correlated.push_back(fmt::format(
            "{} against {} ({:+.3f})",
            facts_of(goals.asked(), at.free[static_cast<std::size_t>(other)]).words,
            facts_of(goals.asked(), at.free[static_cast<std::size_t>(k)]).words, a.correlations(k, other)));
  }
  return a;
}

std::vector<std::string> missed(const Goals &goals, const Found &found) {
  const Sensitivities &at = found.sensitivities;
  std::vector<Eigen::VectorXd> pulls;
  for_rows(goals, at.goals, [&](std::size_t, Eigen::Index row, Eigen::Index rows) {
    pulls.emplace_back(at.slopes.middleRows(row, rows).transpose() * at.responses.segment(row, rows));
  });
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < at.goals.size(); ++k) {
    const Goal &goal = goals.all()[at.goals[k]];
    if (goals.met(at.goals[k], found.measured)) continue;
    const double miss = goals.miss(at.goals[k], found.measured), unit = goal.unit;
    std::string line = goal.words + ": ";
    if (std::isnan(miss)) {
      lines.push_back(line + "was not measured");
      continue;
    }
    if (goal.curve)
      line += fmt::format("off by {:.3g}", miss);
    else
      line += fmt::format("{:.4g} is out of reach, the nearest is {:.4g} ({:+.1f} %",
                          goal.target.value / unit, (1 + miss) * goal.target.value / unit, 100 * miss);
    line += fmt::format("{} tolerance {:.2g}{}", goal.curve ? "," : ",",
                        goal.curve ? goal.target.tolerance : 100 * goal.target.tolerance,
                        goal.curve ? "" : " %)");
    std::size_t against = k;
    for (std::size_t other = 0; other < pulls.size(); ++other)
      if (pulls[k].dot(pulls[other]) < std::min(0.0, pulls[k].dot(pulls[against]))) against = other;
    if (against != k)
      line += "; against it pulls " + goals.all()[at.goals[against]].words +
              ": drop one of the two, or give it a wider tolerance";
    lines.push_back(line);
  }
  return lines;
}

} // namespace platen::apps
