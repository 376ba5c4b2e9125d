// The largest eigenvalue of a chain of springs, which is known in closed form.
#include "base/lanczos.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/pi.h"

namespace platen::lanczos_test {
namespace {

struct Chain {
  std::vector<double> u;
};

double inner(const Chain &a, const Chain &b) {
  return std::inner_product(a.u.begin(), a.u.end(), b.u.begin(), 0.0);
}
void add(Chain &a, double s, const Chain &b) {
  for (std::size_t k = 0; k < a.u.size(); ++k)
    a.u[k] += s * b.u[k];
}
void multiply(Chain &a, double s) {
  for (double &u : a.u)
    u *= s;
}

// Of masses between fixed ends: 2 u_k - u_(k-1) - u_(k+1).
Chain springs(const Chain &x) {
  Chain y = x;
  for (std::size_t k = 0; k < x.u.size(); ++k)
    y.u[k] = 2 * x.u[k] - (k > 0 ? x.u[k - 1] : 0) - (k + 1 < x.u.size() ? x.u[k + 1] : 0);
  return y;
}

double largest_of_springs(std::size_t n) {
  return 2 + 2 * std::cos(pi / (static_cast<double>(n) + 1));
}

Chain start(std::size_t n) {
  Chain x{std::vector<double>(n)};
  for (std::size_t k = 0; k < n; ++k)
    x.u[k] = std::sin(static_cast<double>(7 * k * k + 1));
  return x;
}

TEST(lanczos, of_a_chain_is_from_above_and_within_the_residual) {
  for (const std::size_t n : {1, 2, 5, 40, 400}) {
    const double exact = largest_of_springs(n);
    const LargestEigenvalue<Chain> found = largest_eigenvalue(springs, start(n));
    EXPECT_GE(found.value, exact * (1 - 1e-14)) << n;
    EXPECT_LE(found.value, exact * 1.01) << n;
    EXPECT_LE(found.iterations, 300) << n;
  }
}

TEST(lanczos, a_smaller_residual_costs_more_iterations_and_is_nearer) {
  double error = 1;
  int iterations = 0;
  for (const double residual : {1e-1, 1e-3, 1e-6}) {
    LanczosLimits limits;
    limits.residual = residual;
    const LargestEigenvalue<Chain> found = largest_eigenvalue(springs, start(100), limits);
    EXPECT_LT(found.value / largest_of_springs(100) - 1, error) << residual;
    EXPECT_GT(found.iterations, iterations) << residual;
    error = found.value / largest_of_springs(100) - 1, iterations = found.iterations;
  }
  EXPECT_LT(error, 1e-6);
}

// Who asks whether it is below a bound is told earlier; a bound that is not met changes nothing.
TEST(lanczos, ends_once_the_value_is_known_to_be_below_a_bound) {
  const double exact = largest_of_springs(400);
  LanczosLimits limits;
  limits.residual = 1e-4;
  const LargestEigenvalue<Chain> full = largest_eigenvalue(springs, start(400), limits);
  limits.enough = .999 * exact;
  const LargestEigenvalue<Chain> above = largest_eigenvalue(springs, start(400), limits);
  EXPECT_EQ(above.value, full.value);
  EXPECT_EQ(above.iterations, full.iterations);
  limits.enough = 1.05 * exact;
  const LargestEigenvalue<Chain> below = largest_eigenvalue(springs, start(400), limits);
  EXPECT_LT(below.value, limits.enough);
  EXPECT_GT(below.value, .99 * exact);
  EXPECT_LT(below.iterations, full.iterations);
  EXPECT_GE(below.iterations, limits.least_for_enough);
}

// A start that is all of one mode leaves nothing to go on to.
TEST(lanczos, ends_at_once_from_an_eigenvector) {
  Chain mode{std::vector<double>(9)};
  for (std::size_t k = 0; k < 9; ++k)
    mode.u[k] = std::sin(9 * pi * static_cast<double>(k + 1) / 10);
  const LargestEigenvalue<Chain> found = largest_eigenvalue(springs, mode);
  EXPECT_LE(found.iterations, 2);
  EXPECT_NEAR(found.value, largest_of_springs(9), 1e-13);
  EXPECT_NEAR(std::abs(inner(found.mode, mode)), std::sqrt(inner(mode, mode)), 1e-12);
}

TEST(lanczos, takes_the_iterations_that_its_limits_ask_for) {
  LanczosLimits limits;
  limits.least = 20, limits.every = 1;
  EXPECT_EQ(largest_eigenvalue(springs, start(400), limits).iterations, 21);
  limits.residual = 0, limits.most = 33;
  EXPECT_EQ(largest_eigenvalue(springs, start(400), limits).iterations, 33);
  limits.residual = 1, limits.least = 4, limits.every = 5; // looked at after every fifth
  EXPECT_EQ(largest_eigenvalue(springs, start(400), limits).iterations, 5);
}

TEST(lanczos, the_ritz_value_and_its_component_are_those_of_two_masses) {
  // {{2, 1}, {1, 3}}: (5 + sqrt 5) / 2, vector (1, value - 2) over its length
  const double value = 0.5 * (5 + std::sqrt(5.0)), second = value - 2;
  for (const FindRitzValue find : {largest_ritz_value, bisected_ritz_value}) {
    const LargestRitzValue ritz = find({2, 3}, {1});
    EXPECT_NEAR(ritz.value, value, 1e-15 * 4);
    EXPECT_NEAR(ritz.last_component, second / std::hypot(1, second), 1e-15);
  }
}

TEST(lanczos, bisection_finds_the_ritz_value_of_a_long_matrix_and_its_component) {
  // 2 off_diagonal 1s, n rows: 2 + 2 cos(pi / (n + 1)), components sqrt(2 / (n + 1)) sin(k pi / (n + 1))
  for (const std::size_t n : {1, 2, 3, 30, 300}) {
    const std::vector<double> diagonal(n, 2), off_diagonal(n, 1); // the last of `off_diagonal` is not read
    const LargestRitzValue ritz = bisected_ritz_value(diagonal, off_diagonal);
    const double parts = static_cast<double>(n) + 1, last = std::sqrt(2 / parts) * std::sin(pi / parts);
    EXPECT_NEAR(ritz.value, largest_of_springs(n), 1e-14) << n;
    EXPECT_NEAR(ritz.last_component, last, 1e-9) << n;
  }
}

} // namespace
} // namespace platen::lanczos_test
