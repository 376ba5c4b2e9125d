#include "dem/statics/multigrid.h"

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "dem/statics/clusters.h"

namespace platen::dem::statics {
namespace {

// Measured on packings of 10 000 to 160 000 spheres (bench/results/static.md).
constexpr int degree = 2;            // of the smoothing polynomial, before and after
constexpr double smoothed = 8;       // it acts on eigenvalues from 1/smoothed of the largest one
constexpr double largest = 2.1;      // of the scaled matrix: 2 for any network of springs, and a margin
constexpr double correction = 1.5;   // rigid clusters are too stiff: factor on their result
constexpr std::size_t few_rows = 60; // are solved exactly
// Added to diagonals, over their mean: a network that can move as a rigid body has no inverse.
constexpr double softest = 1e-6;

} // namespace

template <int n>
struct Multigrid<n>::Level {
  std::vector<float> right, solution;
  // Of all levels but the last one:
  BlockMatrix<n, float> matrix;
  std::vector<float> inverse; // of the diagonal blocks; 0 where fixed
  Clusters<n> clusters;
  std::vector<float> residual, direction;
  // Of the last one:
  Eigen::LDLT<Eigen::MatrixXd> factor;
  std::vector<char> fixed;
};

namespace {

// Mean of the diagonal over the rows that are free.
template <int n>
double mean_diagonal(const BlockMatrix<n, double> &a, const std::vector<char> &fixed) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1] && !fixed[i]; ++k)
      if (static_cast<std::size_t>(a.column[k]) == i)
        for (int c = 0; c < n; ++c, ++count)
          sum += a.at(k)[(n + 1) * c];
  return count > 0 && sum > 0 ? sum / static_cast<double>(count) : 1.0;
}

template <int n>
std::vector<float> inverse_of_diagonal(const BlockMatrix<n, double> &a, const std::vector<char> &fixed) {
  using Block = Eigen::Matrix<double, n, n>;
  const double soft = softest * mean_diagonal(a, fixed);
  std::vector<float> inverse(a.rows() * n * n, 0.0f);
  for_each(
      a.rows(),
      [&](std::size_t i) {
        if (fixed[i]) return;
        Block d = soft * Block::Identity();
        for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k)
          if (static_cast<std::size_t>(a.column[k]) == i) d += Eigen::Map<const Block>(a.at(k));
        const Block b = d.llt().solve(Block::Identity());
        for (int c = 0; c < n * n; ++c)
          inverse[i * n * n + static_cast<std::size_t>(c)] = static_cast<float>(b.data()[c]);
      },
      rows_per_part);
  return inverse;
}

template <int n>
BlockMatrix<n, float> in_single(const BlockMatrix<n, double> &a) {
  BlockMatrix<n, float> b;
  b.begin = a.begin;
  b.column = a.column;
  b.block.resize(a.block.size());
  for_each(
      a.block.size(), [&](std::size_t k) { b.block[k] = static_cast<float>(a.block[k]); }, 1 << 16);
  return b;
}

} // namespace

template <int n>
Multigrid<n>::Multigrid(const BlockMatrix<n, double> &matrix, const std::vector<Vector3> &place,
                        const std::vector<double> &length, const std::vector<char> &fixed) {
  make_next(matrix, place, length, fixed);
}
template <int n>
Multigrid<n>::~Multigrid() = default;
template <int n>
Multigrid<n>::Multigrid(Multigrid &&) noexcept = default;

template <int n>
void Multigrid<n>::make_next(const BlockMatrix<n, double> &a, std::vector<Vector3> place,
                             std::vector<double> length, std::vector<char> fixed) {
  const std::size_t rows = a.rows();
  Level &level = levels_.emplace_back();
  level.right.resize(n * rows);
  level.solution.resize(n * rows);
  if (rows > few_rows) level.clusters = Clusters<n>(a, place, length, fixed);
  if (rows > few_rows && 2 * level.clusters.size() < rows) {
    level.inverse = inverse_of_diagonal(a, fixed);
    level.matrix = in_single(a);
    level.residual.resize(n * rows);
    level.direction.resize(n * rows);
    const Clusters<n> &c = level.clusters;
    const std::vector<char> none(c.size(), 0);
    make_next(c.stiffness(a), c.place(), c.length(), none);
    return;
  }
  level.clusters = {};
  const Eigen::Index size = n * static_cast<Eigen::Index>(rows);
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(a.column[k]);
      if (!fixed[i] && !fixed[j])
        dense.template block<n, n>(n * static_cast<Eigen::Index>(i), n * static_cast<Eigen::Index>(j)) +=
            Eigen::Map<const Eigen::Matrix<double, n, n>>(a.at(k));
    }
  const double mean = mean_diagonal(a, fixed);
  for (Eigen::Index i = 0; i < size; ++i)
    dense(i, i) += (fixed[i / n] ? 1 : softest) * mean;
  level.factor.compute(dense);
  level.fixed = std::move(fixed);
}

