#include "dem/packing/soft_spheres.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "dem/instruction_set.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {

using kernels::Ball;
using kernels::soft_pack;

namespace {

// In mean radii: how far a sphere may go until partners are looked for again. Most tremble in their places,
// loose ones fly through their cages: each gets what it needs for `wanted_life` iterations, as long as the
// lists stay short (mean_reach). A search costs as much as some ten iterations.
constexpr double first_reach = 0.1, shortest_reach = 0.0125, longest_reach = 0.5, mean_reach = 0.15;
constexpr double wanted_life = 450;
constexpr double spare = 1.5; // reach of the calm ones, over what the mean sphere needs
constexpr double forgotten =
    0.7; // what one search leaves of a reach: a loose sphere may have just turned back
// FIRE, as published except for the largest step: 2 / w_max is about .55 for spheres with 6 to 12 contacts.
constexpr double first_step = 0.1, largest_step = 0.45, smallest_step = 0.002;
constexpr double step_growth = 1.1, step_cut = 0.5, first_mixing = 0.1, mixing_decay = 0.99;
constexpr int steps_before_growth = 5;
// Sums over lanes and blocks are off by round-off; what lies this near a limit is asked of exact sums.
constexpr double relative_doubt = 1e-6, round_off = 1e-15;

constexpr std::size_t packs_of_block = block_rows / soft_pack;
constexpr double tiny = 1e-300;
constexpr double touches_none = -1e300; // a radius

// The kernels for this processor; all give the same places.
struct Kernels {
  kernels::SoftForces add_forces =
      for_set<kernels::SoftForces>(best_instruction_set(), kernels::add_soft_forces_baseline,
                                   kernels::add_soft_forces_avx2, kernels::add_soft_forces_avx512);
  kernels::SoftSquares squares =
      for_set<kernels::SoftSquares>(best_instruction_set(), kernels::soft_squares_baseline,
                                    kernels::soft_squares_avx2, kernels::soft_squares_avx512);
  kernels::SoftDrift drift = for_set<kernels::SoftDrift>(best_instruction_set(), kernels::move_soft_baseline,
                                                         kernels::move_soft_avx2, kernels::move_soft_avx512);
};
const Kernels &best() {
  static const Kernels kernels;
  return kernels;
}

// Force along an axis on a sphere of radius r at x between walls at -half and half, both of which it may
// touch.
template <class Touch>
double squeeze(double x, double r, double half, const Touch &touch) {
  const double right = x + r - half, left = r - half - x;
  double force = 0;
  if (right > 0) force -= right, touch(right);
  if (left > 0) force += left, touch(left);
  return force;
}

} // namespace

SoftSpheres::SoftSpheres(Room room, const std::vector<Vector3> &centre, std::vector<double> factor)
    : room_(std::move(room)), factor_(std::move(factor)) {
  largest_factor_ = factor_.empty() ? 1.0 : *std::max_element(factor_.begin(), factor_.end());
  rows_ = number_of_blocks(size(), soft_pack) * soft_pack;
  std::vector<Vector3> sorted = centre;
  sort_in_space(sorted);
  ball_.resize(rows_ + 1);
  for (std::size_t i = 0; i < size(); ++i)
    ball_[i] = {factor_[i], sorted[i].x, sorted[i].y, sorted[i].z};
  ball_[rows_].radius = touches_none;
  force_.resize(rows_ + 1), velocity_.resize(rows_ + 1);
  force_square_.resize(rows_), speed_square_.resize(rows_);
  sums_.resize(number_of_blocks(rows_));
}

