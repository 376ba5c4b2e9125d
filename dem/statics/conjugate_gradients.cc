#include "dem/statics/conjugate_gradients.h"

#include <cmath>
#include <numeric>

namespace platen::dem::statics {
namespace {

// Unknowns of a vector that a thread takes at a time.
constexpr std::size_t entries_per_part = 1 << 13;

double product(const std::vector<double> &a, const std::vector<double> &b) {
  return ordered_sum<double>(
      a.size(),
      [&](std::size_t first, std::size_t last) {
        return std::inner_product(&a[first], &a[0] + last, &b[first], 0.0);
      },
      entries_per_part);
}

} // namespace

template <int n>
Solution conjugate_gradients(const BlockMatrix<n, double> &a, Multigrid<n> &inverse,
                             const std::vector<char> &fixed, const std::vector<double> &right,
                             std::vector<double> &x, double tolerance, int most_iterations) {
  const std::size_t size = right.size();
  std::vector<double> r(size), z(size), d(size, 0.0), ad(size, 0.0);
  // Right-hand side from the loads and from the values of the fixed rows.
  std::vector<double> prescribed(size, 0.0);
  for (std::size_t k = 0; k < size; ++k)
    if (fixed[k / n]) prescribed[k] = x[k];
  const auto residual = [&](std::size_t i, const double *sum) {
    for (std::size_t c = 0; c < n; ++c)
      r[n * i + c] = fixed[i] ? 0.0 : right[n * i + c] - sum[c];
  };
  for_each_product(a, prescribed.data(), residual);
  const double wanted = std::sqrt(product(r, r));
  Solution s;
  if (wanted == 0) {
    x = prescribed;
    return s;
  }
  for_each_product(a, x.data(), residual);
  // The multigrid differs from call to call by round-off of single precision: beta is that of Polak and
  // Ribiere, with the change of the residual.
  double rz = 0, change = 0;
  s.residual = std::sqrt(product(r, r)) / wanted;
  while (s.residual > tolerance && s.iterations < most_iterations) {
    inverse.apply(r, z);
    const double now = product(r, z);
    if (s.iterations > 0) change = product(ad, z);
    const double beta = s.iterations > 0 ? change / rz : 0;
    rz = now;
    for_each(
        size, [&](std::size_t k) { d[k] = z[k] + beta * d[k]; }, entries_per_part);
    for_each_product(a, d.data(), [&](std::size_t i, const double *sum) {
      for (std::size_t c = 0; c < n; ++c)
        ad[n * i + c] = fixed[i] ? 0.0 : sum[c];
    });
    const double curvature = product(d, ad);
    if (!(curvature > 0) || !(rz > 0)) return s;
    const double alpha = rz / curvature;
    for_each(
        size,
        [&](std::size_t k) {
          x[k] += alpha * d[k];
          ad[k] *= -alpha; // change of the residual, kept for beta
          r[k] += ad[k];
        },
        entries_per_part);
    s.residual = std::sqrt(product(r, r)) / wanted;
    ++s.iterations;
  }
  return s;
}

template Solution conjugate_gradients<3>(const BlockMatrix<3, double> &, Multigrid<3> &,
                                         const std::vector<char> &, const std::vector<double> &,
                                         std::vector<double> &, double, int);
template Solution conjugate_gradients<6>(const BlockMatrix<6, double> &, Multigrid<6> &,
                                         const std::vector<char> &, const std::vector<double> &,
                                         std::vector<double> &, double, int);

} // namespace platen::dem::statics
