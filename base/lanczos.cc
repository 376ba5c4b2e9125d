#include "base/lanczos.h"

#include <Eigen/Eigenvalues>

namespace platen {

LargestRitzValue largest_ritz_value(const std::vector<double> &diagonal, const std::vector<double> &beside) {
  const Eigen::Index n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(Eigen::Map<const Eigen::VectorXd>(diagonal.data(), n),
                              Eigen::Map<const Eigen::VectorXd>(beside.data(), n - 1));
  return {ritz.eigenvalues()[n - 1], std::abs(ritz.eigenvectors()(n - 1, n - 1))};
}

} // namespace platen
