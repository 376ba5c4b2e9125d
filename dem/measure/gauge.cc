#include "dem/measure/gauge.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dem/eigen.h"

namespace platen::dem {
namespace {

// Mean displacement along an axis, m; NaN without rows.
double mean_motion(const Particles &p, const std::vector<int> &rows, int axis) {
  double sum = 0;
  for (const int i : rows)
    sum += p.position[i][axis] - p.reference_position[i][axis];
  return sum / static_cast<double>(rows.size());
}

// Rows of the lowest and the highest reference centre along an axis that count; -1 if none counts.
template <class Counts>
std::array<int, 2> outermost(const Particles &p, int axis, const Counts &counts) {
  std::array<int, 2> ends{-1, -1};
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (!counts(i, x)) continue;
    if (ends[0] < 0 || x[axis] < p.reference_position[ends[0]][axis]) ends[0] = static_cast<int>(i);
    if (ends[1] < 0 || x[axis] > p.reference_position[ends[1]][axis]) ends[1] = static_cast<int>(i);
  }
  return ends;
}

} // namespace

std::vector<char> ever_bonded(const Particles &p, const Bonds *bonds) {
  if (bonds == nullptr || bonds->initial_count() == 0) return std::vector<char>(p.size(), 1);
  std::vector<char> bonded(p.size(), 0);
  for (std::size_t k = 0; k < bonds->initial_count(); ++k)
    bonded[bonds->record_first[k]] = bonded[bonds->record_second[k]] = 1;
  return bonded;
}

Gauge::Gauge(const Particles &p, const Shape &shape, const Bonds *bonds) {
  const std::vector<char> bonded = ever_bonded(p, bonds);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (bonded[i] && std::abs(p.reference_position[i].z - 0.5 * shape.height) < 0.25 * shape.height)
      rows_.push_back(static_cast<int>(i));
  for (const int i : rows_)
    centre_ += p.reference_position[i];
  if (!rows_.empty()) centre_ *= 1.0 / static_cast<double>(rows_.size());
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const int i : rows_) {
    const Eigen::Vector3d v = eigen(p.reference_position[i] - centre_);
    moments += v * v.transpose();
  }
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(moments);
  if (rows_.size() < 4 || !lu.isInvertible()) {
    rows_.clear(); // too few particles for a strain
    return;
  }
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(inverse_.data()) = lu.inverse();
}

GaugeStrain Gauge::strain(const Particles &p) const {
  return fit(p, [&](int i) { return p.position[i] - p.reference_position[i]; });
}

GaugeStrain Gauge::strain_of(const Particles &p, const std::vector<Vector3> &displacement) const {
  return fit(p, [&](int i) { return displacement[i]; });
}

template <class Displacement>
GaugeStrain Gauge::fit(const Particles &p, const Displacement &displacement) const {
  if (rows_.empty()) return {std::nan(""), std::nan(""), std::nan("")};
  // Row k of `sum`: sum over particles of u_k (X - X_centre); gradient = sum inverse.
  Vector3 sum[3];
  for (const int i : rows_) {
    const Vector3 x = p.reference_position[i] - centre_, u = displacement(i);
    for (int k = 0; k < 3; ++k)
      sum[k] += u[k] * x;
  }
  const auto gradient = [&](int k) {
    return sum[k].x * inverse_[k] + sum[k].y * inverse_[3 + k] + sum[k].z * inverse_[6 + k];
  };
  return {gradient(2), gradient(0), gradient(1)};
}