// solution = (approximate inverse) right, on a level; the remainder in `residual`, if required.
template <int n>
void Multigrid<n>::cycle(std::size_t at, bool rest) {
  Level &l = levels_[at];
  if (at + 1 == levels_.size()) {
    const Eigen::Map<const Eigen::VectorXf> right(l.right.data(), static_cast<Eigen::Index>(l.right.size()));
    Eigen::Map<Eigen::VectorXf>(l.solution.data(), right.size()) =
        l.factor.solve(right.cast<double>()).template cast<float>();
    for (std::size_t k = 0; k < l.solution.size(); ++k)
      if (l.fixed[k / n]) l.solution[k] = 0;
    return;
  }
  const std::size_t rows = l.matrix.rows();
  const double middle = 0.5 * largest * (1 + 1 / smoothed), half = 0.5 * largest * (1 - 1 / smoothed);
  // Each pass: direction = a direction + b D^-1 residual, solution += direction, residual -= A direction.
  const auto smooth = [&](bool last_product) {
    double rho = half / middle;
    for (int k = 0; k < degree; ++k) {
      const double next = k == 0 ? rho : 1 / (2 * middle / half - rho);
      const float a = k == 0 ? 0.0f : static_cast<float>(next * rho);
      const float b = static_cast<float>(k == 0 ? 1 / middle : 2 * next / half);
      rho = next;
      for_each(
          rows,
          [&](std::size_t i) {
            float scaled[n] = {};
            add_product<n>(l.inverse.data() + i * n * n, l.residual.data() + i * n, scaled);
            for (std::size_t c = 0; c < n; ++c) {
              const std::size_t s = i * n + c;
              l.direction[s] = a * l.direction[s] + b * scaled[c];
              l.solution[s] += l.direction[s];
            }
          },
          rows_per_part);
      if (k + 1 == degree && !last_product) return;
      for_each_product(l.matrix, l.direction.data(), [&](std::size_t i, const float *sum) {
        for (std::size_t c = 0; c < n; ++c)
          l.residual[i * n + c] -= sum[c];
      });
    }
  };
  l.residual = l.right;
  std::fill(l.solution.begin(), l.solution.end(), 0.0f);
  std::fill(l.direction.begin(), l.direction.end(), 0.0f);
  smooth(true);
  visit_next(at);
  smooth(rest);
}

// Adds the solution of the next level for the residual, in two cycles (one where it is exact).
template <int n>
void Multigrid<n>::visit_next(std::size_t at) {
  Level &l = levels_[at], &next = levels_[at + 1];
  const bool last = at + 2 == levels_.size();
  l.clusters.gather(l.residual, next.right);
  cycle(at + 1, !last);
  if (!last) {
    const std::vector<float> first = next.solution;
    std::swap(next.right, next.residual);
    cycle(at + 1, false);
    for (std::size_t k = 0; k < first.size(); ++k)
      next.solution[k] += first[k];
  }
  l.clusters.spread(next.solution, static_cast<float>(correction), l.direction);
  for_each_product(l.matrix, l.direction.data(), [&](std::size_t i, const float *sum) {
    for (std::size_t c = 0; c < n; ++c) {
      l.solution[i * n + c] += l.direction[i * n + c];
      l.residual[i * n + c] -= sum[c];
    }
  });
}

template <int n>
void Multigrid<n>::apply(const std::vector<double> &r, std::vector<double> &z) {
  Level &finest = levels_.front();
  // Single precision has a short range: the residual is scaled to a largest entry of one.
  double size = 0;
  for (const double a : r)
    size = std::max(size, std::abs(a));
  if (!(size > 0)) {
    std::fill(z.begin(), z.end(), 0.0);
    return;
  }
  for_each(
      r.size(), [&](std::size_t k) { finest.right[k] = static_cast<float>(r[k] / size); }, 1 << 14);
  cycle(0, false);
  for_each(
      z.size(), [&](std::size_t k) { z[k] = size * static_cast<double>(finest.solution[k]); }, 1 << 14);
}

template class Multigrid<3>;
template class Multigrid<6>;

} // namespace platen::dem::statics
