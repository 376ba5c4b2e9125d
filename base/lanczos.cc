#include "base/lanczos.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace platen {
namespace {

// Number of eigenvalues above x, by the signs of the pivots (Sturm).
int count_above(const std::vector<double> &diagonal, const std::vector<double> &off_diagonal, double x) {
  int count = 0;
  double pivot = 1;
  for (std::size_t k = 0; k < diagonal.size(); ++k) {
    pivot = diagonal[k] - x - (k == 0 ? 0 : off_diagonal[k - 1] * off_diagonal[k - 1] / pivot);
    if (pivot == 0) pivot = -1e-300;
    count += pivot > 0;
  }
  return count;
}

} // namespace

LargestRitzValue largest_ritz_value(const std::vector<double> &diagonal,
                                    const std::vector<double> &off_diagonal) {
  const Eigen::Index n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                              Eigen::Map<const Eigen::VectorXd>(off_diagonal.data(), n - 1));
  return {ritz.eigenvalues()[n - 1], std::abs(ritz.eigenvectors()(n - 1, n - 1))};
}

LargestRitzValue bisected_ritz_value(const std::vector<double> &diagonal,
                                     const std::vector<double> &off_diagonal) {
  const std::size_t n = diagonal.size();
  double low = *std::max_element(diagonal.begin(), diagonal.end()), high = low; // Gershgorin
  for (std::size_t k = 0; k < n; ++k)
    high =
        std::max(high, diagonal[k] + (k > 0 ? off_diagonal[k - 1] : 0) + (k + 1 < n ? off_diagonal[k] : 0));
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (low + high);
    (count_above(diagonal, off_diagonal, middle) > 0 ? low : high) = middle;
  }
  double before = 0, component = 1, sum = 1; // eigenvector components, from the first row on
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double next =
        ((high - diagonal[k]) * component - (k == 0 ? 0 : off_diagonal[k - 1] * before)) / off_diagonal[k];
    before = component, component = next, sum += component * component;
  }
  return {high, std::abs(component) / std::sqrt(sum)};
}

} // namespace platen
