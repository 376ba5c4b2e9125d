// Soft spheres on their way to rest: the way is that of a plain loop over all pairs in double precision, and
// the same to the last bit on any number of threads and any processor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "dem/instruction_set.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"
#include "dem/packing/periodic_growth.h"
#include "dem/packing/point_grid.h"
#include "dem/packing/soft_partners.h"
#include "dem/packing/soft_spheres.h"
#include "dem/packing/tiled.h"

namespace platen::dem::packing_soft_test {
namespace {

bool same_bytes(const Specimen &a, const Specimen &b) {
  return a.size() == b.size() && a.size() > 0 &&
         std::memcmp(a.centre.data(), b.centre.data(), a.size() * sizeof(Vector3)) == 0 &&
         std::memcmp(a.radius.data(), b.radius.data(), a.size() * sizeof(double)) == 0;
}

// FIRE with unit stiffness as it is written down, every pair looked at in every iteration.
class PlainSpheres {
public:
  PlainSpheres(const Shape &shape, std::vector<Vector3> centre, std::vector<double> radius)
      : shape_(shape), centre_(std::move(centre)), radius_(std::move(radius)) {}
  const std::vector<Vector3> &centre() const { return centre_; }

  void relax(long iterations) {
    const std::size_t n = centre_.size();
    std::vector<Vector3> velocity(n);
    double step = 0.1, mixing = 0.1;
    int downhill = 0;
    for (long iteration = 0; iteration < iterations; ++iteration) {
      compute_forces();
      double power = 0, speed = 0, push = 0;
      for (std::size_t i = 0; i < n; ++i)
        power += dot(force_[i], velocity[i]);
      if (power > 0) {
        if (++downhill > 5) step = std::min(step * 1.1, 0.45), mixing *= 0.99;
      } else {
        for (std::size_t i = 0; i < n; ++i)
          centre_[i] -= (0.5 * step) * velocity[i], velocity[i] = Vector3{};
        if (iteration > 0) step = std::max(step * 0.5, 0.002);
        mixing = 0.1, downhill = 0;
      }
      for (std::size_t i = 0; i < n; ++i) {
        velocity[i] += step * force_[i];
        speed += norm_squared(velocity[i]), push += norm_squared(force_[i]);
      }
      const double along = push > 0 ? mixing * std::sqrt(speed / push) : 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        velocity[i] = (1 - mixing) * velocity[i] + along * force_[i];
        centre_[i] += step * velocity[i];
      }
    }
  }

private:
  static double squeeze(double x, double r, double half) {
    return std::max(0.0, r - half - x) - std::max(0.0, x + r - half);
  }
  void compute_forces() {
    force_.assign(centre_.size(), Vector3{});
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      Vector3 sum;
      for (std::size_t j = i + 1; j < centre_.size(); ++j) {
        const Vector3 d = centre_[j] - centre_[i];
        const double overlap = std::max(0.0, radius_[i] + radius_[j] - norm(d));
        const Vector3 f = (overlap / norm(d)) * d;
        sum -= f;
        force_[j] += f;
      }
      force_[i] += sum;
    }
    for (std::size_t i = 0; i < centre_.size(); ++i) {
      const Vector3 &c = centre_[i];
      const double half = 0.5 * shape_.height, r = radius_[i], out = std::sqrt(c.x * c.x + c.y * c.y);
      force_[i].z += squeeze(c.z - half, r, half);
      const double inwards = squeeze(out, r, shape_.radius);
      if (inwards != 0) force_[i].x += inwards * c.x / out, force_[i].y += inwards * c.y / out;
    }
  }

  Shape shape_;
  std::vector<Vector3> centre_, force_;
  std::vector<double> radius_;
};

TEST(SoftSpheres, go_where_a_plain_loop_over_all_pairs_takes_them) {
  const Shape shape = cylinder(5, 12);
  Random random(3);
  std::vector<Vector3> centre;
  std::vector<double> factor;
  while (centre.size() < 150) { // nine groups of sixteen and six more
    const Vector3 p{random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(0, 12)};
    if (wall_clearance(shape, p) < 0.5) continue;
    centre.push_back(p), factor.push_back(random.uniform(0.7, 1.3));
  }
  SoftSpheres soft({shape, false}, centre, factor);
  PlainSpheres plain(shape, soft.centres(), soft.factor());
  const auto farthest_apart = [&] {
    const std::vector<Vector3> places = soft.centres();
    double most = 0;
    for (std::size_t i = 0; i < places.size(); ++i)
      most = std::max(most, norm(places[i] - plain.centre()[i]));
    return most;
  };
  // From its last place each time, at rest. Single precision is off by some 1e-7 of each way.
  soft.relax(0, 0, 1), plain.relax(1);
  EXPECT_LT(farthest_apart(), 1e-6);
  soft.relax(0, 0, 60), plain.relax(60);
  EXPECT_LT(farthest_apart(), 1e-4);
}

