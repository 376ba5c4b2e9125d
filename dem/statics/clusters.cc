#include "dem/statics/clusters.h"

#include <algorithm>
#include <cmath>

namespace platen::dem::statics {

template <int n>
Clusters<n>::Clusters(const BlockMatrix<n, double> &a, const std::vector<Vector3> &place,
                      const std::vector<double> &length, const std::vector<char> &fixed) {
  join(a, fixed);
  const std::size_t rows = a.rows(), count = begin_.size() - 1;
  place_.resize(count);
  length_.resize(count);
  carry_.resize(rows);
  for (std::size_t c = 0; c < count; ++c) {
    Vector3 mean;
    double each = 0;
    const double members = static_cast<double>(begin_[c + 1] - begin_[c]);
    for (std::size_t k = begin_[c]; k < begin_[c + 1]; ++k) {
      mean += (1 / members) * place[member_[k]];
      each += length[member_[k]] / members;
    }
    place_[c] = mean;
    length_[c] = each * std::cbrt(members);
    for (std::size_t k = begin_[c]; k < begin_[c + 1]; ++k) {
      const std::size_t i = static_cast<std::size_t>(member_[k]);
      const Vector3 arm = (1 / length_[c]) * (place[i] - mean);
      carry_[i] = {{arm.x, arm.y, arm.z}, length[i] / length_[c]};
    }
  }
}

template <int n>
void Clusters<n>::join(const BlockMatrix<n, double> &a, const std::vector<char> &fixed) {
  const std::size_t rows = a.rows();
  cluster_.assign(rows, -1);
  int count = 0;
  const auto free = [&](std::size_t i) { return !fixed[i]; };
  for (std::size_t i = 0; i < rows; ++i) {
    if (!free(i) || cluster_[i] >= 0) continue;
    bool alone = true;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1] && alone; ++k)
      alone = cluster_[a.column[k]] < 0;
    if (!alone) continue;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k)
      if (free(static_cast<std::size_t>(a.column[k]))) cluster_[a.column[k]] = count;
    ++count;
  }
  // Each remaining row joins the cluster of its stiffest neighbour that is in one.
  const std::vector<int> before = cluster_;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!free(i) || before[i] >= 0) continue;
    double stiffest = -1;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k) {
      const int c = before[a.column[k]];
      double size = 0;
      for (int e = 0; e < n * n; ++e)
        size += a.at(k)[e] * a.at(k)[e];
      if (c >= 0 && size > stiffest) stiffest = size, cluster_[i] = c;
    }
    if (cluster_[i] < 0) cluster_[i] = count++;
  }
  begin_.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const int c : cluster_)
    if (c >= 0) ++begin_[static_cast<std::size_t>(c) + 1];
  for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c)
    begin_[c + 1] += begin_[c];
  member_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < rows; ++i)
    if (cluster_[i] >= 0) member_[next[cluster_[i]]++] = static_cast<int>(i);
}

// to += carry^T load: a member's force, and with rotation its moment, about the cluster's place.
template <int n>
template <class Real>
void Clusters<n>::add_load(const Carry &carry, const Real *load, double *to) {
  for (int e = 0; e < 3; ++e)
    to[e] += load[e];
  if constexpr (n == 6) {
    const double *t = carry.arm, q = carry.ratio;
    to[3] += q * load[3] + (t[1] * load[2] - t[2] * load[1]);
    to[4] += q * load[4] + (t[2] * load[0] - t[0] * load[2]);
    to[5] += q * load[5] + (t[0] * load[1] - t[1] * load[0]);
  }
}

