#include "tests/dem/static_solve.h"

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>

#include "tests/dem/examples.h"

namespace platen::dem::examples {
namespace {

class StaticProblem {
public:
  StaticProblem(Model &model, const std::vector<std::size_t> &clamped, const std::vector<PointLoad> &loads,
                double length)
      : model_(model), loads_(loads), length_(length) {
    for (std::size_t k = 0; k < model.particles.size(); ++k)
      if (std::find(clamped.begin(), clamped.end(), k) == clamped.end()) free_.push_back(k);
  }
  Eigen::Index unknowns() const { return static_cast<Eigen::Index>(6 * free_.size()); }

  // Unbalanced forces, and torques over the length, N.
  Eigen::VectorXd residual() {
    std::vector<BondBreak> breaks;
    Loads sum = kernel_loads(model_.particles, *model_.bonds, model_.settings().instruction_set, breaks);
    for (const PointLoad &load : loads_) {
      sum.force[load.particle] += load.force;
      sum.torque[load.particle] += load.torque;
    }
    Eigen::VectorXd r(unknowns());
    for (std::size_t k = 0; k < free_.size(); ++k)
      for (int c = 0; c < 3; ++c) {
        r[static_cast<Eigen::Index>(6 * k) + c] = sum.force[free_[k]][c];
        r[static_cast<Eigen::Index>(6 * k) + 3 + c] = sum.torque[free_[k]][c] / length_;
      }
    return r;
  }

  // Moves by x: displacements, and rotations times the length, m.
  void move(const Eigen::VectorXd &x) {
    Particles &p = model_.particles;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const Eigen::Index at = static_cast<Eigen::Index>(6 * k);
      p.position[free_[k]] += Vector3{x[at], x[at + 1], x[at + 2]};
      const Vector3 phi = Vector3{x[at + 3], x[at + 4], x[at + 5]} / length_;
      Quaternion &q = (*p.orientation)[free_[k]];
      q = normalised(rotation_quaternion(phi) * q);
    }
  }

  Eigen::MatrixXd tangent() {
    const double h = 1e-6 * length_; // round-off 1e-10 against truncation 1e-12; Newton needs neither
    Eigen::MatrixXd k(unknowns(), unknowns());
    for (Eigen::Index c = 0; c < unknowns(); ++c) {
      Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns());
      x[c] = h;
      move(x);
      k.col(c) = residual();
      move(-2 * x);
      k.col(c) = (k.col(c) - residual()) / (2 * h);
      move(x);
    }
    return k;
  }

private:
  Model &model_;
  const std::vector<PointLoad> &loads_;
  double length_;
  std::vector<std::size_t> free_;
};

} // namespace

void solve_statics(Model &model, const std::vector<std::size_t> &clamped, const std::vector<PointLoad> &loads,
                   double length, double tolerance) {
  StaticProblem problem(model, clamped, loads, length);
  double largest = 0;
  int settled = 0;
  for (const PointLoad &load : loads)
    largest = std::max({largest, norm(load.force), norm(load.torque) / length});
  const Eigen::PartialPivLU<Eigen::MatrixXd> tangent(problem.tangent());
  for (int it = 0; it < 50; ++it) {
    const Eigen::VectorXd r = problem.residual();
    const double now = r.cwiseAbs().maxCoeff();
    if (now <= tolerance * largest && ++settled == 4) return; // round-off is all that is left
    problem.move(-tangent.solve(r));
  }
  throw std::runtime_error("no static equilibrium found");
}

} // namespace platen::dem::examples