// By step^2 of the force, with a first step of .1. At the axis the wall has no direction; a sphere that is
// wider than the room is pressed by r - R from both sides, a stiffness of 2 towards the axis.
TEST(SoftSpheres, stay_on_the_axis_of_a_room_that_they_fill) {
  SoftSpheres soft({cylinder(1.02, 20), false},
                   {{0, 0, 2}, {0.01, 0, 6}, {0.004, -0.003, 10}, {0.036, 0.048, 14}}, {1, 1, 1.05, 1});
  const Overlaps at_first = soft.overlaps();
  EXPECT_EQ(at_first.contacts, 2u);
  EXPECT_EQ(at_first.pairs, 0u);
  EXPECT_NEAR(at_first.mean, 0.5 * (0.03 + 0.04), 1e-7);
  EXPECT_NEAR(at_first.max, 0.04, 1e-7);
  const std::vector<Vector3> before = soft.centres(); // sorted along z
  soft.relax(0, 0, 1);
  const std::vector<Vector3> after = soft.centres();
  const std::vector<Vector3> force{{}, {}, {-0.008, 0.006, 0}, {-0.6 * 0.04, -0.8 * 0.04, 0}};
  for (std::size_t i = 0; i < force.size(); ++i)
    EXPECT_LT(norm(100 * (after[i] - before[i]) - force[i]), 1e-5) << "sphere " << i;
}

TEST(SoftSpheres, come_to_rest_far_below_what_single_precision_makes_of_places) {
  // Places of some hundred radii are good to 1e-5 in single precision; overlaps and forces here are smaller.
  const Shape shape = cylinder(4, 200);
  Random random(5);
  std::vector<Vector3> centre;
  while (centre.size() < 1500) {
    const Vector3 p{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(0, 200)};
    if (wall_clearance(shape, p) > 0.5) centre.push_back(p);
  }
  SoftSpheres soft({shape, false}, centre, std::vector<double>(centre.size(), 1.0));
  soft.relax(1e-5, 0, 20000);
  const Overlaps now = soft.overlaps();
  const std::vector<Vector3> at = soft.centres();
  // The same force in double precision.
  double squares = 0;
  PointGrid filled({-4, -4, 0}, {4, 4, 200}, 2.0);
  for (const Vector3 &p : at)
    filled.add(p);
  for (std::size_t i = 0; i < at.size(); ++i) {
    Vector3 force;
    filled.for_each_near(at[i], 2.0, [&](int j) {
      const Vector3 d = at[j] - at[i];
      const double distance = norm(d);
      if (static_cast<std::size_t>(j) != i && distance < 2) force -= ((2 - distance) / distance) * d;
    });
    force.z += std::max(0.0, 1 - at[i].z) - std::max(0.0, at[i].z - 199);
    const double out = std::hypot(at[i].x, at[i].y);
    if (out > 3) force.x -= (out - 3) * at[i].x / out, force.y -= (out - 3) * at[i].y / out;
    squares += norm_squared(force);
  }
  const double residual = std::sqrt(squares / static_cast<double>(at.size()));
  EXPECT_LT(residual, 2e-5 * now.mean);
  EXPECT_NEAR(residual, now.residual_force, 0.1 * residual);
}

TEST(SoftSpheres, feel_their_nearest_images_through_faces_edges_and_corners) {
  const Shape room = box(6, 5, 7);
  const Vector3 period = periods(room);
  Random random(12);
  std::vector<Vector3> centre;
  std::vector<double> factor;
  for (int i = 0; i < 70; ++i) {
    centre.push_back({random.uniform(-3, 3), random.uniform(-2.5, 2.5), random.uniform(0, 7)});
    factor.push_back(random.uniform(0.6, 1.2));
  }
  SoftSpheres soft({room, true}, centre, factor);
  const std::vector<Vector3> before = soft.centres();
  soft.relax(0, 0, 1); // from rest by step^2 of the force, with a first step of .1
  const std::vector<Vector3> after = soft.centres();
  int through[4] = {}; // contacts over so many faces at once
  Vector3 total;
  for (std::size_t i = 0; i < before.size(); ++i) {
    Vector3 force;
    for (std::size_t j = 0; j < before.size(); ++j) {
      Vector3 d = before[j] - before[i];
      int faces = 0;
      for (int k = 0; k < 3; ++k) {
        const double shift = std::round(d[k] / period[k]);
        d[k] -= shift * period[k], faces += shift != 0 ? 1 : 0;
      }
      const double overlap = soft.factor()[i] + soft.factor()[j] - norm(d);
      if (j == i || overlap <= 0) continue;
      force -= (overlap / norm(d)) * d;
      ++through[faces];
    }
    total += force;
    Vector3 moved = after[i] - before[i];
    for (int k = 0; k < 3; ++k)
      moved[k] -= period[k] * std::round(moved[k] / period[k]);
    EXPECT_LT(norm(100 * moved - force), 1e-5) << "sphere " << i; // single precision
  }
  EXPECT_LT(norm(total), 1e-11); // nothing pulls the whole
  for (const int contacts : through)
    EXPECT_GT(contacts, 0);
}

