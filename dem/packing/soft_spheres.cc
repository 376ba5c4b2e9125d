#include "dem/packing/soft_spheres.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "dem/cell_grid.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {

namespace {

constexpr double skin = 0.2; // in mean radii; pairs are listed up to this gap
// FIRE, as published except for the largest step: 2 / w_max is about .55 for spheres with 6 to 12 contacts.
constexpr double tiny = 1e-300; // keeps the direction of two coincident spheres finite (zero)
constexpr double first_step = 0.1, largest_step = 0.45, smallest_step = 0.002;
constexpr double step_growth = 1.1, step_cut = 0.5, first_mixing = 0.1, mixing_decay = 0.99;
constexpr int steps_before_growth = 5;

} // namespace

SoftSpheres::SoftSpheres(const Shape &shape, std::vector<Vector3> centre, std::vector<double> factor)
    : shape_(shape), centre_(std::move(centre)), factor_(std::move(factor)) {
  largest_factor_ = factor_.empty() ? 1.0 : *std::max_element(factor_.begin(), factor_.end());
  sort_in_space();
  radius_ = factor_;
  press_.resize(centre_.size());
  velocity_.resize(centre_.size());
}

// Neighbours in space become neighbours in memory; they stay so, since spheres move by a few radii at most.
void SoftSpheres::sort_in_space() {
  const BoundingBox bounds = bounding_box(shape_);
  const PointGrid grid(bounds.low, bounds.high, 3.0 * largest_factor_);
  std::vector<std::pair<std::size_t, std::size_t>> key(centre_.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    key[i] = {grid.cell_of(centre_[i]), i};
  std::sort(key.begin(), key.end());
  std::vector<Vector3> centre(centre_.size());
  std::vector<double> factor(factor_.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    centre[i] = centre_[key[i].second], factor[i] = factor_[key[i].second];
  centre_.swap(centre), factor_.swap(factor);
}

void SoftSpheres::set_scale(double scale) {
  scale_ = scale;
  for (std::size_t i = 0; i < radius_.size(); ++i)
    radius_[i] = scale * factor_[i];
}

bool SoftSpheres::pairs_are_stale() const {
  if (centre_at_build_.size() != centre_.size()) return true;
  // A pair off the list becomes a contact only after both ends have moved, or grown, through the skin
  // together.
  const double growth = std::max(0.0, scale_ - scale_at_build_) * largest_factor_;
  const double allowed = 0.5 * skin - growth;
  if (allowed <= 0) return true;
  const double limit = allowed * allowed;
  for (std::size_t i = 0; i < centre_.size(); ++i)
    if (norm_squared(centre_[i] - centre_at_build_[i]) > limit) return true;
  return false;
}

void SoftSpheres::build_pairs() {
  first_.assign(centre_.size() + 1, 0);
  partner_.clear();
  for (const IndexPair &pair : near_pairs(centre_.data(), radius_.data(), centre_.size(), skin)) {
    ++first_[pair.first + 1];
    partner_.push_back(pair.second);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  centre_at_build_ = centre_;
  scale_at_build_ = scale_;
}

void SoftSpheres::touch(double overlap) {
  ++now_.contacts;
  now_.mean += overlap; // the sum, divided at the end of compute_forces()
  now_.max = std::max(now_.max, overlap);
}

// Force along an axis on a sphere of radius r at x between walls at -half and half, both of which it may
// touch.
double SoftSpheres::squeeze(double x, double r, double half) {
  const double right = x + r - half, left = r - half - x;
  double force = 0;
  if (right > 0) force -= right, touch(right);
  if (left > 0) force += left, touch(left);
  return force;
}

void SoftSpheres::add_wall_forces() {
  const double half_height = 0.5 * shape_.height;
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    const Vector3 &c = centre_[i];
    const double r = radius_[i];
    force_[i].z += squeeze(c.z - half_height, r, half_height);
    if (shape_.kind == ShapeKind::box) {
      force_[i].x += squeeze(c.x, r, 0.5 * shape_.width_x);
      force_[i].y += squeeze(c.y, r, 0.5 * shape_.width_y);
      continue;
    }
    const double across = c.x * c.x + c.y * c.y, inner = shape_.radius - r;
    if (inner > 0 && across <= inner * inner) continue;
    const double distance = std::sqrt(across), force = squeeze(distance, r, shape_.radius);
    if (distance > 0) force_[i].x += force * c.x / distance, force_[i].y += force * c.y / distance;
  }
}

void SoftSpheres::compute_forces() {
  if (pairs_are_stale()) build_pairs();
  force_ = press_;
  now_ = Overlaps{};
  std::size_t contacts = 0;
  double total = 0, largest = 0;
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    const Vector3 c = centre_[i];
    const double r = radius_[i];
    Vector3 sum;
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(partner_[k]);
      const Vector3 d = centre_[j] - c;
      const double touching = r + radius_[j], square = norm_squared(d);
      // No branch: whether a listed pair touches is a coin toss, and a wrong guess costs more than the root.
      const double distance = std::sqrt(square), overlap = std::max(0.0, touching - distance);
      const Vector3 f = (overlap / (distance + tiny)) * d;
      sum -= f;
      force_[j] += f;
      contacts += overlap > 0 ? 1 : 0;
      total += overlap;
      largest = std::max(largest, overlap);
    }
    force_[i] += sum;
  }
  now_.contacts = now_.pairs = contacts;
  now_.mean = total, now_.max = largest; // the sum, divided below
  add_wall_forces();
  double square = 0;
  for (const Vector3 &f : force_)
    square += norm_squared(f);
  if (now_.contacts > 0) now_.mean /= static_cast<double>(now_.contacts);
  now_.residual_force = centre_.empty() ? 0 : std::sqrt(square / static_cast<double>(centre_.size()));
}

