// Contacts between unbonded spheres against closed forms of impact, friction and rolling; impacts by Hertz
// are in tests/coupling/impact_test.cc.
#include "dem/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "dem/laws/hertz_contact.h"
#include "tests/dem/examples.h"

namespace platen::dem::contact_test {
namespace {

using namespace examples;

struct Impact {
  double max_overlap = 0, contact_time = 0, rebound = 0; // m, s, relative speed after over before
};

// Two spheres meet head on at relative speed v.
Impact impact(Model &model, double v, double dt) {
  Particles &p = model.particles;
  p.velocity[0].x = .5 * v, p.velocity[1].x = -.5 * v;
  Impact result;
  int touched = 0;
  for (int s = 0; s < 1000000; ++s) {
    step(model, dt);
    const double overlap = p.radius[0] + p.radius[1] - norm(p.position[1] - p.position[0]);
    result.max_overlap = std::max(result.max_overlap, overlap);
    if (overlap > 0)
      ++touched;
    else if (touched > 0)
      break;
  }
  result.contact_time = touched * dt;
  result.rebound = (p.velocity[1].x - p.velocity[0].x) / v;
  return result;
}

// Without attraction: e = exp(-(xi/w)(pi - atan(2 xi w/(1 - 2 xi^2)))), w = sqrt(1 - xi^2), xi < 1/sqrt(2)
// (Schwager and Poeschel 2007, Granular Matter 9:465).
TEST(contact, linear_impact_is_that_of_a_damped_oscillator) {
  for (const double xi : {0.0, .1, .2, .5}) {
    const double w = std::sqrt(1 - xi * xi), v = .2;
    const double expected = std::exp(-(xi / w) * (pi - std::atan2(2 * xi * w, 1 - 2 * xi * xi)));
    ModelSettings settings = unbonded(NormalContact::linear, TangentialContact::none, 1e6);
    settings.contact->damping = xi;
    Model model(pair_of(), settings);
    const double omega = std::sqrt(1e6 / (.5 * model.particles.mass[0]));
    const Impact i = impact(model, v, pi / omega / 5000);
    EXPECT_NEAR(i.rebound, expected, 2e-3) << xi;
    const double lost = .25 * model.particles.mass[0] * v * v * (1 - i.rebound * i.rebound);
    EXPECT_NEAR(model.contacts->damping_work, lost, 2e-3 * lost + 1e-12);
    if (xi > 0) continue;
    EXPECT_NEAR(i.max_overlap, v / omega, 1e-6 * v / omega);
    EXPECT_NEAR(i.contact_time, pi / omega, 1e-3 * pi / omega);
  }
}

// kap = E/(3(1 - 2 nu)); f kap_i R_i kap_j R_j/(kap_i R_i + kap_j R_j).
TEST(contact, a_fraction_of_the_bulk_stiffness_is_what_it_says) {
  ContactSettings s;
  s.stiffness = {Stiffness::Kind::of_bulk, .01};
  s.young_modulus = 17e9, s.poisson_ratio = .15;
  EXPECT_NEAR(s.coefficient(1e-3, 1e-3, {}), .01 * 8.0952381e9 * 1e-3 / 2, 1e-2);
}

TEST(contact, spheres_that_overlap_from_the_start_are_at_rest) {
  Model model(spheres({{0, 0, 0}, {1.5 * radius, 0, 0}, {.2 * radius, 1.1 * radius, 0}}),
              unbonded(NormalContact::linear, TangentialContact::coulomb, 1e6));
  step(model, 1e-7, 100);
  EXPECT_EQ(kinetic_energy(model.particles), 0);
  model.particles.velocity[1].x = -1e-3; // and push once they are pressed further
  step(model, 1e-7, 10);
  EXPECT_GT(model.contacts->energy(), 0);
}

// Pressed by N, the second is pushed aside: k_t u, half of k u, up to mu N.
TEST(contact, sliding_starts_at_the_coulomb_limit) {
  const double mu = .4, k = 1e8, press = 1e-4 * radius; // N/m, m: the plane turns by 4e-5 until sliding
  ModelSettings settings = unbonded(NormalContact::linear, TangentialContact::coulomb, k);
  settings.contact->friction = mu;
  Model model(pair_of(), settings);
  move_pair(model, {-press, 0, 0});
  const Contacts &c = *model.contacts;
  const double pressing = c.coefficient[0] * c.overlap[0], onset = mu * pressing / (.5 * k); // N, m
  ASSERT_NEAR(pressing, k * press, 1e-4 * k * press);
  for (const double share : {.3, .6, .999}) {
    move_pair(model, {0, share * onset - (*c.spring)[0].y / (.5 * k), 0});
    EXPECT_NEAR((*c.spring)[0].y, share * mu * pressing, 1e-3 * mu * pressing);
    EXPECT_FALSE((*c.sliding)[0]) << share;
  }
  for (const double more : {.002, .5}) {
    move_pair(model, {0, more * onset, 0});
    EXPECT_NEAR(norm((*c.spring)[0]), mu * c.coefficient[0] * c.overlap[0], 1e-9 * mu * pressing);
    EXPECT_TRUE((*c.sliding)[0]) << more;
  }
  EXPECT_NEAR(model.particles.force[0].y, mu * pressing, 1e-3 * mu * pressing);
}

// Two grains pressed on each other, the second pushed aside without sliding, then a quarter turn of the pair
// as one about the line of their centres and one about an axis across it: the spring of friction and the
// rolling moment lie as they did in the pair, and nothing is lost.
TEST(contact, friction_and_rolling_springs_turn_with_the_pair) {
  for (const Vector3 &axis : {Vector3{1, 0, 0}, Vector3{0, 0, 1}, Vector3{0, 1, 0}}) {
    ModelSettings settings = unbonded(NormalContact::linear, TangentialContact::coulomb_with_rolling, 1e6);
    settings.contact->friction = settings.contact->rolling_friction = 0.5;
    Model model(pair_of(), settings);
    Particles &p = model.particles;
    const double press = 1e-2 * radius;
    move_pair(model, {-press, 0, 0});
    move_pair(model, {0, 1e-3 * radius, 0}, {}, {0, 1e-3, 0});
    ASSERT_EQ(model.contacts->table.size(), 1u);
    const Vector3 spring = (*model.contacts->spring)[0], rolling = (*model.contacts->rolling)[0];
    ASSERT_GT(norm(spring), 0);
    ASSERT_GT(norm(rolling), 0);
    const double lost = model.contacts->friction_work;
    const int steps = 20000;
    const Quaternion step = rotation_quaternion(0.5 * pi / steps * axis),
                     whole = rotation_quaternion(0.5 * pi * axis);
    for (int k = 0; k < steps; ++k) {
      const Vector3 d = p.position[1] - p.position[0], turn = 0.5 * pi / steps * axis;
      move_pair(model, rotate(step, d) - d, turn, turn);
    }
    const Vector3 wanted = rotate(whole, spring), wanted_moment = rotate(whole, rolling);
    EXPECT_LT(norm((*model.contacts->spring)[0] - wanted), 1e-4 * norm(spring)) << axis.x << axis.y << axis.z;
    EXPECT_LT(norm((*model.contacts->rolling)[0] - wanted_moment), 1e-4 * norm(rolling))
        << axis.x << axis.y << axis.z;
    EXPECT_NEAR(model.contacts->friction_work, lost, 1e-4 * model.contacts->energy());
  }
}

// Springs and dashpots together: a contact that is not pressed does not drag.
TEST(contact, friction_never_exceeds_its_limit) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz})
    for (const bool damped : {false, true}) {
      ModelSettings settings = unbonded(normal, TangentialContact::coulomb, 1e6);
      settings.contact->friction = .3;
      settings.contact->damping = damped ? .3 : 0;
      settings.contact->restitution = damped ? .4 : 1;
      Random random(2);
      Model model(cubic(5, 5, 5, 2.05), settings);
      const Particles &p = model.particles;
      for (Vector3 &v : model.particles.velocity)
        v = 2 * random.direction();
      std::size_t held = 0;
      for (int s = 0; s < 2000; ++s) {
        step(model, 2e-7);
        const Contacts &c = *model.contacts;
        for (std::size_t k = 0; k < c.table.size(); ++k) {
          if (!c.touching[k]) continue;
          const Vector3 d = p.position[c.second[k]] - p.position[c.first[k]];
          const Vector3 n = d / norm(d);
          const double pressing = -dot(c.force[k], n), elastic = c.coefficient[k] * c.overlap[k];
          const Vector3 tangential = c.force[k] + pressing * n;
          ASSERT_GE(pressing, -1e-12 * elastic); // no attraction
          ASSERT_LE(norm(tangential), .3 * pressing * (1 + 1e-12) + 1e-12 * elastic);
          ASSERT_LE(std::abs(dot((*c.spring)[k], n)), 1e-12 * pressing + 1e-12 * elastic);
          ++held;
        }
      }
      EXPECT_GT(held, 1000u);
    }
}

