// Equilibrium of a HyperelasticSolid, for tests: Newton's method with the solid's own tangent, full steps, on
// meshes of some hundred nodes.
#pragma once

#include <Eigen/SparseLU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "fem/hyperelastic_solid.h"
#include "tests/fem/tangent.h"

namespace platen::fem {

class Newton {
public:
  explicit Newton(HyperelasticSolid &solid)
      : solid_(solid), prescribed_(solid.mesh().nodes.size()), goal_(solid.displacement()) {}

  // As the solid's prescribe(); the nodes stay where they are until they are placed.
  int prescribe(const std::vector<int> &nodes, const std::array<bool, 3> &components) {
    for (const int n : nodes)
      for (std::size_t k = 0; k < 3; ++k)
        if (components[k]) prescribed_[index(n)][k] = true;
    return solid_.prescribe(nodes, components);
  }
  void place(const std::vector<int> &nodes,
             const Vector3 &displacement) { // m, of their prescribed components
    for (const int n : nodes)
      goal_[index(n)] = displacement;
  }

  // Goes to where pressures, contact loads and prescribed motions are in balance, in full steps. Returns what
  // was out of balance before each step and after the last, over the forces in the solid. Throws
  // std::runtime_error where that does not get below the tolerance, InvertedElement where a step is too long.
  std::vector<double> solve(double tolerance = 1e-10) {
    constexpr int most_steps = 25;
    std::vector<double> residuals;
    double size = 0; // N, the largest that the forces were: those of an unloaded solid are round-off
    for (int k = 0; k <= most_steps; ++k) {
      solid_.update_forces();
      const std::vector<Vector3> balance = out_of_balance();
      size = std::max({size, root(solid_.internal_forces()), root(solid_.pressure_forces()), root(balance)});
      residuals.push_back(size > 0 ? root(balance) / size : 0);
      const std::vector<Vector3> way = prescribed_displacements();
      if (residuals.back() <= tolerance && root(way) == 0) return residuals;
      step(balance, way);
    }
    throw std::runtime_error("Newton's method does not get to an equilibrium");
  }

private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  static double product(const std::vector<Vector3> &a, const std::vector<Vector3> &b) {
    double sum = 0;
    for (std::size_t n = 0; n < a.size(); ++n)
      sum += dot(a[n], b[n]);
    return sum;
  }
  static double root(const std::vector<Vector3> &a) { return std::sqrt(product(a, a)); }
  static void add(std::vector<Vector3> &to, double factor, const std::vector<Vector3> &what) {
    for (std::size_t n = 0; n < to.size(); ++n)
      to[n] = to[n] + factor * what[n];
  }
  void keep(std::vector<Vector3> &field,
            bool prescribed) const { // zero where nodes are prescribed, or where they are not
    for (std::size_t n = 0; n < field.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        if (prescribed_[n][k] != prescribed) field[n][k] = 0;
  }

  std::vector<Vector3> out_of_balance() const {
    std::vector<Vector3> balance = solid_.pressure_forces();
    add(balance, -1, solid_.internal_forces());
    const std::vector<Vector3> loads = solid_.contact_loads();
    for (std::size_t v = 0; v < loads.size(); ++v) {
      Vector3 &sum = balance[index(solid_.surface_node(static_cast<int>(v)))];
      sum = sum + loads[v];
    }
    keep(balance, false);
    return balance;
  }
  std::vector<Vector3> prescribed_displacements() const {
    std::vector<Vector3> way = goal_;
    add(way, -1, solid_.displacement());
    keep(way, true);
    return way;
  }

  // Rows of prescribed components say where these go, at once.
  void step(const std::vector<Vector3> &balance, const std::vector<Vector3> &way) {
    const auto is_prescribed = [&](Eigen::Index m) {
      return prescribed_[static_cast<std::size_t>(m / 3)][static_cast<std::size_t>(m % 3)];
    };
    Tangent tangent = tangent_of(solid_);
    tangent.prune([&](Eigen::Index row, Eigen::Index, double) { return !is_prescribed(row); });
    for (Eigen::Index m = 0; m < tangent.rows(); ++m)
      if (is_prescribed(m)) tangent.coeffRef(m, m) = 1;
    tangent.makeCompressed();
    const Eigen::SparseLU<Tangent> factors(tangent);
    const Eigen::VectorXd move = factors.solve(as_column(balance) + as_column(way));
    std::vector<Vector3> place = solid_.displacement();
    for (std::size_t n = 0; n < place.size(); ++n)
      for (std::size_t k = 0; k < 3; ++k)
        place[n][k] =
            prescribed_[n][k] ? goal_[n][k] : place[n][k] + move[static_cast<Eigen::Index>(3 * n + k)];
    solid_.set_displacement(place);
  }

  HyperelasticSolid &solid_;
  std::vector<std::array<bool, 3>> prescribed_;
  std::vector<Vector3> goal_; // m
};

} // namespace platen::fem