Overlaps SoftSpheres::overlaps() {
  compute_forces();
  return now_;
}

std::size_t SoftSpheres::press_loose_spheres(double force, Random &random) {
  compute_forces(); // the list of pairs must be of now
  std::vector<int> contacts(centre_.size());
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    for (int k = first_[i]; k < first_[i + 1]; ++k) {
      const std::size_t j = static_cast<std::size_t>(partner_[k]);
      const double reach = radius_[i] + radius_[j];
      if (norm_squared(centre_[i] - centre_[j]) < reach * reach) ++contacts[i], ++contacts[j];
    }
    if (wall_clearance(shape_, centre_[i]) < radius_[i]) ++contacts[i];
  }
  std::size_t loose = 0;
  for (std::size_t i = 0; i < centre_.size(); ++i) {
    press_[i] = contacts[i] < 4 ? force * random.direction() : Vector3{};
    if (contacts[i] < 4) ++loose;
  }
  return loose;
}

long SoftSpheres::relax(double tolerance, double floor, long max_iterations) {
  std::fill(velocity_.begin(), velocity_.end(), Vector3{});
  double step = first_step, mixing = first_mixing;
  int downhill = 0;
  for (long iteration = 0; iteration < max_iterations; ++iteration) {
    compute_forces();
    if (now_.residual_force <= std::max(tolerance * now_.mean, floor)) return iteration;
    double power = 0;
    for (std::size_t i = 0; i < centre_.size(); ++i)
      power += dot(force_[i], velocity_[i]);
    if (power > 0) {
      if (++downhill > steps_before_growth)
        step = std::min(step * step_growth, largest_step), mixing *= mixing_decay;
    } else {
      for (std::size_t i = 0; i < centre_.size(); ++i)
        centre_[i] -= (0.5 * step) * velocity_[i], velocity_[i] = Vector3{};
      if (iteration > 0) step = std::max(step * step_cut, smallest_step);
      mixing = first_mixing, downhill = 0;
    }
    double speed = 0, push = 0;
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      velocity_[i] += step * force_[i];
      speed += norm_squared(velocity_[i]), push += norm_squared(force_[i]);
    }
    const double along = push > 0 ? mixing * std::sqrt(speed / push) : 0.0;
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      velocity_[i] = (1 - mixing) * velocity_[i] + along * force_[i];
      centre_[i] += step * velocity_[i];
    }
  }
  return max_iterations;
}

} // namespace platen::dem