struct Columns {
  std::vector<kernels::SoftRow> way, velocity, force, outside;
  kernels::SoftSums sums;
  float fastest = 0;
};

// Three groups of spheres anywhere, with one kernel set.
Columns by_kernels(kernels::SoftForces add_forces, kernels::SoftDrift drift) {
  constexpr std::size_t n = 3 * kernels::soft_group;
  Columns c;
  Random random(8);
  const auto row = [](const Vector3 &v, double w) {
    return kernels::SoftRow{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
                            static_cast<float>(w)};
  };
  std::vector<SoftBall> balls;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3 at{random.uniform(0, 3), random.uniform(0, 3), random.uniform(0, 3)};
    balls.push_back({at, random.uniform(0.5, 1.5), 0.1, static_cast<int>(i)});
    c.way.push_back(row(0.05 * random.direction(), balls[i].radius));
    c.velocity.push_back(row(random.direction(), 0));
    c.outside.push_back(row(0.1 * random.direction(), 0));
  }
  c.force.resize(n);
  std::vector<SoftPartners> blocks;
  find_soft_partners(balls, n - 3, blocks); // of the last group not all
  const kernels::SoftColumns columns{c.way.data(), c.velocity.data(), c.force.data(), c.outside.data()};
  c.sums = add_forces(columns, blocks[0].lists(), 0.37F);
  c.fastest = drift(columns, {0.37F, 0.09F, 0.2F}, 0, n);
  return c;
}

void expect_same(const Columns &a, const Columns &b) {
  const auto bytes = [](const auto &x, const auto &y) {
    return std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
  };
  EXPECT_TRUE(bytes(a.force, b.force));
  EXPECT_TRUE(bytes(a.velocity, b.velocity));
  EXPECT_TRUE(bytes(a.way, b.way));
  EXPECT_EQ(a.sums.overlap, b.sums.overlap);
  EXPECT_EQ(a.sums.contacts, b.sums.contacts);
  EXPECT_EQ(a.sums.push, b.sums.push);
  EXPECT_EQ(a.sums.speed, b.sums.speed);
  EXPECT_EQ(a.sums.power, b.sums.power);
  EXPECT_EQ(a.fastest, b.fastest);
}

TEST(SoftSpheres, go_the_same_way_on_every_instruction_set) {
  using namespace kernels;
  const Columns baseline = by_kernels(add_soft_forces_baseline, move_soft_baseline);
  EXPECT_GT(baseline.sums.contacts, 60);
  const InstructionSet best = best_instruction_set();
  if (best == InstructionSet::baseline) GTEST_SKIP() << "this processor has the baseline alone";
  expect_same(baseline, by_kernels(add_soft_forces_avx2, move_soft_avx2));
  if (best == InstructionSet::avx512)
    expect_same(baseline, by_kernels(add_soft_forces_avx512, move_soft_avx512));
}

TEST(SoftSpheres, go_to_seats_alone_when_loose) {
  // Eight balls stand in the corners of a cube, held by its walls and each other; one is loose in the middle.
  const Shape cube = box(4.05, 4.05, 4.05);
  std::vector<Vector3> centre{{0, 0, 2.025}};
  std::vector<double> factor{0.65}; // .73 would meet all eight
  for (const double x : {-1.02, 1.02})
    for (const double y : {-1.02, 1.02})
      for (const double z : {1.005, 3.045})
        centre.push_back({x, y, z}), factor.push_back(1.021);
  SoftSpheres soft({cube, false}, centre, factor);
  soft.relax(1e-4, 0, 20000);
  Random random(2);
  EXPECT_EQ(soft.seat_loose_spheres(1e-4, random), 1u);
  soft.relax(1e-3, 0, 20000);
  const std::vector<Vector3> at = soft.centres();
  std::size_t loose = 0, touched = 0;
  while (soft.factor()[loose] != 0.65)
    ++loose;
  for (std::size_t i = 0; i < at.size(); ++i)
    touched += i != loose && norm(at[i] - at[loose]) < soft.factor()[i] + 0.65 ? 1 : 0;
  EXPECT_GE(touched, 3u);
}

TEST(Packings, repeat_bit_for_bit_from_their_seed_on_any_number_of_threads) {
  const auto packings = [](int threads, std::uint64_t seed) {
    const ThreadLimit limit(threads);
    return std::vector<Specimen>{
        advancing_front(cylinder(5, 10), uniform_radii_of_spread(0.45, 2.0 / 3), seed),
        random_close_packing_of(box(10, 10, 17), 1100, 0.5, seed), // three blocks of rows
        periodic_close_packing(box(1, 1, 1.2), 600, 0.5, seed),
        tiled_close_packing(cylinder(8, 16), 1, 0.3, 200, seed)};
  };
  const auto one = packings(1, 6), three = packings(3, 6), other = packings(3, 7);
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_TRUE(same_bytes(one[k], three[k])) << k;
    EXPECT_NE(one[k].centre[0].x, other[k].centre[0].x) << k;
  }
}

} // namespace
} // namespace platen::dem::packing_soft_test