// to += carry_row^T block carry_column.
template <int n>
void Clusters<n>::add_carried(const double *block, const Carry &row, const Carry &column, double *to) const {
  if constexpr (n == 3) {
    for (int e = 0; e < 9; ++e)
      to[e] += block[e];
  } else {
    // W x arm has the columns e_x x arm, ...: the third column of three is a cross product again.
    double half[36];
    const double *s = column.arm;
    for (int r = 0; r < 6; ++r) {
      const double a = block[r], b = block[6 + r], c = block[12 + r];
      half[r] = a, half[6 + r] = b, half[12 + r] = c;
      half[18 + r] = column.ratio * block[18 + r] + (c * s[1] - b * s[2]);
      half[24 + r] = column.ratio * block[24 + r] + (a * s[2] - c * s[0]);
      half[30 + r] = column.ratio * block[30 + r] + (b * s[0] - a * s[1]);
    }
    for (int c = 0; c < 6; ++c)
      add_load(row, half + 6 * c, to + 6 * c);
  }
}

template <int n>
BlockMatrix<n, double> Clusters<n>::stiffness(const BlockMatrix<n, double> &a) const {
  BlockMatrix<n, double> b;
  std::vector<std::vector<int>> columns(size());
  const auto for_each_entry = [&](std::size_t c, const auto &body) {
    for (std::size_t m = begin_[c]; m < begin_[c + 1]; ++m) {
      const std::size_t i = static_cast<std::size_t>(member_[m]);
      for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k) {
        const std::size_t j = static_cast<std::size_t>(a.column[k]);
        if (cluster_[j] >= 0) body(i, j, k, cluster_[j]);
      }
    }
  };
  for_each(
      size(),
      [&](std::size_t c) {
        std::vector<int> &row = columns[c];
        for_each_entry(c, [&](std::size_t, std::size_t, std::size_t, int other) { row.push_back(other); });
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
      },
      rows_per_part);
  for (const std::vector<int> &row : columns) {
    b.column.insert(b.column.end(), row.begin(), row.end());
    b.begin.push_back(b.column.size());
  }
  b.block.assign(b.column.size() * n * n, 0.0);
  for_each(
      size(),
      [&](std::size_t c) {
        const int *all = b.column.data(), *first = all + b.begin[c], *last = all + b.begin[c + 1];
        for_each_entry(c, [&](std::size_t i, std::size_t j, std::size_t k, int other) {
          const std::size_t to = std::lower_bound(first, last, other) - all;
          add_carried(a.at(k), carry_[i], carry_[j], b.at(to));
        });
      },
      rows_per_part);
  return b;
}

template <int n>
void Clusters<n>::gather(const std::vector<float> &forces, std::vector<float> &of_clusters) const {
  for_each(
      size(),
      [&](std::size_t c) {
        double sum[n] = {};
        for (std::size_t k = begin_[c]; k < begin_[c + 1]; ++k) {
          const std::size_t i = static_cast<std::size_t>(member_[k]);
          const float *f = forces.data() + n * i;
          add_load(carry_[i], f, sum);
        }
        for (std::size_t e = 0; e < n; ++e)
          of_clusters[n * c + e] = static_cast<float>(sum[e]);
      },
      rows_per_part);
}

template <int n>
void Clusters<n>::spread(const std::vector<float> &of_clusters, float factor,
                         std::vector<float> &motions) const {
  for_each(cluster_.size(), [&](std::size_t i) {
    float *u = motions.data() + n * i;
    if (cluster_[i] < 0) {
      std::fill(u, u + n, 0.0f);
      return;
    }
    const float *v = of_clusters.data() + n * static_cast<std::size_t>(cluster_[i]);
    for (int e = 0; e < 3; ++e)
      u[e] = factor * v[e];
    if constexpr (n == 6) {
      const double *s = carry_[i].arm;
      u[0] += factor * static_cast<float>(v[4] * s[2] - v[5] * s[1]);
      u[1] += factor * static_cast<float>(v[5] * s[0] - v[3] * s[2]);
      u[2] += factor * static_cast<float>(v[3] * s[1] - v[4] * s[0]);
      for (int e = 3; e < 6; ++e)
        u[e] = factor * static_cast<float>(carry_[i].ratio * v[e]);
    }
  });
}

template class Clusters<3>;
template class Clusters<6>;

} // namespace platen::dem::statics
