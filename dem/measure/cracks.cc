#include "dem/measure/cracks.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/pi.h"
#include "dem/cell_grid.h"
#include "dem/eigen.h"
#include "dem/measure/damage.h"
#include "dem/measure/fragments.h"

namespace platen::dem {
namespace {

constexpr double quarter_turn = pi / 2;

CrackPlane plane_through(const std::vector<int> &members, const std::vector<Vector3> &points) {
  CrackPlane plane;
  plane.bonds = static_cast<double>(members.size());
  for (const int k : members)
    plane.centre += points[k] / static_cast<double>(members.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const int k : members) {
    const Eigen::Vector3d v = eigen(points[k] - plane.centre);
    scatter += v * v.transpose() / static_cast<double>(members.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter); // ascending
  const Eigen::Vector3d lengths = axes.eigenvalues().cwiseMax(0).cwiseSqrt(), n = axes.eigenvectors().col(0);
  plane.normal = {n[0], n[1], n[2]};
  plane.flatness = lengths[1] > 0 ? 1 - lengths[0] / lengths[1] : 0;
  plane.inclination = std::asin(std::min(1.0, std::abs(n[2])));
  plane.extent = std::sqrt(12.0) * lengths[2];
  return plane;
}

// A broken bond is left out if a smaller fraction of the bonds around it is broken: first and next passes.
constexpr std::array<double, 5> least_damage{0, 0.5, 0.6, 0.7, 0.8};

struct Midpoints {
  std::vector<Vector3> at;     // m
  std::vector<IndexPair> near; // of broken bonds
  std::vector<double> damage;  // fraction of broken bonds around each, itself included
};

Midpoints midpoints(const Particles &p, const Bonds &b, double reach) {
  Midpoints m;
  const std::size_t n = b.initial_count();
  m.at.resize(n);
  for (std::size_t k = 0; k < n; ++k)
    m.at[k] = reference_midpoint(p, b, k);
  std::vector<int> all(n, 1), broken(n, 1);
  const std::vector<double> points(n, 0.0);
  for (const IndexPair &pair : near_pairs(m.at.data(), points.data(), n, reach)) {
    const bool one = is_broken(b.state[pair.first]), other = is_broken(b.state[pair.second]);
    ++all[pair.first], ++all[pair.second];
    broken[pair.first] += other, broken[pair.second] += one;
    if (one && other) m.near.push_back(pair);
  }
  m.damage.resize(n);
  for (std::size_t k = 0; k < n; ++k)
    m.damage[k] = static_cast<double>(broken[k]) / all[k];
  return m;
}

} // namespace

void CrackRose::add(const Vector3 &normal, double crack_area) {
  const double angle = std::acos(std::min(1.0, std::abs(normal.z)));
  area[static_cast<std::size_t>(std::min(bins - 1, static_cast<int>(bins * angle / quarter_turn)))] +=
      crack_area;
}

std::array<double, CrackRose::bins> CrackRose::over_isotropic() const {
  const double all = std::accumulate(area.begin(), area.end(), 0.0);
  std::array<double, bins> rose{};
  for (int k = 0; k < bins; ++k) {
    const double directions = std::cos(quarter_turn * k / bins) - std::cos(quarter_turn * (k + 1) / bins);
    rose[k] = all > 0 ? area[k] / all / directions : std::numeric_limits<double>::quiet_NaN();
  }
  return rose;
}

std::vector<CrackPlane> find_crack_planes(const Particles &p, const Bonds &b, const CrackPlaneRules &rules) {
  const std::size_t n = b.initial_count();
  std::vector<CrackPlane> planes;
  if (n == 0) return planes;
  const Midpoints m = midpoints(p, b, rules.reach * mean_radius(p));
  std::vector<char> left(n);
  for (std::size_t k = 0; k < n; ++k)
    left[k] = is_broken(b.state[k]);
  for (const double least : least_damage) {
    DisjointSets sets(n);
    for (std::size_t k = 0; k < n; ++k)
      left[k] = left[k] && m.damage[k] >= least;
    for (const IndexPair &pair : m.near)
      if (left[pair.first] && left[pair.second]) sets.join(pair.first, pair.second);
    for (const std::vector<int> &cluster : sets.all(left)) {
      const bool small = static_cast<int>(cluster.size()) < rules.least_bonds;
      const CrackPlane plane = small ? CrackPlane{} : plane_through(cluster, m.at);
      if (!small && plane.flatness < rules.least_flatness) continue; // checked again
      if (!small) planes.push_back(plane);
      for (const int k : cluster)
        left[k] = 0;
    }
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const CrackPlane &one, const CrackPlane &other) { return one.bonds > other.bonds; });
  return planes;
}

CrackPlanes sum_up(const std::vector<CrackPlane> &planes, const Bonds &b) {
  CrackPlanes s;
  double inside = 0, steep = 0, inclination = 0;
  for (const CrackPlane &plane : planes) {
    inside += plane.bonds;
    inclination += plane.bonds * plane.inclination;
    if (plane.inclination < CrackPlanes::steep) steep += plane.bonds;
  }
  s.count = static_cast<double>(planes.size());
  s.broken = static_cast<double>(std::count_if(b.state.begin(), b.state.end(), is_broken));
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  s.fraction = s.broken > 0 ? inside / s.broken : none;
  s.steep_fraction = s.broken > 0 ? steep / s.broken : none;
  s.mean_inclination = inside > 0 ? inclination / inside : none;
  if (!planes.empty()) s.largest = planes.front();
  return s;
}

void CrackPlanes::describe(Archive &archive) {
  archive.version(1);
  archive("count", count, "1", any_value());
  archive("broken_bonds", broken, "1", any_value());
  archive("share", fraction, "1", any_value());
  archive("steep_share", steep_fraction, "1", any_value());
  archive("mean_inclination", mean_inclination, "rad", any_value());
  archive("largest_bonds", largest.bonds, "1", any_value());
  archive("largest_centre", largest.centre, "m", any_value());
  archive("largest_normal", largest.normal, "1", any_value());
  archive("largest_flatness", largest.flatness, "1", any_value());
  archive("largest_inclination", largest.inclination, "rad", any_value());
  archive("largest_extent", largest.extent, "m", any_value());
}

} // namespace platen::dem