// Oblique impact that slides throughout: the tangential impulse is mu times the normal one, 2 m* v_n.
TEST(contact, gross_sliding_turns_impulse_into_spin) {
  const double mu = .3, vn = .1, vt = 1;
  // So stiff that the normal turns by 1e-4 while they touch.
  ModelSettings settings = unbonded(NormalContact::linear, TangentialContact::coulomb, 1e9);
  settings.contact->friction = mu;
  Model model(pair_of(), settings);
  Particles &p = model.particles;
  p.velocity[0] = {.5 * vn, -.5 * vt, 0}, p.velocity[1] = {-.5 * vn, .5 * vt, 0};
  const double before = kinetic_energy(p), duration = pi * std::sqrt(.5 * p.mass[0] / 1e9);
  step(model, duration / 2000, 4000);
  ASSERT_EQ(model.contacts->touching_count(), 0u);
  const double impulse = p.mass[0] * vn;
  EXPECT_NEAR(p.velocity[1].x, .5 * vn, 5e-3 * vn);
  EXPECT_NEAR(p.velocity[1].y, .5 * vt - mu * impulse / p.mass[1], 1e-3 * vn);
  for (std::size_t i = 0; i < 2; ++i) // both surfaces are dragged along: the same sense of spin
    EXPECT_NEAR((*p.angular_velocity)[i].z, mu * impulse * radius / (*p.inertia)[i],
                2e-3 * mu * impulse * radius / (*p.inertia)[i]);
  EXPECT_NEAR(model.contacts->friction_work, before - kinetic_energy(p),
              1e-3 * model.contacts->friction_work);
}