ExtremalPairs::ExtremalPairs(const Particles &p, const Shape &shape, const Bonds *bonds) {
  const std::vector<char> bonded = ever_bonded(p, bonds);
  double mean = 0;
  for (const double r : p.radius)
    mean += r / static_cast<double>(p.size());
  for (int section = 1; section <= 3; ++section) {
    const double z = 0.25 * section * shape.height;
    for (int axis = 0; axis < 2; ++axis) {
      // A slab two spheres thick, near the diameter, as in figure 22 of the thesis.
      const std::array<int, 2> ends = outermost(p, axis, [&](std::size_t i, const Vector3 &x) {
        return bonded[i] && std::abs(x.z - z) <= 2 * mean && std::abs(x[1 - axis]) <= 2 * mean;
      });
      if (ends[0] >= 0 && ends[1] != ends[0]) across_.push_back(ends);
    }
  }
  along_ = outermost(p, 2, [&](std::size_t i, const Vector3 &x) {
    return bonded[i] && x.x * x.x + x.y * x.y <= 9 * mean * mean;
  });
}

double ExtremalPairs::lateral(const Particles &p) const {
  if (across_.empty()) return std::nan("");
  double now = 0, before = 0;
  for (const auto &pair : across_) {
    now += norm(p.position[pair[1]] - p.position[pair[0]]);
    before += norm(p.reference_position[pair[1]] - p.reference_position[pair[0]]);
  }
  return now / before - 1;
}

double ExtremalPairs::axial(const Particles &p) const {
  if (along_[0] < 0 || along_[0] == along_[1]) return std::nan("");
  return (p.position[along_[1]].z - p.position[along_[0]].z) /
             (p.reference_position[along_[1]].z - p.reference_position[along_[0]].z) -
         1;
}

DiscOpening::DiscOpening(const Particles &p, const Shape &shape) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (std::abs(x.z - 0.5 * shape.height) > 0.25 * shape.radius) continue;
    if (x.x > 0.7 * shape.radius) right_.push_back(static_cast<int>(i));
    if (x.x < -0.7 * shape.radius) left_.push_back(static_cast<int>(i));
  }
}

double DiscOpening::operator()(const Particles &p) const {
  return mean_motion(p, right_, 0) - mean_motion(p, left_, 0);
}

Deflection::Deflection(const Particles &p, const Shape &shape, double span) {
  const double half = std::max(shape.height / 8, 2 * mean_radius(p));
  const double beyond = std::min(half, 0.5 * (shape.width_x - span));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (std::abs(x.z - 0.5 * shape.height) > half) continue;
    if (std::abs(x.x) <= half) middle_.push_back(static_cast<int>(i));
    if (std::abs(x.x + 0.5 * span) <= beyond) left_.push_back(static_cast<int>(i));
    if (std::abs(x.x - 0.5 * span) <= beyond) right_.push_back(static_cast<int>(i));
  }
  if (left_.empty() || middle_.empty() || right_.empty())
    throw std::invalid_argument("no sphere lies at half the depth above a support or at mid-span");
}

double Deflection::operator()(const Particles &p) const {
  return 0.5 * (mean_motion(p, left_, 2) + mean_motion(p, right_, 2)) - mean_motion(p, middle_, 2);
}

MouthOpening::MouthOpening(const Particles &p, const Notch &notch, const Bonds *bonds) {
  const std::vector<char> bonded = ever_bonded(p, bonds);
  const double near = 2 * mean_radius(p);
  if (notch.depth < near) throw std::invalid_argument("the notch is shallower than a sphere");
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector3 &x = p.reference_position[i];
    if (!bonded[i] || x.z > near || std::abs(x.x) > 0.5 * notch.width + near) continue;
    (x.x < 0 ? left_ : right_).push_back(static_cast<int>(i));
  }
  if (left_.empty() || right_.empty())
    throw std::invalid_argument("no sphere lies beside the mouth of the notch");
}

double MouthOpening::operator()(const Particles &p) const {
  return mean_motion(p, right_, 0) - mean_motion(p, left_, 0);
}

std::vector<int> MouthOpening::rows() const {
  std::vector<int> all(left_.size() + right_.size());
  std::merge(left_.begin(), left_.end(), right_.begin(), right_.end(), all.begin());
  return all;
}

} // namespace platen::dem
