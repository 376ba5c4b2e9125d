// Neighbouring rows of a network's stiffness joined to clusters that move rigidly.
#pragma once

#include <vector>

#include "base/vector3.h"
#include "dem/statics/block_product.h"

namespace platen::dem::statics {

template <int n>
class Clusters {
public:
  Clusters() = default;
  // A row and all its neighbours where none of them is taken yet; what is left joins a neighbour's cluster.
  // Fixed rows, and rows without a stiffness, are in none.
  Clusters(const BlockMatrix<n, double> &matrix, const std::vector<Vector3> &place,
           const std::vector<double> &length, const std::vector<char> &fixed);

  std::size_t size() const { return place_.size(); }
  const std::vector<Vector3> &place() const { return place_; }  // m, mean of the members'
  const std::vector<double> &length() const { return length_; } // m, by which rotations are multiplied
  BlockMatrix<n, double> stiffness(const BlockMatrix<n, double> &matrix) const; // of the rigid clusters

  void gather(const std::vector<float> &forces, std::vector<float> &of_clusters) const;
  // What the clusters' motions, times a factor, are to their members; 0 for rows in none.
  void spread(const std::vector<float> &of_clusters, float factor, std::vector<float> &motions) const;

private:
  // A member moves by u = U + W x arm and w = ratio W, with rotations times lengths.
  struct Carry {
    double arm[3] = {0, 0, 0}, ratio = 1;
  };
  void join(const BlockMatrix<n, double> &matrix, const std::vector<char> &fixed);
  template <class Real>
  static void add_load(const Carry &carry, const Real *load, double *to);
  void add_carried(const double *block, const Carry &row, const Carry &column, double *to) const;

  std::vector<int> cluster_; // of each row, or -1
  std::vector<Carry> carry_;
  std::vector<std::size_t> begin_{0}; // of each cluster's members
  std::vector<int> member_;
  std::vector<Vector3> place_;
  std::vector<double> length_;
};

} // namespace platen::dem::statics