// Neighbours in space become neighbours in memory; they stay so, since spheres move by a few radii at most.
void SoftSpheres::sort_in_space(std::vector<Vector3> &centre) {
  const BoundingBox bounds = bounding_box(room_.shape);
  const PointGrid grid(bounds.low, bounds.high, 3.0 * largest_factor_);
  std::vector<std::pair<std::size_t, std::size_t>> key(centre.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    key[i] = {grid.cell_of(centre[i]), i};
  std::sort(key.begin(), key.end());
  std::vector<Vector3> placed(centre.size());
  std::vector<double> factor(factor_.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    placed[i] = centre[key[i].second], factor[i] = factor_[key[i].second];
  centre.swap(placed), factor_.swap(factor);
}

void SoftSpheres::set_scale(double scale) {
  scale_ = scale;
  for (std::size_t i = 0; i < size(); ++i)
    ball_[i].radius = scale * factor_[i];
  move_images();
  for (BlockSums &s : sums_)
    s.room = -1;
}

std::vector<Vector3> SoftSpheres::centres() const {
  std::vector<Vector3> all(size());
  for (std::size_t i = 0; i < size(); ++i)
    all[i] = room_.repeats ? within(room_.shape, place(i)) : place(i);
  return all;
}

// What is nearer to a face than a partner can be stands once more beyond the opposite one, in edges and
// corners too.
void SoftSpheres::make_images() {
  const double reach = 2 * (scale_ * largest_factor_ + *std::max_element(reach_.begin(), reach_.end()));
  const Vector3 period = periods(room_.shape);
  const BoundingBox box = bounding_box(room_.shape);
  owner_.clear(), shift_.clear();
  for (std::size_t i = 0; i < size(); ++i) {
    const Vector3 at = within(room_.shape, place(i));
    ball_[i].x = at.x, ball_[i].y = at.y, ball_[i].z = at.z;
    int from[3], to[3];
    for (int k = 0; k < 3; ++k) {
      from[k] = at[k] > box.high[k] - reach ? -1 : 0;
      to[k] = at[k] < box.low[k] + reach ? 1 : 0;
    }
    for (int x = from[0]; x <= to[0]; ++x)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int z = from[2]; z <= to[2]; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          owner_.push_back(static_cast<int>(i));
          shift_.push_back({x * period.x, y * period.y, z * period.z});
        }
  }
  ball_.resize(rows_ + 1 + owner_.size());
  move_images();
}

void SoftSpheres::move_images() {
  for_each(shift_.size(), [&](std::size_t k) {
    const Ball &b = ball_[static_cast<std::size_t>(owner_[k])];
    const Vector3 &s = shift_[k];
    ball_[rows_ + 1 + k] = {b.radius, b.x + s.x, b.y + s.y, b.z + s.z};
  });
}

void SoftSpheres::choose_reach() {
  if (reach_.empty()) {
    reach_.assign(size(), first_reach);
    return;
  }
  std::vector<double> moved(size());
  for_each(size(), [&](std::size_t i) { moved[i] = norm(place(i) - centre_at_build_[i]); });
  const double mean = std::accumulate(moved.begin(), moved.end(), 0.0) / static_cast<double>(size());
  const double longer =
      std::min(wanted_life / static_cast<double>(std::max(since_build_, 1L)), mean_reach / (mean + tiny));
  for_each(size(), [&](std::size_t i) {
    reach_[i] = std::clamp(longer * std::max(moved[i], spare * mean),
                           std::max(shortest_reach, forgotten * reach_[i]), longest_reach);
  });
}

void SoftSpheres::find_partners() {
  choose_reach();
  since_build_ = 0;
  if (room_.repeats) make_images();
  partners_.build({ball_.data(), size(), rows_ + 1, ball_.size(), owner_.data(), reach_.data()});
  near_wall_.clear();
  centre_at_build_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) {
    centre_at_build_[i] = place(i);
    if (!room_.repeats && wall_clearance(room_.shape, place(i)) < ball_[i].radius + 2 * reach_[i])
      near_wall_.push_back(static_cast<int>(i));
  }
  scale_at_build_ = scale_;
  for (std::size_t b = 0; b < sums_.size(); ++b)
    sums_[b].room = room_of(b * block_rows, std::min(size(), (b + 1) * block_rows));
}

// A pair off the list becomes a contact only after one end has moved, or grown, farther than its reach.
double SoftSpheres::room_of(std::size_t first, std::size_t last) const {
  const double growth = std::max(0.0, scale_ - scale_at_build_) * largest_factor_;
  double room = longest_reach;
  for (std::size_t i = first; i < last; ++i)
    room = std::min(room, reach_[i] - growth - norm(place(i) - centre_at_build_[i]));
  return room;
}

