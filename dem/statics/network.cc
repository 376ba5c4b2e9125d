#include "dem/statics/network.h"

#include "dem/eigen.h"

namespace platen::dem::statics {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix36 = Eigen::Matrix<double, 3, 6>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix3 skew(const Vector3 &a) {
  Matrix3 m;
  m << 0, -a.z, a.y, a.z, 0, -a.x, -a.y, a.x, 0;
  return m;
}
// Stiffness `along` n, and `across` it.
Matrix3 spring(const Vector3 &n, double along, double across) {
  return across * Matrix3::Identity() + (along - across) * eigen(n) * eigen(n).transpose();
}
// Displacement of a point, `arm` from a particle's centre, by its displacement and rotation times radius.
Matrix36 moves(double radius, const Vector3 &arm) {
  Matrix36 m;
  m << Matrix3::Identity(), (-1 / radius) * skew(arm);
  return m;
}

template <int n>
Eigen::Map<Eigen::Matrix<double, n, n>> block_at(double *to) {
  return Eigen::Map<Eigen::Matrix<double, n, n>>(to);
}

// Stiffness of one bond for the unknowns of its particles; n x n by columns. K_ji is the transpose of K_ij.
template <int n>
struct BondBlocks {
  double ii[n * n], ij[n * n], jj[n * n];
};

template <int n>
BondBlocks<n> blocks_of(const Particles &p, const Bonds &b, std::size_t row, const BondStiffness &s) {
  BondBlocks<n> blocks{};
  if (s.axial == 0) return blocks;
  const int i = b.first[row], j = b.second[row];
  const Vector3 d = p.position[j] - p.position[i], along = d / norm(d);
  const Matrix3 force = spring(along, s.axial, s.shear);
  if constexpr (n == 3) {
    block_at<3>(blocks.ii) = block_at<3>(blocks.jj) = force;
    block_at<3>(blocks.ij) = -force;
  } else {
    const double ri = p.radius[i], rj = p.radius[j];
    const Matrix3 moment = spring(along, s.twisting, s.bending);
    const Matrix36 move_i = moves(ri, b.lever[row] * d), move_j = moves(rj, (b.lever[row] - 1) * d);
    const Matrix36 force_i = force * move_i, force_j = force * move_j;
    block_at<6>(blocks.ii).noalias() = move_i.transpose() * force_i;
    block_at<6>(blocks.jj).noalias() = move_j.transpose() * force_j;
    block_at<6>(blocks.ij).noalias() = -(move_i.transpose() * force_j);
    block_at<6>(blocks.ii).template bottomRightCorner<3, 3>() += moment / (ri * ri);
    block_at<6>(blocks.jj).template bottomRightCorner<3, 3>() += moment / (rj * rj);
    block_at<6>(blocks.ij).template bottomRightCorner<3, 3>() -= moment / (ri * rj);
  }
  return blocks;
}

} // namespace

std::vector<BondStiffness> at_rest(const Bonds &bonds) {
  std::vector<BondStiffness> rows(bonds.size());
  for (std::size_t k = 0; k < bonds.size(); ++k)
    rows[k] = bonds.stiffness(k);
  return rows;
}

template <int n>
BlockMatrix<n, double> assemble(const Particles &p, const Bonds &bonds,
                                const std::vector<BondStiffness> &of_rows) {
  const std::size_t particles = p.size();
  // Blocks of each particle: its bonds as second particle, itself, its bonds as first; in the order of bonds.
  BlockMatrix<n, double> a;
  std::vector<std::size_t> as_second(particles, 0), as_first(particles, 0);
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    ++as_first[bonds.first[k]];
    ++as_second[bonds.second[k]];
  }
  a.begin.reserve(particles + 1);
  for (std::size_t i = 0; i < particles; ++i)
    a.begin.push_back(a.begin.back() + as_second[i] + 1 + as_first[i]);
  a.column.resize(a.begin.back());
  std::vector<int> bond(a.begin.back(), -1); // of each block; -1: the diagonal
  std::vector<std::size_t> below(particles), above(particles);
  for (std::size_t i = 0; i < particles; ++i) {
    below[i] = a.begin[i];
    above[i] = a.begin[i] + as_second[i];
    a.column[above[i]++] = static_cast<int>(i);
  }
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    const int i = bonds.first[k], j = bonds.second[k];
    bond[above[i]] = bond[below[j]] = static_cast<int>(k);
    a.column[above[i]++] = j;
    a.column[below[j]++] = i;
  }
  // A bond is computed for both of its rows, so that no row waits for another.
  a.block.assign(a.begin.back() * n * n, 0.0);
  for_each(
      particles,
      [&](std::size_t row) {
        double *diagonal = a.at(a.begin[row] + as_second[row]);
        for (std::size_t k = a.begin[row]; k < a.begin[row + 1]; ++k) {
          if (bond[k] < 0) continue;
          const BondBlocks<n> b = blocks_of<n>(p, bonds, bond[k], of_rows[bond[k]]);
          const bool first = static_cast<std::size_t>(bonds.first[bond[k]]) == row;
          double *to = a.at(k);
          for (int c = 0; c < n; ++c)
            for (int r = 0; r < n; ++r) {
              to[n * c + r] = first ? b.ij[n * c + r] : b.ij[n * r + c];
              diagonal[n * c + r] += first ? b.ii[n * c + r] : b.jj[n * c + r];
            }
        }
      },
      rows_per_part);
  return a;
}

template <int n>
void add_support(const Particles &p, const GroundSpring &s, double *block) {
  const double radius = p.radius[s.particle];
  const Matrix3 force = spring(s.normal, s.normal_stiffness, s.tangential_stiffness);
  if constexpr (n == 3) {
    block_at<3>(block) += force;
  } else {
    const Matrix36 move = moves(radius, s.arm);
    block_at<6>(block) += move.transpose() * force * move;
    block_at<6>(block).template bottomRightCorner<3, 3>() +=
        s.rotational_stiffness / (radius * radius) * Matrix3::Identity();
  }
}

template <int n>
void add_support_load(const Particles &p, const GroundSpring &s, const Vector3 &moved, double *load) {
  const double radius = p.radius[s.particle];
  const Matrix3 force = spring(s.normal, s.normal_stiffness, s.tangential_stiffness);
  Eigen::Map<Eigen::Matrix<double, n, 1>>(load, n) +=
      (moves(radius, s.arm).transpose() * force * eigen(moved)).template head<n>();
}

template BlockMatrix<3, double> assemble<3>(const Particles &, const Bonds &,
                                            const std::vector<BondStiffness> &);
template BlockMatrix<6, double> assemble<6>(const Particles &, const Bonds &,
                                            const std::vector<BondStiffness> &);
template void add_support<3>(const Particles &, const GroundSpring &, double *);
template void add_support<6>(const Particles &, const GroundSpring &, double *);
template void add_support_load<3>(const Particles &, const GroundSpring &, const Vector3 &, double *);
template void add_support_load<6>(const Particles &, const GroundSpring &, const Vector3 &, double *);

} // namespace platen::dem::statics