TEST(contact, friction_work_is_the_kinetic_energy_lost) {
  for (const NormalContact normal : {NormalContact::linear, NormalContact::hertz})
    for (const double vt : {.05, .2, .6}) { // sticks throughout, sticks and slides, slides
      ModelSettings settings = unbonded(normal, TangentialContact::coulomb, 1e8);
      settings.contact->friction = .3;
      Model model(pair_of(radius, 2 * radius), settings);
      Particles &p = model.particles;
      p.velocity[0] = {.2, -vt, .03}, p.velocity[1] = {-.1, .5 * vt, 0};
      (*p.angular_velocity)[0] = {20, 10, -5};
      const double before = kinetic_energy(p);
      step(model, 1e-9, 40000);
      ASSERT_EQ(model.contacts->touching_count(), 0u);
      EXPECT_GE(model.contacts->friction_work, 0);
      EXPECT_NEAR(model.contacts->friction_work, before - kinetic_energy(p), 1e-3 * before) << vt;
    }
}

// Of unequal spheres: k_t R*^2 a radian, up to mu_r R* N.
TEST(contact, a_rolling_moment_is_that_of_the_effective_radius) {
  const double k = 1e6, ratio = .4, mu = .3, small = .5 * radius,
               effective = radius * small / (radius + small);
  ModelSettings settings = unbonded(NormalContact::linear, TangentialContact::coulomb_with_rolling, k);
  settings.contact->friction = 1, settings.contact->rolling_friction = mu;
  settings.contact->tangential_ratio = ratio;
  Model model(pair_of(radius, small), settings);
  const double press = 1e-2 * radius, angle = 1e-4;
  move_pair(model, {-press, 0, 0});
  move_pair(model, {}, {}, {0, angle, 0});
  const double stiffness = ratio * k * effective * effective;
  ASSERT_EQ(model.contacts->table.size(), 1u);
  EXPECT_NEAR((*model.contacts->rolling)[0].y, stiffness * angle, 1e-9 * stiffness * angle);
  EXPECT_NEAR((*model.contacts->rolling_stiffness)[0], stiffness, 1e-12 * stiffness);
  move_pair(model, {}, {}, {0, 1, 0});
  const double most = mu * effective * k * (press - 1.5e-9 * radius);
  EXPECT_NEAR((*model.contacts->rolling)[0].y, most, 1e-9 * most);
}

