#include "tests/dem/sparse_equilibrium.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace platen::dem::examples {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Eigen::Index;

Eigen::Vector3d eigen(const Vector3 &a) {
  return {a.x, a.y, a.z};
}
Vector3 vector(const Eigen::Vector3d &a) {
  return {a.x(), a.y(), a.z()};
}
Matrix3 skew(const Vector3 &a) {
  Matrix3 m;
  m << 0, -a.z, a.y, a.z, 0, -a.x, -a.y, a.x, 0;
  return m;
}
// Along n one stiffness, across it another.
Matrix3 spring(const Vector3 &n, double along, double across) {
  return across * Matrix3::Identity() + (along - across) * eigen(n) * eigen(n).transpose();
}

// K x = f in displacements and rotations times the radius, the particles' own or, without rotation,
// displacements alone. What is prescribed is moved to the right hand side; its own rows are those of the unit
// matrix.
class Network {
public:
  Network(const Particles &p, const StaticCase &load) : p_(p), width_(p.has_rotation() ? 6 : 3) {
    prescribed_.assign(p.size(), -1);
    for (std::size_t k = 0; k < load.prescribed.size(); ++k)
      prescribed_[static_cast<std::size_t>(load.prescribed[k].particle)] = static_cast<int>(k);
    prescribed_state_.resize(load.prescribed.size());
    for (std::size_t k = 0; k < load.prescribed.size(); ++k)
      prescribed_state_[k] << eigen(load.prescribed[k].displacement),
          p.radius[static_cast<std::size_t>(load.prescribed[k].particle)] * eigen(load.prescribed[k].turn);
    diagonal_.assign(p.size(), Matrix6::Zero());
    right_ = Eigen::VectorXd::Zero(width_ * static_cast<Index>(p.size()));
    for (std::size_t i = 0; i < p.size(); ++i) {
      if (!load.force.empty()) right_.segment<3>(at(i)) += eigen(load.force[i]);
      if (width_ == 6 && !load.torque.empty())
        right_.segment<3>(at(i) + 3) += eigen(load.torque[i]) / p.radius[i];
    }
  }

  void add(const Bonds &b) {
    entries_.reserve(b.size() * static_cast<std::size_t>(width_ * width_) +
                     p_.size() * static_cast<std::size_t>(width_ * (width_ + 1) / 2));
    for (std::size_t k = 0; k < b.size(); ++k) {
      const BondStiffness s = b.stiffness(k);
      if (s.axial == 0) continue;
      const std::size_t i = static_cast<std::size_t>(b.first[k]), j = static_cast<std::size_t>(b.second[k]);
      const Vector3 d = p_.position[j] - p_.position[i], n = d / norm(d);
      const Matrix3 force = spring(n, s.axial, s.shear), moment = spring(n, s.twisting, s.bending);
      const auto move_i = moves(i, b.lever[k] * d), move_j = moves(j, -(1 - b.lever[k]) * d);
      Matrix6 turn = Matrix6::Zero();
      turn.bottomRightCorner<3, 3>() = moment;
      diagonal_[i] += move_i.transpose() * force * move_i + turn / (p_.radius[i] * p_.radius[i]);
      diagonal_[j] += move_j.transpose() * force * move_j + turn / (p_.radius[j] * p_.radius[j]);
      couple(j, i, -(move_j.transpose() * force * move_i) - turn / (p_.radius[i] * p_.radius[j]));
    }
  }

  void add(const Support &support) {
    const GroundSpring &s = support.spring;
    const std::size_t i = static_cast<std::size_t>(s.particle);
    const Matrix3 force = spring(s.normal, s.normal_stiffness, s.tangential_stiffness);
    const auto move = moves(i, s.arm);
    diagonal_[i] += move.transpose() * force * move;
    diagonal_[i].bottomRightCorner<3, 3>() +=
        s.rotational_stiffness / (p_.radius[i] * p_.radius[i]) * Matrix3::Identity();
    right_.segment(at(i), width_) += (move.transpose() * force * eigen(support.moved)).head(width_);
  }

