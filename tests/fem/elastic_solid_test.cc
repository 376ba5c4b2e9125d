#include "fem/elastic_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "fem/threads.h"

namespace platen::fem {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr Material steel{7850, 210e9, 0.3};
constexpr Material pad{1200, 50e6, 0.3};

Grid plate() {
  return make_grid(BoxPlate{{-0.02, -0.03, 0}, {0.04, 0.03, 0.02}, {3, 3, 2}});
}

// Push, shear and tilt on the low end, uneven in place.
std::vector<Point> uneven_loads(const ElasticSolid &solid, double size) {
  std::vector<Point> loads(solid.surface().vertices.size(), Point{});
  for (std::size_t f = 0; f < solid.surface().faces.size(); ++f)
    if (solid.surface().face_tags[f] == low_end_tag)
      for (const int v : solid.surface().faces[f]) {
        const Point &p = solid.surface().vertices[static_cast<std::size_t>(v)];
        loads[static_cast<std::size_t>(v)] = loads[static_cast<std::size_t>(v)] +
                                             size * Point{0.2, -0.1 + 3 * p[0], 1 + 10 * p[0] - 20 * p[1]};
      }
  return loads;
}

void put(ElasticSolid &solid, const std::vector<Point> &loads) {
  solid.clear_loads();
  for (std::size_t v = 0; v < loads.size(); ++v)
    if (norm(loads[v]) > 0) solid.add_surface_force(static_cast<int>(v), loads[v]);
}

double total(const BodyBook &b) {
  return b.kinetic + b.strain + b.dissipated - b.load_work - b.grip_work;
}

// A deformation without pattern, the same each time.
std::vector<Point> shaken(const ElasticSolid &solid, double size) {
  std::vector<Point> u(solid.model().nodes.size());
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      u[i][k] = size * std::sin(12.9898 * static_cast<double>(3 * i + k + 1) * (1 + static_cast<double>(k)));
  return u;
}

// Rod of unit length held at its high end, without sideways strain: u = cos(k z), k = pi / 2, swings with the
// period 4 L / c. Linear elements with lumped mass are too slow by (k h)^2 / 24 = 0.16 %, the step's own
// error takes part of it back.
TEST(elastic_solid, a_rod_swings_with_the_speed_of_sound) {
  for (const int degree : {1, 2}) {
    ElasticSolid rod(make_grid(BoxPlate{{0, 0, 0}, {0.1, 0.1, 1}, {1, 1, 8}}), {{2000, 8e9, 0}}, Grip{},
                     {degree});
    std::vector<Point> u(rod.model().nodes.size(), Point{});
    for (std::size_t i = 0; i < u.size(); ++i)
      u[i][2] = 1e-6 * std::cos(0.5 * pi * rod.model().nodes[i][2]);
    rod.set_deformation(u, std::vector<Point>(u.size(), Point{}));
    const double c = 2000, dt = 0.5 * rod.stable_step();
    std::size_t tip = 0;
    while (rod.model().nodes[tip][2] != 0)
      ++tip;
    double time = 0, first = 0, last = 0, before = 1e-6;
    int crossings = 0;
    while (crossings < 5) {
      rod.drift(dt, 1);
      time += dt;
      const double now = rod.deformation()[tip][2];
      if (before * now < 0) {
        last = time - dt * now / (now - before);
        if (crossings++ == 0) first = last;
      }
      before = now;
    }
    EXPECT_NEAR((last - first) / 2, 4 / c, degree == 1 ? 0.002 * 4 / c : 5e-4 * 4 / c) << degree;
  }
}

// Slender cantilever (Euler-Bernoulli): w = 1.8751^2 sqrt(E I / (rho A L^4)). Shear and the turning of
// sections take 0.4 % off at L / h = 20. Degree 2, since linear elements lock in bending.
TEST(elastic_solid, a_cantilever_swings_as_a_beam_does) {
  const double h = 0.05, e = 8e9, rho = 2000;
  ElasticSolid beam(make_grid(BoxPlate{{0, 0, 0}, {h, h, 1}, {1, 1, 10}}), {{rho, e, 0}}, Grip{}, {2});
  std::vector<Point> u(beam.model().nodes.size(), Point{});
  for (std::size_t i = 0; i < u.size(); ++i) { // the shape under a force at the tip
    const double s = 1 - beam.model().nodes[i][2];
    u[i][0] = 1e-4 * s * s * (3 - s) / 2;
    u[i][2] = 1e-4 * (beam.model().nodes[i][0] - h / 2) * (6 * s - 3 * s * s) / 2;
  }
  beam.set_deformation(u, std::vector<Point>(u.size(), Point{}));
  const std::vector<Point> shape = beam.deformation();
  const double w = 1.8751041 * 1.8751041 * std::sqrt(e * h * h / 12 / rho), dt = 0.9 * beam.stable_step();
  double time = 0, first = 0, last = 0, before = 0;
  int crossings = 0;
  while (crossings < 3) {
    beam.drift(dt, 1);
    time += dt;
    double now = 0; // how much of the shape is left: other modes have little share in it
    const std::vector<Point> now_at = beam.deformation();
    for (std::size_t i = 0; i < u.size(); ++i)
      now += beam.model().mass[i] * dot(shape[i], now_at[i]);
    if (before * now < 0) {
      last = time - dt * now / (now - before);
      if (crossings++ == 0) first = last;
    }
    before = now;
  }
  EXPECT_NEAR(last - first, 2 * pi / w, 0.008 * 2 * pi / w);
}

// However far the machine carries and turns a body: what is left is round-off of places, 1e-17 m.
TEST(elastic_solid, rigid_motion_of_any_size_stores_nothing) {
  for (const ElasticMotion kind : {ElasticMotion::explicit_steps, ElasticMotion::quasi_static}) {
    ElasticSolid solid(plate(), {steel}, Grip{}, {1, kind});
    const ElasticSolid still(plate(), {steel}, Grip{});
    const double dt = 0.3 / 64; // far larger than the stable step: nothing must be there to swing
    solid.set_velocity({3, -2, 1}, {0.5 * pi / 0.3, 0, 0});
    std::vector<Point> rate(solid.model().nodes.size(), Point{});
    solid.set_deformation(rate, rate); // inside moves with the frame
    if (kind == ElasticMotion::explicit_steps) {
      // A free inside would feel the turn's centripetal force; one step over all of it is not the test.
      // Placed:
      std::vector<double> turned = solid.state();
      ElasticSolid other(plate(), {steel}, Grip{}, {1, ElasticMotion::quasi_static});
      other.set_velocity({3, -2, 1}, {0.5 * pi / 0.3, 0, 0});
      for (int k = 0; k < 64; ++k)
        other.drift(dt);
      // Frame of the other, and every node carried with it.
      const std::vector<double> frame = other.state();
      for (std::size_t k = 8; k < 24; ++k)
        turned[k] = frame[k];
      solid.set_state(turned);
      solid.set_velocity({});
      solid.set_deformation(rate, rate);
    } else {
      for (int k = 0; k < 64; ++k)
        solid.drift(dt);
      solid.aim(std::vector<Point>(solid.surface().vertices.size(), Point{}), 0);
    }
    EXPECT_NEAR(solid.rotation()[1], std::sqrt(0.5), 1e-12); // a quarter turn about x
    EXPECT_LT(solid.book().strain, 1e-20);
    for (const Stress &s : solid.stress_of_cells())
      EXPECT_LT(von_mises(s), 1e-13 * steel.young_modulus);
    const Point moved = solid.displacement();
    EXPECT_NEAR(moved[0], 0.9, 1e-12);
    for (std::size_t v = 0; v < still.surface().vertices.size(); ++v) {
      const Point r = still.surface().vertices[v] - still.centre();
      const Point expected = still.centre() + moved + Point{r[0], -r[2], r[1]};
      EXPECT_LT(norm(solid.surface().vertices[v] - expected), 1e-13);
    }
  }
}

// Turned by a right angle first, a body bends in its own frame as it would have upright.
TEST(elastic_solid, a_turned_body_bends_as_an_upright_one) {
  ElasticSolid upright(plate(), {steel}, Grip{}, {2, ElasticMotion::quasi_static});
  ElasticSolid turned(plate(), {steel}, Grip{}, {2, ElasticMotion::quasi_static});
  turned.set_velocity({}, {0, 0.5 * pi, 0});
  turned.drift(1);
  std::vector<Point> loads = uneven_loads(upright, 1e3);
  upright.aim(loads, 0);
  for (Point &f : loads)
    f = rotated(turned.rotation(), f);
  turned.aim(loads, 0);
  const auto a = upright.deformation(), b = turned.deformation();
  double size = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    size = std::max(size, norm(a[i]));
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(norm(a[i] - b[i]), 1e-10 * size);
}

// Central differences keep their energy exactly: what is left is round-off of a thousand steps, on any step.
TEST(elastic_solid, the_book_of_a_swing_closes) {
  for (const int degree : {1, 2})
    for (const bool slides : {false, true}) {
      ElasticOptions options{degree};
      options.mass_damping = slides ? 500 : 0;
      options.stiffness_damping = slides ? 1e-8 : 0;
      Grip grip;
      grip.slides = slides;
      ElasticSolid solid(plate(), {steel}, grip, options);
      const std::vector<Point> loads = uneven_loads(solid, 1e4);
      solid.set_velocity({0, 0, -0.5});
      const double dt = 0.8 * solid.stable_step();
      solid.drift(dt, 1);
      const double start = total(solid.book());
      double largest = 0;
      for (int k = 0; k < 1000; ++k) {
        if (k == 300) solid.set_velocity({0, 0, 0.3});
        std::vector<Point> now = loads;
        for (Point &f : now)
          f = (1 + std::sin(0.1 * k)) * f;
        solid.kick(0.5 * dt);
        solid.drift(dt, 1);
        put(solid, now);
        solid.kick(0.5 * dt);
        largest = std::max(largest, solid.book().strain);
        ASSERT_NEAR(total(solid.book()), start, 1e-8 * largest) << k;
      }
      const BodyBook b = solid.book();
      EXPECT_NE(b.load_work, 0);
      EXPECT_NE(b.grip_work, 0);
      EXPECT_EQ(b.dissipated != 0, slides);
    }
}

// Loads and the machine's velocity held over a time in steps of dt and dt / 2 against far finer ones; drifts
// of one and of three steps of their own.
TEST(elastic_solid, explicit_motion_is_of_second_order) {
  for (const int inner : {1, 3}) {
    const auto run = [&](int steps) {
      ElasticSolid solid(plate(), {pad}, Grip{}, {1});
      const double end = 24 * solid.stable_step() * (inner == 1 ? 1 : 2), dt = end / steps;
      const std::vector<Point> loads = uneven_loads(solid, 10);
      solid.set_velocity({0, 0, -0.01});
      for (int k = 0; k <= steps; ++k) {
        std::vector<Point> now = loads;
        for (Point &f : now)
          f = std::pow(std::sin(2 * pi * k / steps), 2) * f;
        put(solid, now);
        if (k > 0) solid.kick(0.5 * dt);
        if (k == steps) break;
        solid.kick(0.5 * dt);
        solid.drift(dt, inner);
      }
      return solid.deformation();
    };
    const auto fine = run(2048), middle = run(256), coarse = run(128);
    double near = 0, far = 0;
    for (std::size_t i = 0; i < fine.size(); ++i)
      near += dot(middle[i] - fine[i], middle[i] - fine[i]),
          far += dot(coarse[i] - fine[i], coarse[i] - fine[i]);
    EXPECT_NEAR(0.5 * std::log2(far / near), 2.0, 0.1) << inner;
  }
}

// Shaken at random, energy stays for thousands of steps below the limit and explodes above it.
TEST(elastic_solid, the_stable_step_is_the_limit) {
  const Grid skew = moved_grid(plate(), [](const Point &p) {
    return Point{p[0] + 0.3 * p[1] * std::sin(40 * p[2]), p[1] + 5 * p[0] * p[2],
                 p[2] + 400 * p[0] * p[2] * (0.02 - p[2])};
  });
  for (const int degree : {1, 2})
    for (const bool slides : {false, true}) {
      Grip grip;
      grip.slides = slides;
      const auto growth = [&](double share) {
        ElasticSolid solid(skew, {steel}, grip, {degree});
        const std::vector<Point> none(solid.model().nodes.size(), Point{});
        solid.set_deformation(none, shaken(solid, 1e-3));
        const double start = solid.kinetic_energy(), dt = share * solid.stable_step();
        for (int k = 0; k < 3000; ++k)
          solid.drift(dt, 1);
        return solid.kinetic_energy() / start;
      };
      EXPECT_LT(growth(0.95), 3) << degree;
      EXPECT_FALSE(growth(1.05) < 1e6) << degree;
      const ElasticSolid solid(skew, {steel}, grip, {degree});
      const double by_cells = 2 / std::sqrt(solid.model().cell_bound);
      EXPECT_LE(by_cells, solid.stable_step());
      EXPECT_GT(by_cells, 0.5 * solid.stable_step());
      EXPECT_EQ(solid.substeps(10 * solid.stable_step()), 12);
    }
}

TEST(elastic_solid, a_free_body_keeps_its_momentum) {
  Grip none;
  none.tag = no_grip;
  ElasticSolid solid(plate(), {steel}, none, {2});
  const std::vector<Point> u = shaken(solid, 1e-7);
  solid.set_deformation(u, shaken(solid, 1e-2));
  const Point start = solid.momentum();
  const double size = std::sqrt(2 * solid.mass() * solid.kinetic_energy()), dt = 0.9 * solid.stable_step();
  for (int k = 0; k < 1000; ++k)
    solid.drift(dt, 1);
  EXPECT_LT(norm(solid.momentum() - start), 1e-11 * size); // round-off of a thousand steps
  EXPECT_THROW(solid.set_velocity({1, 0, 0}), std::logic_error);
}

// Momentum gained = loads less what the grip takes, step by step; and what it takes at rest is the loads.
TEST(elastic_solid, the_grip_bears_what_the_loads_give) {
  ElasticOptions options{1};
  options.mass_damping = 2e4;
  ElasticSolid solid(plate(), {steel}, Grip{}, options);
  put(solid, uneven_loads(solid, 1e4));
  const double dt = 0.9 * solid.stable_step();
  for (int k = 0; k < 4000; ++k) {
    solid.kick(0.5 * dt), solid.drift(dt, 1), solid.kick(0.5 * dt);
  }
  const double size = norm(solid.total_force());
  EXPECT_LT(norm(solid.grip_force() - solid.total_force()), 1e-9 * size);
  EXPECT_LT(norm(solid.grip_moment() - solid.moment(solid.centre())), 1e-6 * norm(solid.grip_moment()));
  // Quasi-static: the same shape, and the strain energy is half of what the loads would do at full size.
  ElasticSolid slow(plate(), {steel}, Grip{}, {1, ElasticMotion::quasi_static});
  const std::vector<Point> loads = uneven_loads(slow, 1e4);
  put(slow, loads);
  slow.aim(loads, 0);
  const auto a = solid.deformation(), b = slow.deformation();
  double largest = 0;
  for (const Point &p : b)
    largest = std::max(largest, norm(p));
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_LT(norm(a[i] - b[i]), 1e-8 * largest);
  const BodyBook book = slow.book();
  EXPECT_NEAR(book.load_work, 2 * book.strain, 1e-10 * book.strain);
  EXPECT_NEAR(total(book), 0, 1e-10 * book.strain);
  EXPECT_LT(norm(slow.grip_force() - slow.total_force()), 1e-12 * size);
}

TEST(elastic_solid, a_quasi_static_body_goes_evenly_to_its_shape) {
  for (const LinearSolver kind : {LinearSolver::direct, LinearSolver::multigrid}) {
    ElasticOptions options{2, ElasticMotion::quasi_static};
    options.solver = kind;
    ElasticSolid solid(plate(), {steel}, Grip{}, options), at_once(plate(), {steel}, Grip{}, options);
    const std::vector<Point> loads = uneven_loads(solid, 1e4);
    at_once.aim(loads, 0);
    solid.set_velocity({0, 0, -0.1});
    solid.aim(loads, 1e-5);
    EXPECT_EQ(solid.solver_kind(), kind);
    const double dt = 1e-6;
    for (int k = 0; k < 10; ++k) {
      const auto before = solid.surface().vertices;
      put(solid, loads);
      solid.kick(0.5 * dt), solid.drift(dt), solid.kick(0.5 * dt);
      for (std::size_t v = 0; v < before.size(); ++v) // velocities are those of the way
        EXPECT_LT(norm(solid.surface().vertices[v] - before[v] - dt * solid.surface().velocities[v]), 1e-16);
      EXPECT_LE(solid.last_move(), solid.largest_move(dt) * (1 + 1e-9));
    }
    const auto a = solid.deformation(), b = at_once.deformation();
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_LT(norm(a[i] - b[i]), 1e-16);
    EXPECT_NEAR(solid.book().strain, at_once.book().strain, 1e-10 * at_once.book().strain);
    EXPECT_NEAR(total(solid.book()), 0, 1e-9 * solid.book().strain);
    solid.drift(dt); // there: only the machine moves it
    for (const Point &v : solid.surface().velocities)
      EXPECT_EQ(v, (Point{0, 0, -0.1}));
  }
}

// On an elastic ground that is tilted, the free seat turns the plate until the ground pushes without moment:
// the plate lies as the ground does, but for the third of a percent that its face shifts sideways.
TEST(elastic_solid, a_free_seat_turns_until_the_moment_is_gone) {
  for (const ElasticMotion kind : {ElasticMotion::explicit_steps, ElasticMotion::quasi_static}) {
    Grip grip;
    grip.turns = true;
    grip.seat = {0.01, 0, 0.02};
    grip.inertia = 1e-4;
    grip.damping = 3000;
    ElasticOptions options{1, kind};
    if (kind == ElasticMotion::explicit_steps) options.mass_damping = 3000;
    ElasticSolid solid(make_grid(BoxPlate{{-0.02, -0.03, 0}, {0.04, 0.03, 0.02}, {2, 2, 1}}), {steel}, grip,
                       options);
    const double stiffness = 1e7, slope = 2e-3, sink = 1e-4, dt = 1e-6;
    const auto press = [&] {
      solid.clear_loads();
      for (std::size_t v = 0; v < solid.surface().vertices.size(); ++v) {
        const Point &p = solid.surface().vertices[v];
        if (std::abs(p[2]) > 5e-3) continue;
        solid.add_surface_force(static_cast<int>(v),
                                {0, 0, stiffness * (sink + slope * (p[0] - 0.01) - p[2])});
      }
    };
    press();
    const double moment_at_start = norm(solid.moment(solid.centre()));
    EXPECT_GT(moment_at_start, 1);
    for (int k = 0; k < 20000; ++k) {
      solid.kick(0.5 * dt), solid.drift(dt);
      press();
      solid.kick(0.5 * dt);
      if (kind == ElasticMotion::quasi_static && k % 50 == 49) solid.aim(solid.contact_loads(), 50 * dt);
    }
    EXPECT_LT(norm(solid.moment(solid.centre())), 1e-6 * moment_at_start);
    const Point normal = rotated(solid.rotation(), {0, 0, 1});
    EXPECT_NEAR(-normal[0] / normal[2], slope, 5e-3 * slope);
    EXPECT_NEAR(normal[1], 0, 1e-9);
    EXPECT_NEAR(norm(solid.displacement()), 0, 1e-15); // the seat is held
    EXPECT_NEAR(solid.grip_force()[2], solid.total_force()[2], 1e-6 * solid.total_force()[2]);
  }
}

// Free to turn and not pushed, a body on its seat keeps its angular momentum about it.
TEST(elastic_solid, a_body_on_its_seat_keeps_its_angular_momentum) {
  Grip grip;
  grip.turns = true;
  grip.seat = {0.01, 0.005, 0.03};
  grip.inertia = 1e-4;
  ElasticSolid solid(plate(), {steel}, grip, {1});
  const std::vector<Point> none(solid.model().nodes.size(), Point{});
  solid.set_velocity({}, {20, -10, 30});
  solid.set_deformation(none, shaken(solid, 1e-2));
  const Point start = solid.angular_momentum();
  const double dt = 0.8 * solid.stable_step();
  solid.drift(dt, 1);
  const double energy = total(solid.book());
  for (int k = 0; k < 4000; ++k)
    solid.drift(dt, 1);
  EXPECT_LT(norm(solid.angular_momentum() - start), 1e-10 * norm(start));
  EXPECT_NEAR(total(solid.book()), energy, 1e-4 * energy); // order dt^2 w^2 where it turns
}

// Greased, a pressed plate widens at its grip as anywhere and bears no shear there; glued, it cannot.
TEST(elastic_solid, a_greased_grip_lets_the_plate_widen) {
  for (const bool slides : {true, false}) {
    Grip grip;
    grip.slides = slides;
    ElasticSolid solid(plate(), {steel}, grip, {1, ElasticMotion::quasi_static});
    const double p = 1e8;
    std::vector<Point> loads(solid.surface().vertices.size(), Point{});
    for (std::size_t f = 0; f < solid.surface().faces.size(); ++f)
      if (solid.surface().face_tags[f] == low_end_tag)
        for (const int v : solid.surface().faces[f])
          loads[static_cast<std::size_t>(v)] =
              loads[static_cast<std::size_t>(v)] - 0.25 * p * face_area_vector(solid.surface(), f);
    solid.aim(loads, 0);
    double shear = 0;
    for (const Stress &s : solid.stress_of_cells())
      shear = std::max({shear, std::abs(s[0]), std::abs(s[1]), std::abs(s[3]), std::abs(s[4])});
    if (slides)
      EXPECT_LT(shear, 1e-9 * p);
    else
      EXPECT_GT(shear, 0.1 * p);
  }
}

TEST(elastic_solid, any_number_of_threads_gives_the_same_bits) {
  std::vector<std::vector<double>> ends;
  for (const int threads : {1, 2, 4}) {
    limit_threads(threads);
    ElasticSolid solid(make_grid(CylinderPlate{0.03, 0.02, 0, 12, 3}), {steel}, Grip{}, {2});
    put(solid, uneven_loads(solid, 1e4));
    const double dt = 2 * solid.stable_step();
    for (int k = 0; k < 5; ++k)
      solid.kick(0.5 * dt), solid.drift(dt), solid.kick(0.5 * dt);
    ends.push_back(solid.state());
  }
  limit_threads(0);
  for (std::size_t k = 0; k < ends[0].size(); ++k) {
    ASSERT_EQ(ends[0][k], ends[1][k]) << k;
    ASSERT_EQ(ends[0][k], ends[2][k]) << k;
  }
}

TEST(elastic_solid, goes_on_from_its_state_to_the_last_bit) {
  for (const ElasticMotion kind : {ElasticMotion::explicit_steps, ElasticMotion::quasi_static}) {
    Grip grip;
    grip.turns = true;
    grip.seat = {0.01, 0, 0.02};
    grip.inertia = 1e-4;
    const auto make = [&] { return ElasticSolid(plate(), {steel}, grip, {1, kind}); };
    ElasticSolid solid = make();
    const std::vector<Point> loads = uneven_loads(solid, 1e4);
    const double dt = 3e-7;
    const auto go = [&](ElasticSolid &body, int first, int last) {
      for (int k = first; k < last; ++k) {
        if (kind == ElasticMotion::quasi_static && k % 10 == 0) body.aim(body.contact_loads(), 10 * dt);
        body.kick(0.5 * dt), body.drift(dt);
        body.clear_loads();
        for (std::size_t v = 0; v < loads.size(); v += 3)
          body.add_surface_force(static_cast<int>(v),
                                 std::cos(k) * loads[v] - 1e3 * body.surface().velocities[v]);
        body.kick(0.5 * dt);
      }
    };
    solid.set_velocity({0, 0, -0.2});
    go(solid, 0, 27);
    ElasticSolid other = make();
    put(other, loads);
    other.set_state(solid.state());
    EXPECT_EQ(other.state(), solid.state());
    EXPECT_EQ(other.surface().vertices, solid.surface().vertices);
    EXPECT_EQ(other.surface().velocities, solid.surface().velocities);
    go(solid, 27, 60), go(other, 27, 60);
    EXPECT_EQ(other.state(), solid.state());
    EXPECT_EQ(other.book().strain, solid.book().strain);
    EXPECT_THROW(other.set_state({1, 2, 3}), std::invalid_argument);
  }
}

TEST(elastic_solid, the_picture_names_its_fields_and_repeats) {
  for (const int degree : {1, 2}) {
    ElasticSolid solid(make_grid(BoxPlate{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}, {{0.5, 1}, {0.5, 1}}),
                       {pad, steel}, Grip{}, {degree, ElasticMotion::quasi_static});
    const std::vector<Point> loads = uneven_loads(solid, 1e3);
    put(solid, loads);
    solid.aim(loads, 0);
    std::ostringstream first, second;
    solid.write_vtu(first);
    solid.write_vtu(second, std::vector<double>(loads.size(), 0.0));
    for (const char *field : {"displacement", "stress", "von_mises", "contact_pressure", "contact_shear",
                              "slip", "compressor=\"vtkZLib"})
      EXPECT_NE(first.str().find(field), std::string::npos) << field;
    EXPECT_EQ(first.str(), second.str());
    EXPECT_THROW(solid.write_vtu(first, {1.0}), std::invalid_argument);
  }
}

TEST(elastic_solid, grips_that_cannot_hold_are_refused) {
  const auto refused = [](Grip grip, ElasticOptions options = {}) {
    EXPECT_THROW(ElasticSolid(plate(), {steel}, grip, options), std::invalid_argument);
  };
  Grip grip;
  grip.tag = 77;
  refused(grip);
  grip = {};
  grip.slides = grip.turns = true;
  refused(grip);
  grip = {};
  grip.tag = no_grip;
  refused(grip, {1, ElasticMotion::quasi_static});
  grip = {};
  grip.inertia = 1; // no seat that it could belong to
  refused(grip);
  refused({}, {1, ElasticMotion::quasi_static, 1.0});
  refused({}, {1, ElasticMotion::explicit_steps, -1.0});
  ElasticSolid solid(plate(), {steel}, Grip{});
  EXPECT_THROW(solid.aim(solid.contact_loads(), 0), std::logic_error);
}

} // namespace
} // namespace platen::fem