bool SoftSpheres::partners_are_stale() {
  if (partners_.first.empty()) return true;
  for_each_block(size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    double &room = sums_[block].room;
    if (room <= 0) room = room_of(first, last);
  });
  return std::any_of(sums_.begin(), sums_.end(), [](const BlockSums &s) { return s.room <= 0; });
}

template <class Touch>
Vector3 SoftSpheres::wall_force(std::size_t i, const Touch &touch) const {
  const Shape &shape = room_.shape;
  const double half_height = 0.5 * shape.height, r = ball_[i].radius;
  const Vector3 c = place(i);
  Vector3 f;
  f.z = squeeze(c.z - half_height, r, half_height, touch);
  if (shape.kind == ShapeKind::box) {
    f.x = squeeze(c.x, r, 0.5 * shape.width_x, touch);
    f.y = squeeze(c.y, r, 0.5 * shape.width_y, touch);
    return f;
  }
  const double across = c.x * c.x + c.y * c.y, inner = shape.radius - r;
  if (inner > 0 && across <= inner * inner) return f;
  const double distance = std::sqrt(across), force = squeeze(distance, r, shape.radius, touch);
  if (distance > 0) f.x = force * c.x / distance, f.y = force * c.y / distance;
  return f;
}

kernels::SoftColumns SoftSpheres::columns() {
  return {ball_.data(),
          force_.data(),
          velocity_.data(),
          press_.empty() ? nullptr : press_.data(),
          partners_.partner.data(),
          partners_.first.data(),
          partners_.earlier.data(),
          force_square_.data(),
          speed_square_.data()};
}

// Forces, and the squares that a step downhill with `next_step` needs.
void SoftSpheres::compute_forces(double next_step) {
  if (partners_are_stale()) find_partners();
  ++since_build_;
  const kernels::SoftColumns c = columns();
  for_each_block(
      rows_ / soft_pack,
      [&](std::size_t first, std::size_t last, std::size_t block) {
        BlockSums &sums = sums_[block];
        sums.contacts = best().add_forces(c, first, last);
        const auto touch = [&](double overlap) { sums.contacts.overlap += overlap, ++sums.contacts.number; };
        const auto from = std::lower_bound(near_wall_.begin(), near_wall_.end(), soft_pack * first);
        for (auto w = from; w != near_wall_.end() && *w < static_cast<int>(soft_pack * last); ++w)
          force_[static_cast<std::size_t>(*w)] += wall_force(static_cast<std::size_t>(*w), touch);
        sums.power = best().squares(c, next_step, first, last);
      },
      packs_of_block);
  sum_squares();
}

void SoftSpheres::compute_squares(double next_step) {
  const kernels::SoftColumns c = columns();
  for_each_block(
      rows_ / soft_pack,
      [&](std::size_t first, std::size_t last, std::size_t block) {
        sums_[block].power = best().squares(c, next_step, first, last);
      },
      packs_of_block);
  sum_squares();
}

// One after the other, as the places depend on their last bit.
void SoftSpheres::sum_squares() {
  push_ = speed_ = 0;
  for (std::size_t i = 0; i < size(); ++i)
    push_ += force_square_[i], speed_ += speed_square_[i];
  residual_ = size() == 0 ? 0 : std::sqrt(push_ / static_cast<double>(size()));
}

// Contacts one after the other, those of pairs before those of walls. Pairs on the list that do not touch add
// nothing, so that the sums do not know how many of them there are.
Overlaps SoftSpheres::exact_overlaps() const {
  Overlaps now;
  const auto touch = [&](double overlap) {
    ++now.contacts;
    now.mean += overlap; // the sum, divided below
    now.max = std::max(now.max, overlap);
  };
  for (std::size_t i = 0; i < size(); ++i) {
    const std::size_t pack = i / soft_pack, end = partners_.first[pack + 1];
    std::size_t k = partners_.first[pack] + i % soft_pack;
    for (k += soft_pack * static_cast<std::size_t>(partners_.earlier[i]); k < end; k += soft_pack) {
      const Ball &a = ball_[i], &b = ball_[static_cast<std::size_t>(partners_.partner[k])];
      const double distance = norm(Vector3{b.x, b.y, b.z} - place(i));
      if (a.radius + b.radius - distance > 0) touch(a.radius + b.radius - distance);
    }
  }
  now.pairs = now.contacts;
  for (const int w : near_wall_)
    wall_force(static_cast<std::size_t>(w), touch);
  if (now.contacts > 0) now.mean /= static_cast<double>(now.contacts);
  now.residual_force = residual_;
  return now;
}