  StaticState solve(const StaticSettings &settings) {
    finish();
    Eigen::SparseMatrix<double> k(right_.size(), right_.size());
    k.setFromTriplets(entries_.begin(), entries_.end());
    entries_ = {};
    StaticState state;
    state.displacement.resize(p_.size());
    state.turn.resize(p_.size());
    if (right_.squaredNorm() == 0) return state;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower,
                             Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>
        solver;
    solver.setTolerance(settings.tolerance);
    solver.setMaxIterations(settings.most_iterations);
    solver.compute(k);
    const Eigen::VectorXd x = solver.solve(right_);
    state.iterations = static_cast<int>(solver.iterations());
    state.residual = solver.error();
    if (!(state.residual <= settings.tolerance))
      throw NoEquilibrium("the static solve stopped at a residual of " + std::to_string(state.residual) +
                          " of the loads after " + std::to_string(state.iterations) + " iterations");
    for (std::size_t i = 0; i < p_.size(); ++i) {
      state.displacement[i] = vector(x.segment<3>(at(i)));
      if (width_ == 6) state.turn[i] = vector(x.segment<3>(at(i) + 3) / p_.radius[i]);
    }
    return state;
  }

private:
  Index at(std::size_t i) const { return width_ * static_cast<Index>(i); }

  // Of a point of particle i, `arm` from its centre, by its displacement and its rotation times the radius.
  Eigen::Matrix<double, 3, 6> moves(std::size_t i, const Vector3 &arm) const {
    Eigen::Matrix<double, 3, 6> m;
    m << Matrix3::Identity(), (-1 / p_.radius[i]) * skew(arm);
    return m;
  }

  void couple(std::size_t row, std::size_t column, const Matrix6 &block) {
    const int prescribed_row = prescribed_[row], prescribed_column = prescribed_[column];
    if (prescribed_row >= 0 && prescribed_column >= 0) return;
    if (prescribed_column >= 0)
      right_.segment(at(row), width_) -=
          (block * prescribed_state_[static_cast<std::size_t>(prescribed_column)]).head(width_);
    else if (prescribed_row >= 0)
      right_.segment(at(column), width_) -=
          (block.transpose() * prescribed_state_[static_cast<std::size_t>(prescribed_row)]).head(width_);
    else
      for (Index c = 0; c < width_; ++c)
        for (Index r = 0; r < width_; ++r)
          entries_.emplace_back(at(row) + r, at(column) + c, block(r, c));
  }

  // The diagonal blocks. What nothing holds, or what is prescribed, keeps the unit matrix, times a stiffness
  // like others'.
  void finish() {
    double largest = 0;
    for (const Matrix6 &d : diagonal_)
      largest = std::max(largest, d.diagonal().maxCoeff());
    if (largest == 0) largest = 1;
    for (std::size_t i = 0; i < p_.size(); ++i) {
      const bool prescribed = prescribed_[i] >= 0, loose = diagonal_[i].isZero(0);
      if (loose && !prescribed && !right_.segment(at(i), width_).isZero(0))
        throw NoEquilibrium("nothing holds particle " + std::to_string(p_.id[i]) + ", which is loaded");
      if (prescribed || loose) diagonal_[i] = largest * Matrix6::Identity();
      if (prescribed)
        right_.segment(at(i), width_) =
            (largest * prescribed_state_[static_cast<std::size_t>(prescribed_[i])]).head(width_);
      for (Index c = 0; c < width_; ++c)
        for (Index r = c; r < width_; ++r)
          entries_.emplace_back(at(i) + r, at(i) + c, diagonal_[i](r, c));
    }
  }

  const Particles &p_;
  Index width_;
  std::vector<int> prescribed_; // row in prescribed_state_, or -1
  std::vector<Vector6> prescribed_state_;
  std::vector<Matrix6> diagonal_;
  std::vector<Eigen::Triplet<double>> entries_; // lower triangle
  Eigen::VectorXd right_;
};

} // namespace

StaticState solve_sparse(const Particles &particles, const Bonds &bonds, const StaticCase &load,
                         const StaticSettings &settings) {
  Network network(particles, load);
  network.add(bonds);
  for (const Support &support : load.supports)
    network.add(support);
  return network.solve(settings);
}

} // namespace platen::dem::examples
