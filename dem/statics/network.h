// The stiffness of a bonded network, in displacements (m) and, where particles turn, rotations times the
// radius.
#pragma once

#include <vector>

#include "dem/bonds.h"
#include "dem/particles.h"
#include "dem/stable_step.h"
#include "dem/statics/block_rows.h"

namespace platen::dem::statics {

// Of one bond, between the unknowns of its two particles; n x n by columns. K_ji is the transpose of K_ij.
template <int n>
struct BondBlocks {
  double ii[n * n], ij[n * n], jj[n * n];
};

// In its present direction, without the forces that are in it.
template <int n>
BondBlocks<n> material_stiffness(const Particles &particles, const Bonds &bonds, std::size_t row);

// Of all bonds; blocks(row) gives those of a bond. Every row has its diagonal block.
template <int n, class Blocks>
BlockRows<n, double> assemble(std::size_t particles, const Bonds &bonds, const Blocks &blocks);

// Of a spring to a body; n x n by columns.
template <int n>
void add_support(const Particles &particles, const GroundSpring &spring, double *block);
// The forces (torques over the radius) that the body's displacement brings to the particle.
template <int n>
void add_support_load(const Particles &particles, const GroundSpring &spring, const Vector3 &moved,
                      double *load);

template <int n, class Blocks>
BlockRows<n, double> assemble(std::size_t particles, const Bonds &bonds, const Blocks &blocks) {
  // Of each particle: its bonds as second particle, itself, its bonds as first; in the order of bonds.
  BlockRows<n, double> a;
  std::vector<std::size_t> as_second(particles, 0), as_first(particles, 0);
  for (std::size_t k = 0; k < bonds.size(); ++k) {
    ++as_first[static_cast<std::size_t>(bonds.first[k])];
    ++as_second[static_cast<std::size_t>(bonds.second[k])];
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
    const std::size_t i = static_cast<std::size_t>(bonds.first[k]),
                      j = static_cast<std::size_t>(bonds.second[k]);
    bond[above[i]] = bond[below[j]] = static_cast<int>(k);
    a.column[above[i]++] = static_cast<int>(j);
    a.column[below[j]++] = static_cast<int>(i);
  }
  // A bond is worked out for both of its rows, so that no row waits for another.
  a.block.assign(a.begin.back() * n * n, 0.0);
  for_each(
      particles,
      [&](std::size_t row) {
        double *diagonal = a.at(a.begin[row] + as_second[row]);
        for (std::size_t k = a.begin[row]; k < a.begin[row + 1]; ++k) {
          if (bond[k] < 0) continue;
          const BondBlocks<n> b = blocks(static_cast<std::size_t>(bond[k]));
          const bool first = static_cast<std::size_t>(bonds.first[static_cast<std::size_t>(bond[k])]) == row;
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

} // namespace platen::dem::statics
