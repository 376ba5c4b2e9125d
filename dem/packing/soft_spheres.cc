#include "dem/packing/soft_spheres.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel.h"
#include "dem/instruction_set.h"
#include "dem/packing/point_grid.h"

namespace platen::dem {

using kernels::soft_group;
using kernels::SoftRow;

namespace {

// In mean radii: displacement of a sphere until the next search for partners. Most oscillate in place, loose
// ones fly through their cages: each gets what it needs for `wanted_life` iterations, as long as the lists
// stay short (mean_reach). A search costs as much as about ten iterations.
constexpr double first_reach = 0.1, shortest_reach = 0.0125, longest_reach = 0.5, mean_reach = 0.15;
constexpr double wanted_life = 450;
constexpr double spare = 1.5; // reach of the calm ones over the need of the mean sphere
constexpr double forgotten =
    0.7; // part of a reach that stays after a search: a loose sphere may have just turned back
constexpr double rounded_up = 1 + 1e-5; // of speeds: more than the loss in single precision
// FIRE, as published except for the largest step: 2 / w_max is about .55 for spheres with 6 to 12 contacts.
constexpr double first_step = 0.1, largest_step = 0.45, smallest_step = 0.002;
constexpr double step_growth = 1.1, step_cut = 0.5, first_mixing = 0.1, mixing_decay = 0.99;
constexpr int steps_before_growth = 5;
// Loose spheres move to their seats under a force that would cause this overlap, which takes few steps, and
// then find the balance with the required force, near enough for the relaxation of all that follows.
constexpr double swift_push = 1e-3;
constexpr double seated = 0.02; // residual force over mean overlap
constexpr long most_seating = 5000;

constexpr double tiny = 1e-300;

// The kernels for this processor; all give the same positions.
struct Kernels {
  kernels::SoftForces add_forces =
      for_set<kernels::SoftForces>(best_instruction_set(), kernels::add_soft_forces_baseline,
                                   kernels::add_soft_forces_avx2, kernels::add_soft_forces_avx512);
  kernels::SoftDrift drift = for_set<kernels::SoftDrift>(best_instruction_set(), kernels::move_soft_baseline,
                                                         kernels::move_soft_avx2, kernels::move_soft_avx512);
};
const Kernels &best() {
  static const Kernels kernels;
  return kernels;
}

SoftRow row_of(const Vector3 &v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}

// Neighbours in space become neighbours in memory; they stay so, since spheres move by a few radii at most.
void sort_in_space(const Container &container, std::vector<Vector3> &centre, std::vector<double> &factor) {
  const double largest = factor.empty() ? 1.0 : *std::max_element(factor.begin(), factor.end());
  const BoundingBox bounds = bounding_box(container.shape);
  const PointGrid grid(bounds.low, bounds.high, 3.0 * largest);
  std::vector<std::pair<std::size_t, std::size_t>> key(centre.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    key[i] = {grid.cell_of(centre[i]), i};
  std::sort(key.begin(), key.end());
  std::vector<Vector3> placed(centre.size());
  std::vector<double> sorted(factor.size());
  for (std::size_t i = 0; i < key.size(); ++i)
    placed[i] = centre[key[i].second], sorted[i] = factor[key[i].second];
  centre.swap(placed), factor.swap(sorted);
}

// Calls visit(shift) for every image within `reach` of the container's faces: a sphere nearer to a face than
// a partner can be is repeated beyond the opposite face, in edges and corners too.
template <class Visit>
void for_each_image(const Shape &shape, const Vector3 &at, double reach, const Visit &visit) {
  const Vector3 period = periods(shape);
  const BoundingBox box = bounding_box(shape);
  int from[3], to[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = at[k] > box.high[k] - reach ? -1 : 0;
    to[k] = at[k] < box.low[k] + reach ? 1 : 0;
  }
  for (int x = from[0]; x <= to[0]; ++x)
    for (int y = from[1]; y <= to[1]; ++y)
      for (int z = from[2]; z <= to[2]; ++z)
        if (x != 0 || y != 0 || z != 0) visit(Vector3{x * period.x, y * period.y, z * period.z});
}

} // namespace

SoftSpheres::SoftSpheres(Container container, std::vector<Vector3> centre, std::vector<double> factor)
    : SoftSpheres(std::move(container), std::move(centre), std::move(factor), {}) {
  sort_in_space(container_, centre_, factor_);
}

SoftSpheres::SoftSpheres(Container container, std::vector<Vector3> centre, std::vector<double> factor,
                         std::vector<Obstacle> obstacles)
    : container_(std::move(container)),
      factor_(std::move(factor)),
      obstacles_(std::move(obstacles)),
      centre_(std::move(centre)) {
  largest_factor_ = factor_.empty() ? 1.0 : *std::max_element(factor_.begin(), factor_.end());
  for (const Obstacle &o : obstacles_)
    largest_factor_ = std::max(largest_factor_, o.factor);
  rows_ = number_of_blocks(size(), soft_group) * soft_group;
  velocity_.resize(rows_), force_.resize(rows_), outside_.resize(rows_);
  displacement_.assign(rows_ + obstacles_.size(), {0, 0, 0, 1}); // spare rows need a radius
  reach_.assign(size(), first_reach);
  sums_.resize(number_of_blocks(size()));
}

void SoftSpheres::set_scale(double scale) {
  scale_ = scale;
  lists_are_good_ = false;
}

std::vector<Vector3> SoftSpheres::centres() const {
  std::vector<Vector3> all(size());
  for (std::size_t i = 0; i < size(); ++i)
    all[i] = container_.repeats ? within(container_.shape, place(i)) : place(i);
  return all;
}

void SoftSpheres::choose_reach() {
  if (since_build_ == 0) return;
  std::vector<double> moved(size());
  for_each(size(), [&](std::size_t i) { moved[i] = norm(displacement(i)); });
  const double mean = std::accumulate(moved.begin(), moved.end(), 0.0) / static_cast<double>(size());
  const double longer = std::min(wanted_life / static_cast<double>(since_build_), mean_reach / (mean + tiny));
  for_each(size(), [&](std::size_t i) {
    reach_[i] = std::clamp(longer * std::max(moved[i], spare * mean),
                           std::max(shortest_reach, forgotten * reach_[i]), longest_reach);
  });
}

void SoftSpheres::make_balls() {
  balls_.resize(size());
  for_each(size(), [&](std::size_t i) {
    balls_[i] = {centre_[i], scale_ * factor_[i], reach_[i], static_cast<int>(i)};
  });
  for (std::size_t k = 0; k < obstacles_.size(); ++k)
    balls_.push_back({obstacles_[k].centre, scale_ * obstacles_[k].factor, 0, static_cast<int>(rows_ + k)});
  if (!container_.repeats) return;
  const double farthest = *std::max_element(reach_.begin(), reach_.end());
  const double reach = 2 * (scale_ * largest_factor_ + farthest);
  for (std::size_t b = 0, inside = balls_.size(); b < inside; ++b)
    for_each_image(container_.shape, balls_[b].centre, reach, [&](const Vector3 &shift) {
      balls_.push_back(balls_[b]);
      balls_.back().centre += shift;
    });
}

// Displacements restart from zero here, so that they stay small.
void SoftSpheres::find_partners() {
  choose_reach();
  since_build_ = 0;
  for_each(size(), [&](std::size_t i) {
    centre_[i] = container_.repeats ? within(container_.shape, place(i)) : place(i);
    displacement_[i] = {0, 0, 0, static_cast<float>(scale_ * factor_[i])};
  });
  for (std::size_t k = 0; k < obstacles_.size(); ++k)
    displacement_[rows_ + k].w = static_cast<float>(scale_ * obstacles_[k].factor);
  make_balls();
  find_soft_partners(balls_, size(), partners_);
  find_walls();
  for_each_block(size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    sums_[block].clearance = clearance_of(first, last);
  });
  lists_are_good_ = true;
}

void SoftSpheres::find_walls() {
  walls_.clear(container_.shape);
  for (std::size_t i = 0; i < size(); ++i) {
    outside_[i] = press_.empty() ? SoftRow{} : row_of(press_[i]);
    if (!container_.repeats) walls_.add(static_cast<int>(i), centre_[i], scale_ * factor_[i], 2 * reach_[i]);
  }
}

// A pair that is not listed becomes a contact only after one end has moved farther than its reach.
double SoftSpheres::clearance_of(std::size_t first, std::size_t last) const {
  double clearance = longest_reach;
  for (std::size_t i = first; i < last; ++i)
    clearance = std::min(clearance, reach_[i] - norm(displacement(i)));
  return clearance;
}

bool SoftSpheres::partners_are_stale() {
  if (!lists_are_good_) return true;
  for (std::size_t b = 0; b < sums_.size(); ++b) {
    double &clearance = sums_[b].clearance;
    if (clearance <= 0) clearance = clearance_of(b * block_rows, std::min(size(), (b + 1) * block_rows));
    if (clearance <= 0) return true;
  }
  return false;
}

kernels::SoftColumns SoftSpheres::columns() {
  return {displacement_.data(), velocity_.data(), force_.data(), outside_.data()};
}

// Forces, and the sums of squares for a downhill step with `next_step`.
void SoftSpheres::compute_forces(double next_step) {
  if (partners_are_stale()) find_partners();
  ++since_build_;
  const kernels::SoftColumns c = columns();
  for_each_block(size(), [&](std::size_t first, std::size_t last, std::size_t block) {
    walls_.for_each_row(first, last,
                        [&](std::size_t i) { outside_[i] = press_.empty() ? SoftRow{} : row_of(press_[i]); });
    sums_[block].of_walls = walls_.add_forces(first, last, displacement_.data(), outside_.data());
    sums_[block].of_kernel = best().add_forces(c, partners_[block].lists(), static_cast<float>(next_step));
  });
  add_up();
}

// Block after block, as positions depend on the last bit. A pair is counted at both ends, a wall at one.
void SoftSpheres::add_up() {
  total_ = {};
  double overlap = 0, contacts = 0;
  for (const BlockSums &s : sums_) {
    total_.push += s.of_kernel.push, total_.speed += s.of_kernel.speed, total_.power += s.of_kernel.power;
    overlap += 0.5 * s.of_kernel.overlap + s.of_walls.overlap;
    contacts += 0.5 * s.of_kernel.contacts + s.of_walls.contacts;
  }
  mean_overlap_ = contacts > 0 ? overlap / contacts : 0;
  residual_ = size() == 0 ? 0 : std::sqrt(total_.push / static_cast<double>(size()));
}

// visit(row, overlap) for both ends of every touching pair, in the state when the lists were made.
template <class Visit>
void SoftSpheres::for_each_touch(const Visit &visit) const {
  for (const SoftPartners &block : partners_) {
    const float *separation = block.separation.data();
    const unsigned *partner = block.partner.data();
    for (std::size_t group = 0; group < block.steps.size(); ++group)
      for (int k = 0; k < block.steps[group]; ++k, partner += soft_group, separation += 4 * soft_group)
        for (std::size_t l = 0; l < soft_group; ++l) {
          const double outside = static_cast<double>(separation[3 * soft_group + l]);
          if (!(outside < 0)) continue;
          const Vector3 d{separation[l], separation[soft_group + l], separation[2 * soft_group + l]};
          const int row = block.row[soft_group * group + l];
          const double reach = static_cast<double>(displacement_[static_cast<std::size_t>(row)].w) +
                               static_cast<double>(displacement_[partner[l] / sizeof(SoftRow)].w);
          visit(static_cast<std::size_t>(row), -outside / (reach + norm(d)));
        }
  }
}

Overlaps SoftSpheres::overlaps() {
  lists_are_good_ = false;
  compute_forces(first_step);
  Overlaps now;
  std::size_t ends = 0;
  double sum = 0;
  for_each_touch([&](std::size_t, double overlap) {
    ++ends, sum += overlap;
    now.max = std::max(now.max, overlap);
  });
  now.pairs = now.contacts = ends / 2;
  now.mean = 0.5 * sum;
  for (const BlockSums &s : sums_) {
    now.contacts += static_cast<std::size_t>(s.of_walls.contacts), now.mean += s.of_walls.overlap;
    now.max = std::max(now.max, s.of_walls.largest);
  }
  if (now.contacts > 0) now.mean /= static_cast<double>(now.contacts);
  now.residual_force = residual_;
  return now;
}

bool SoftSpheres::touches_wall(std::size_t i) const {
  return !container_.repeats && wall_clearance(container_.shape, centre_[i]) < scale_ * factor_[i];
}

std::vector<std::size_t> SoftSpheres::loose_spheres() const {
  std::vector<int> contacts(size(), 0);
  for_each_touch([&](std::size_t row, double) { ++contacts[row]; });
  std::vector<std::size_t> loose;
  for (std::size_t i = 0; i < size(); ++i)
    if (contacts[i] + (touches_wall(i) ? 1 : 0) < 4) loose.push_back(i);
  return loose;
}

std::vector<std::size_t> SoftSpheres::push_loose_spheres(double force, Random &random) {
  find_partners();
  std::vector<std::size_t> loose = loose_spheres();
  press_.assign(size(), Vector3{});
  for (const std::size_t i : loose)
    press_[i] = force * random.direction();
  lists_are_good_ = false;
  return loose;
}

std::size_t SoftSpheres::seat_loose_spheres(double force, Random &random) {
  const std::vector<std::size_t> loose = push_loose_spheres(force, random);
  if (loose.empty()) return 0;
  std::vector<Vector3> centre;
  std::vector<double> factor;
  std::vector<Obstacle> fixed;
  for (std::size_t i = 0, k = 0; i < size(); ++i)
    if (k < loose.size() && loose[k] == i)
      centre.push_back(centre_[i]), factor.push_back(factor_[i]), ++k;
    else
      fixed.push_back({centre_[i], factor_[i]});
  SoftSpheres alone(container_, std::move(centre), std::move(factor), std::move(fixed));
  alone.set_scale(scale_);
  for (const double push : {std::max(swift_push, force), force}) {
    alone.press_.clear();
    for (const std::size_t i : loose)
      alone.press_.push_back((push / force) * press_[i]);
    alone.lists_are_good_ = false;
    alone.relax(seated, 0, most_seating);
  }
  for (std::size_t k = 0; k < loose.size(); ++k)
    centre_[loose[k]] = alone.place(k);
  return loose.size();
}

bool SoftSpheres::at_rest(double tolerance, double floor) const {
  return residual_ <= std::max(tolerance * mean_overlap_, floor);
}

// Takes back half of the last drift and sets all velocities to zero.
void SoftSpheres::step_back(double step) {
  const float half = static_cast<float>(0.5 * step);
  for_each(size(), [&](std::size_t i) {
    SoftRow &u = displacement_[i], &v = velocity_[i];
    u.x -= half * v.x, u.y -= half * v.y, u.z -= half * v.z;
    v = SoftRow{};
  });
  for (BlockSums &s : sums_)
    s.clearance -= 0.5 * step * s.fastest;
}

void SoftSpheres::drift(double step, double mixing) {
  const double along = total_.push > 0 ? mixing * std::sqrt(total_.speed / total_.push) : 0.0;
  const kernels::SoftMove by{static_cast<float>(step), static_cast<float>(mixing), static_cast<float>(along)};
  const kernels::SoftColumns c = columns();
  for_each_block(rows_, [&](std::size_t first, std::size_t last, std::size_t block) {
    BlockSums &sums = sums_[block];
    sums.fastest = rounded_up * std::sqrt(static_cast<double>(best().drift(c, by, first, last)));
    sums.clearance -= step * sums.fastest;
  });
}

long SoftSpheres::relax(double tolerance, double floor, long max_iterations) {
  std::fill(velocity_.begin(), velocity_.end(), SoftRow{});
  double step = first_step, mixing = first_mixing;
  int downhill = 0;
  for (long iteration = 0; iteration < max_iterations; ++iteration) {
    const bool grows = downhill + 1 > steps_before_growth;
    const double next_step = grows ? std::min(step * step_growth, largest_step) : step;
    compute_forces(next_step);
    if (at_rest(tolerance, floor)) return iteration;
    if (total_.power > 0) {
      ++downhill;
      step = next_step;
      if (grows) mixing *= mixing_decay;
    } else {
      step_back(step);
      if (iteration > 0) step = std::max(step * step_cut, smallest_step);
      mixing = first_mixing, downhill = 0;
      total_.speed = step * step * total_.push; // of a kick from rest
    }
    drift(step, mixing);
  }
  return max_iterations;
}

} // namespace platen::dem