TEST(contact, rolling_resistance_stops_a_gear_pair_in_time_and_without_it_the_pair_rolls_freely) {
  const double pressing = 5, rolling = .02, k = 1e7, spin = 200, dt = 1e-7;
  for (const TangentialContact law : {TangentialContact::coulomb_with_rolling, TangentialContact::coulomb}) {
    ModelSettings settings = unbonded(NormalContact::linear, law, k);
    settings.contact->friction = .5;
    settings.contact->rolling_friction = rolling;
    Model model(spheres({{0, 0, 0}, {2 * radius, 0, 0}}), settings);
    Particles &p = model.particles;
    for (std::size_t i = 0; i < 2; ++i) { // overlap in balance with the pressing force
      p.position[i].x += (i == 0 ? .5 : -.5) * pressing / k;
      (*p.angular_velocity)[i].z = i == 0 ? -spin : spin;
      p.force[i].x = 0;
    }
    const double deceleration = rolling * .5 * radius * pressing / (*p.inertia)[0],
                 before = kinetic_energy(p);
    const int until = static_cast<int>(.5 * spin / deceleration / dt);
    const auto run = [&](int steps) {
      for (int s = 0; s < steps; ++s)
        step(model, dt, [&](Particles &q) { q.force[0].x += pressing, q.force[1].x -= pressing; });
      return (*p.angular_velocity)[1].z;
    };
    if (law == TangentialContact::coulomb) {
      EXPECT_NEAR(run(20000), spin, 1e-6 * spin);
      continue;
    }
    EXPECT_NEAR(run(until), .5 * spin, 5e-3 * spin); // the rolling spring takes a moment to load
    EXPECT_LT(std::abs(run(2 * until)), .02 * spin);
    EXPECT_NEAR(model.contacts->friction_work + model.contacts->energy() - .5 * pressing * pressing / k +
                    kinetic_energy(p),
                before, 1e-2 * before);
  }
}

// m, a place of a sphere's centre whose square is below that of the distance though its root is not: spheres
// that touch there overlap by exactly nothing.
Vector3 at_no_overlap(double distance) {
  for (int k = 1; k < 100000; ++k) {
    Vector3 at{0, 1e-7 * k * distance, 0};
    at.x = std::sqrt(distance * distance - at.y * at.y);
    for (int ulp = 0; ulp < 3; ++ulp, at.x = std::nextafter(at.x, 0.0)) {
      const double square = at.x * at.x + at.y * at.y + at.z * at.z;
      if (square < distance * distance && std::sqrt(square) == distance) return at;
    }
  }
  return {};
}

// There Hertz' springs are not stiff at all: what the tangential one held is lost, and no more.
TEST(contact, hertz_at_an_overlap_of_exactly_nothing_loses_what_its_spring_held) {
  ModelSettings settings = unbonded(NormalContact::hertz, TangentialContact::coulomb, 0);
  settings.contact->friction = .5;
  settings.contact->restitution = 1;
  Model model(pair_of(), settings);
  Particles &p = model.particles;
  const auto place = [&](const Vector3 &to) {
    p.position[0] = Vector3{}, p.position[1] = to;
    move_pair(model, {});
  };
  const double press = 5e-6, rest = p.radius[0] + p.radius[1];
  place({rest - press, 0, 0});
  move_pair(model, {0, 1e-7, 0});
  ASSERT_EQ(model.contacts->table.size(), 1u);
  ASSERT_GT((*model.contacts->spring)[0].y, 0);
  ASSERT_EQ(static_cast<double>(model.contacts->friction_work), 0);
  const double held =
      norm_squared((*model.contacts->spring)[0]) / (2 * (*model.contacts->tangential_stiffness)[0]);
  const Vector3 there = at_no_overlap(model.contacts->rest_distance[0]);
  ASSERT_GT(there.x, 0);
  place(there);
  ASSERT_EQ(model.contacts->touching[0], 1);
  ASSERT_EQ(model.contacts->overlap[0], 0);
  EXPECT_NEAR(model.contacts->friction_work, held, 1e-9 * held);
  EXPECT_EQ(model.contacts->energy(), 0);
  place({rest + press, 0, 0});
  EXPECT_NEAR(model.contacts->friction_work, held, 1e-9 * held);
}

// What slides and rolls without a tangential stiffness, pressed, let go by its dashpot, and pressed again.
TEST(contact, without_a_tangential_stiffness_nothing_is_lost_to_friction) {
  for (const TangentialContact tangential :
       {TangentialContact::coulomb, TangentialContact::coulomb_with_rolling}) {
    ModelSettings settings = unbonded(NormalContact::linear, tangential, 1e7);
    settings.contact->friction = .5;
    settings.contact->rolling_friction = .1;
    settings.contact->tangential_ratio = 0;
    settings.contact->damping = .3;
    Model model(pair_of(), settings);
    Particles &p = model.particles;
    p.velocity[1] = {-.2, .1, 0};
    (*p.angular_velocity)[0].z = 50;
    step(model, 2e-7, 3000);
    EXPECT_GT(p.velocity[1].x - p.velocity[0].x, 0); // they have parted
    EXPECT_EQ(static_cast<double>(model.contacts->friction_work), 0);
    EXPECT_TRUE(std::isfinite(model.energy().residual()));
  }
}

} // namespace
} // namespace platen::dem::contact_test