Overlaps SoftSpheres::overlaps() {
  compute_forces(first_step);
  return exact_overlaps();
}

std::size_t SoftSpheres::press_loose_spheres(double force, Random &random) {
  compute_forces(first_step); // the list of pairs must be of now
  press_.assign(rows_ + 1, Vector3{});
  std::size_t loose = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    const std::size_t pack = i / soft_pack;
    int contacts = !room_.repeats && wall_clearance(room_.shape, place(i)) < ball_[i].radius ? 1 : 0;
    for (std::size_t k = partners_.first[pack] + i % soft_pack; k < partners_.first[pack + 1];
         k += soft_pack) {
      const Ball &b = ball_[static_cast<std::size_t>(partners_.partner[k])];
      const double reach = ball_[i].radius + b.radius;
      if (reach > 0 && norm_squared(place(i) - Vector3{b.x, b.y, b.z}) < reach * reach) ++contacts;
    }
    if (contacts >= 4) continue;
    press_[i] = force * random.direction();
    ++loose;
  }
  return loose;
}

bool SoftSpheres::at_rest(double tolerance, double floor) {
  double overlap = 0, contacts = 0;
  for (const BlockSums &s : sums_)
    overlap += s.contacts.overlap, contacts += s.contacts.number;
  const double limit = std::max(contacts > 0 ? tolerance * overlap / contacts : 0.0, floor);
  if (std::abs(residual_ - limit) > relative_doubt * limit) return residual_ <= limit;
  return residual_ <= std::max(tolerance * exact_overlaps().mean, floor);
}

bool SoftSpheres::goes_downhill() const {
  double power = 0, size_of_terms = 0;
  for (const BlockSums &s : sums_)
    power += s.power.sum, size_of_terms += s.power.size;
  if (std::abs(power) > round_off * static_cast<double>(size()) * size_of_terms) return power > 0;
  power = 0;
  for (std::size_t i = 0; i < size(); ++i)
    power += dot(force_[i], velocity_[i]);
  return power > 0;
}

// Half of the last drift is taken back, and everything stands still.
void SoftSpheres::step_back(double step) {
  for_each(size(), [&](std::size_t i) {
    const Vector3 at = place(i) - (0.5 * step) * velocity_[i];
    ball_[i].x = at.x, ball_[i].y = at.y, ball_[i].z = at.z;
    velocity_[i] = Vector3{};
  });
  for (BlockSums &s : sums_)
    s.room -= 0.5 * step * s.fastest;
}

void SoftSpheres::drift(double step, double mixing) {
  const kernels::SoftMove by{step, mixing, push_ > 0 ? mixing * std::sqrt(speed_ / push_) : 0.0};
  const kernels::SoftColumns c = columns();
  for_each_block(
      rows_ / soft_pack,
      [&](std::size_t first, std::size_t last, std::size_t block) {
        BlockSums &sums = sums_[block];
        sums.fastest = std::sqrt(best().drift(c, by, first, last));
        sums.room -= step * sums.fastest;
      },
      packs_of_block);
  move_images();
}

long SoftSpheres::relax(double tolerance, double floor, long max_iterations) {
  std::fill(velocity_.begin(), velocity_.end(), Vector3{});
  double step = first_step, mixing = first_mixing;
  int downhill = 0;
  for (long iteration = 0; iteration < max_iterations; ++iteration) {
    const bool grows = downhill + 1 > steps_before_growth;
    const double next_step = grows ? std::min(step * step_growth, largest_step) : step;
    compute_forces(next_step);
    if (at_rest(tolerance, floor)) return iteration;
    if (goes_downhill()) {
      ++downhill;
      step = next_step;
      if (grows) mixing *= mixing_decay;
    } else {
      step_back(step);
      if (iteration > 0) step = std::max(step * step_cut, smallest_step);
      mixing = first_mixing, downhill = 0;
      compute_squares(step);
    }
    drift(step, mixing);
  }
  return max_iterations;
}

} // namespace platen::dem
