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
      mean += (1 / members) * place[static_cast<std::size_t>(member_[k])];
      each += length[static_cast<std::size_t>(member_[k])] / members;
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
      alone = cluster_[static_cast<std::size_t>(a.column[k])] < 0;
    if (!alone) continue;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k)
      if (free(static_cast<std::size_t>(a.column[k])))
        cluster_[static_cast<std::size_t>(a.column[k])] = count;
    ++count;
  }
  // The rest: to the cluster of the stiffest neighbour that is in one.
  const std::vector<int> before = cluster_;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!free(i) || before[i] >= 0) continue;
    double stiffest = -1;
    for (std::size_t k = a.begin[i]; k < a.begin[i + 1]; ++k) {
      const int c = before[static_cast<std::size_t>(a.column[k])];
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
    if (cluster_[i] >= 0) member_[next[static_cast<std::size_t>(cluster_[i])]++] = static_cast<int>(i);
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
    const double *t = row.arm;
    for (int c = 0; c < 6; ++c) {
      const double *h = half + 6 * c;
      double *o = to + 6 * c;
      o[0] += h[0], o[1] += h[1], o[2] += h[2];
      o[3] += row.ratio * h[3] + (t[1] * h[2] - t[2] * h[1]);
      o[4] += row.ratio * h[4] + (t[2] * h[0] - t[0] * h[2]);
      o[5] += row.ratio * h[5] + (t[0] * h[1] - t[1] * h[0]);
    }
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
        const auto first = b.column.begin() + static_cast<std::ptrdiff_t>(b.begin[c]),
                   last = b.column.begin() + static_cast<std::ptrdiff_t>(b.begin[c + 1]);
        for_each_entry(c, [&](std::size_t i, std::size_t j, std::size_t k, int other) {
          const std::size_t to =
              b.begin[c] + static_cast<std::size_t>(std::lower_bound(first, last, other) - first);
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
          for (int e = 0; e < 3; ++e)
            sum[e] += f[e];
          if constexpr (n == 6) {
            const double *t = carry_[i].arm, q = carry_[i].ratio;
            sum[3] += q * f[3] + (t[1] * f[2] - t[2] * f[1]);
            sum[4] += q * f[4] + (t[2] * f[0] - t[0] * f[2]);
            sum[5] += q * f[5] + (t[0] * f[1] - t[1] * f[0]);
          }
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
