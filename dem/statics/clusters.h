// Clusters of neighbouring rows of a network's stiffness, which move rigidly.
#pragma once

#include <vector>

#include "base/vector3.h"
#include "dem/statics/block_product.h"

namespace platen::dem::statics {

template <int n>
class Clusters {
public:
  Clusters() = default;
  // A cluster is a row and all its neighbours if none of them is in a cluster yet; each remaining row joins a
  // neighbour's cluster. Fixed rows, and rows without a stiffness, are in none.
  Clusters(const BlockMatrix<n, double> &matrix, const std::vector<Vector3> &place,
           const std::vector<double> &length, const std::vector<char> &fixed);

  std::size_t size() const { return place_.size(); }
  const std::vector<Vector3> &place() const { return place_; }                  // m, mean of the members'
  const std::vector<double> &length() const { return length_; }                 // m, factor on rotations
  BlockMatrix<n, double> stiffness(const BlockMatrix<n, double> &matrix) const; // of the rigid clusters

  void gather(const std::vector<float> &forces, std::vector<float> &of_clusters) const;
  // Motions of the members by those of the clusters, times a factor; 0 for rows in no cluster.
  void spread(const std::vector<float> &of_clusters, float factor, std::vector<float> &motions) const;

private:
  // A member moves by u = U + W x arm and w = ratio W, where rotations are multiplied by lengths.
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
