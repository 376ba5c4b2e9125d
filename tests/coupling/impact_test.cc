// The eight impacts that Chung and Ooi (2011, Granular Matter 13:643) ask of a program of discrete elements,
// each against its closed form: Hertz (1882) for what is elastic and straight; for what slides through the
// whole contact the impulses of a rigid body, J_n = m* (1 + e) v_n and J_t = mu J_n, which turn a sphere by
// R J_t / I. Materials, sizes and speeds of the first four are those that DEM programs publish with their
// runs of these tests; those of the last four are our own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sphere_scene.h"

#include "base/pi.h"
#include "dem/model.h"
#include "tests/measured.h"

namespace platen::coupling::impact_test {
namespace {

constexpr int row = 50; // of tests/verification/rows.json

struct Material {
  double young_modulus, poisson_ratio, density; // Pa, 1, kg/m^3
};
constexpr Material glass{48e9, 0.20, 2800}, limestone{20e9, 0.25, 2500}, aluminium{70e9, 0.30, 2699},
    magnesium{40e9, 0.35, 1800}, oxide{380e9, 0.23, 4000}, cast_iron{100e9, 0.25, 7000};

struct Motion {
  Vector3 velocity, spin; // m/s, rad/s
};

struct Impact {
  std::vector<Motion> after; // of each sphere
  double deepest = 0;        // m
  double duration = 0;       // s
  double largest_force = 0;  // N
  double friction_work = 0;  // J
};

// Share of critical damping that gives the restitution e where the force is not held at zero.
double damping_of(double e) {
  return -std::log(e) / std::hypot(std::log(e), pi);
}

// m, s, of the effective mass, modulus and radius at the relative speed v.
double hertz_depth(double mass, double modulus, double radius, double v) {
  return std::pow(15 * mass * v * v / (16 * modulus * std::sqrt(radius)), 0.4);
}
constexpr double depth_to_duration = 2.9432751; // duration v / depth

double effective_modulus(const Material &m) {
  return m.young_modulus / (1 - m.poisson_ratio * m.poisson_ratio);
}

// One sphere that meets a plane at z = 0 from above.
struct OnPlane {
  Material material;
  double radius = 0, restitution = 1, friction = 0;
  dem::HertzOnPlane::Side plane{};
  int steps = 4000; // in the contact of Hertz

  Impact hit(const Motion &before) const {
    SurfaceContact contact;
    contact.hertz = dem::HertzOnPlane::between({material.young_modulus, material.poisson_ratio}, plane);
    contact.friction_static = friction;
    contact.damping = restitution < 1 ? damping_of(restitution) : 0;
    contact.skin = 0.3 * radius;
    SphereScene scene(plate(30 * radius, 4), {{0, 0, radius}}, contact, true, radius, material.density);
    dem::Particles &p = scene.particles;
    p.velocity[0] = before.velocity;
    (*p.angular_velocity)[0] = before.spin;
    const double v = -before.velocity.z, depth = hertz_depth(p.mass[0], contact.hertz->modulus, radius, v),
                 dt = depth_to_duration * depth / v / steps;
    Impact impact;
    int touched = 0;
    do {
      scene.step(dt);
      impact.deepest = std::max(impact.deepest, radius - p.position[0].z);
      impact.largest_force = std::max(impact.largest_force, -scene.load().z);
      ++touched;
    } while (p.position[0].z < radius);
    impact.duration = touched * dt;
    impact.after = {{p.velocity[0], (*p.angular_velocity)[0]}};
    impact.friction_work = scene.layer.friction_work;
    return impact;
  }
};

// Two spheres of a material whose centres lie on x, the second on the right.
struct OfTwo {
  Material material;
  double first_radius = 0, second_radius = 0, restitution = 1, friction = 0;
  int steps = 4000;

  dem::Model model() const {
    dem::Specimen two = spheres({{-first_radius, 0, 0}, {second_radius, 0, 0}});
    two.radius = {first_radius, second_radius};
    dem::ModelSettings s;
    s.density = material.density;
    s.local_damping = 0;
    s.contact = dem::ContactSettings{};
    s.contact->normal = dem::NormalContact::hertz;
    s.contact->friction = friction;
    s.contact->restitution = restitution;
    s.contact->young_modulus = material.young_modulus;
    s.contact->poisson_ratio = material.poisson_ratio;
    return dem::Model(two, s);
  }
  Impact hit(const Motion &first, const Motion &second) const {
    dem::Model two = model();
    dem::Particles &p = two.particles;
    p.velocity[0] = first.velocity, p.velocity[1] = second.velocity;
    (*p.angular_velocity)[0] = first.spin, (*p.angular_velocity)[1] = second.spin;
    const double v = first.velocity.x - second.velocity.x;
    const double depth = hertz_depth(dem::reduced(p.mass[0], p.mass[1]), 0.5 * effective_modulus(material),
                                     dem::reduced(first_radius, second_radius), v);
    const double dt = depth_to_duration * depth / v / steps;
    Impact impact;
    int touched = 0;
    double overlap = 0;
    do {
      two.begin_step(dt);
      two.compute_forces(dt);
      two.end_step(dt);
      overlap = first_radius + second_radius - norm(p.position[1] - p.position[0]);
      impact.deepest = std::max(impact.deepest, overlap);
      impact.largest_force = std::max(impact.largest_force, -p.force[0].x);
      ++touched;
    } while (overlap > 0);
    impact.duration = touched * dt;
    for (const std::size_t i : {0, 1})
      impact.after.push_back({p.velocity[i], (*p.angular_velocity)[i]});
    impact.friction_work = two.contacts->friction_work;
    return impact;
  }
};

double off(double found, double expected) {
  return std::abs(found / expected - 1);
}

void expect_hertz(const std::string &test, const Impact &impact, double mass, double modulus, double radius,
                  double v) {
  const double depth = hertz_depth(mass, modulus, radius, v);
  const double force = 4.0 / 3 * modulus * std::sqrt(radius * depth) * depth;
  measured::expect_below(row, test + "_depth", off(impact.deepest, depth), 1e-4);
  measured::expect_below(row, test + "_force", off(impact.largest_force, force), 1e-4);
  measured::expect_below(row, test + "_duration", off(impact.duration, depth_to_duration * depth / v), 1e-3);
}

TEST(impact, one_two_spheres_meet_as_hertz_says) {
  for (const Material &m : {glass, limestone})
    for (const double other : {0.01, 0.03}) {
      OfTwo two{m, 0.01, other};
      const auto mass = two.model().particles.mass;
      const Impact impact = two.hit({{10, 0, 0}, {}}, {{-10, 0, 0}, {}});
      expect_hertz("test_1", impact, dem::reduced(mass[0], mass[1]), 0.5 * effective_modulus(m),
                   dem::reduced(0.01, other), 20);
      EXPECT_NEAR(impact.after[1].velocity.x - impact.after[0].velocity.x, 20, 2e-4);
    }
}

TEST(impact, two_a_sphere_meets_a_plane_as_hertz_says) {
  for (const Material &m : {aluminium, magnesium})
    for (const bool rigid : {true, false}) {
      OnPlane one{m, 0.1};
      if (!rigid) one.plane = {m.young_modulus, m.poisson_ratio};
      const Impact impact = one.hit({{0, 0, -0.2}, {}});
      expect_hertz("test_2", impact, 4.0 / 3 * pi * 1e-3 * m.density,
                   (rigid ? 1 : 0.5) * effective_modulus(m), 0.1, 0.2);
      EXPECT_NEAR(impact.after[0].velocity.z, 0.2, 1e-5);
    }
}

// x'' = -(x^1.5 + 2 sqrt(5/6) xi sqrt(1.5 x^.5) x') in units of the undamped impact, the force at least 0 or
// not: the speed at which x comes back to zero, by a fine Runge-Kutta scheme.
double restitution_of(double fraction, bool pulls) {
  const double c = 2 * std::sqrt(5.0 / 6) * fraction;
  const auto a = [&](double x, double v) {
    if (x <= 0) return 0.0;
    const double force = x * std::sqrt(x) + c * std::sqrt(1.5 * std::sqrt(x)) * v;
    return -(pulls ? force : std::max(0.0, force));
  };
  double x = 0, v = 1;
  constexpr double h = 2e-4;
  do {
    const double a1 = a(x, v), a2 = a(x + .5 * h * v, v + .5 * h * a1);
    const double a3 = a(x + .5 * h * (v + .5 * h * a1), v + .5 * h * a2);
    const double a4 = a(x + h * (v + .5 * h * a2), v + h * a3);
    x += h * (v + h * (a1 + a2 + a3) / 6);
    v += h * (a1 + 2 * a2 + 2 * a3 + a4) / 6;
  } while (x > 0);
  return -v;
}

// A dashpot that must not pull parts the two a little faster than e.
TEST(impact, three_restitution_is_what_was_asked_for) {
  for (const Material &m : {oxide, cast_iron})
    for (const double e : {0.2, 0.4, 0.6, 0.8, 1.0}) {
      const double fraction = e < 1 ? damping_of(e) : 0;
      ASSERT_NEAR(restitution_of(fraction, true), e, 2e-3);
      const double expected = restitution_of(fraction, false);
      const double plane = OnPlane{m, 0.0025, e}.hit({{0, 0, -3.9}, {}}).after[0].velocity.z / 3.9;
      const double pair =
          OfTwo{m, 0.0025, 0.0025, e}.hit({{1.95, 0, 0}, {}}, {{-1.95, 0, 0}, {}}).after[1].velocity.x / 1.95;
      measured::expect_below(row, "test_3_plane", std::abs(plane - expected), 2e-3);
      measured::expect_below(row, "test_3_pair", std::abs(pair - expected), 2e-3);
      EXPECT_GE(plane, e - 2e-3);
    }
}

// The impulse turns the sphere by what it slows it, whatever happens in between; and it is no more than
// friction gives.
void expect_impulse(const OnPlane &sphere, const Motion &before, const Impact &impact) {
  const Motion &after = impact.after[0];
  const double e = -after.velocity.z / before.velocity.z, v = -before.velocity.z;
  const double slowed = before.velocity.x - after.velocity.x; // J_t / m
  const double turned = sphere.radius * (after.spin.y - before.spin.y);
  EXPECT_NEAR(turned, 2.5 * slowed, 5e-3 * std::abs(turned) + 1e-9); // at the arm R - overlap
  EXPECT_LE(std::abs(slowed), (1 + 1e-3) * sphere.friction * (1 + e) * v);
  EXPECT_EQ(after.velocity.y, 0);
}

// e_t = 1 - mu (1 + e) / tan(theta), omega = 5/2 mu (1 + e) v_n / R, as long as it slides to the end: for
// tan(theta) > 7/2 mu (1 + e).
void expect_sliding(const std::string &test, const OnPlane &sphere, const Motion &before) {
  const Impact impact = sphere.hit(before);
  const Motion &after = impact.after[0];
  expect_impulse(sphere, before, impact);
  const double v = -before.velocity.z, slip = before.velocity.x - sphere.radius * before.spin.y;
  const double e = after.velocity.z / v, given = sphere.friction * (1 + e) * v; // J_t / m
  if (std::abs(slip) < 3.7 * given) {
    // It rolls or swings back: less than all of friction, and no more than turns the slip round.
    EXPECT_LE(std::abs(before.velocity.x - after.velocity.x), 2 * std::abs(slip) * 2 / 7 + 1e-9);
    return;
  }
  const double way = std::copysign(given, slip);
  measured::expect_below(row, test + "_speed", std::abs(before.velocity.x - after.velocity.x - way) / given,
                         1e-3);
  measured::expect_below(row, test + "_spin",
                         std::abs(sphere.radius * (after.spin.y - before.spin.y) - 2.5 * way) / (2.5 * given),
                         5e-3);
}

OnPlane oblique() {
  return {oxide, 0.0025, 0.98, 0.092};
}

TEST(impact, four_oblique_at_one_speed_and_all_angles) {
  for (const double angle : {5, 15, 25, 32, 40, 50, 60, 70, 80, 85})
    expect_sliding("test_4", oblique(),
                   {{3.9 * std::sin(angle * degree), 0, -3.9 * std::cos(angle * degree)}, {}});
}

TEST(impact, five_oblique_at_one_normal_speed) {
  for (const double tangential : {0.2, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0})
    expect_sliding("test_5", oblique(), {{tangential, 0, -2}, {}});
}

// Backspin: it starts to roll away, and spins slower.
TEST(impact, six_a_spinning_sphere_on_a_plane) {
  for (const double spin : {-2000.0, -500.0, -50.0, 50.0, 500.0, 2000.0})
    expect_sliding("test_6", oblique(), {{0, 0, -0.5}, {0, spin, 0}});
}

// Without slip, elastic: the sphere and its tangential spring by their own equations, with the spring's rule
// for a stiffness that falls, by a fine Runge-Kutta scheme.
TEST(impact, what_sticks_leaves_as_its_spring_says) {
  const Material &m = oxide;
  OnPlane sphere{m, 0.0025, 1, std::numeric_limits<double>::infinity()};
  const double v = 1, slip = 0.3;
  const Impact impact = sphere.hit({{slip, 0, -v}, {}});
  const double mass = 4.0 / 3 * pi * std::pow(sphere.radius, 3) * m.density;
  const double c = 4.0 / 3 * effective_modulus(m) * std::sqrt(sphere.radius);
  const double ratio = 2 * (1 - m.poisson_ratio) / (2 - m.poisson_ratio);
  // x, x', s (rate of slip), T
  using State = std::array<double, 4>;
  const auto rates = [&](const State &y) {
    const double x = std::max(0.0, y[0]), k = ratio * 1.5 * c * std::sqrt(x);
    const double fading = y[1] < 0 && x > 0 ? y[3] * 0.5 * y[1] / x : 0; // T k'/k
    return State{y[1], -c * x * std::sqrt(x) / mass, -3.5 * y[3] / mass, k * y[2] + fading};
  };
  State y{0, v, slip, 0};
  const double h = impact.duration / 400000;
  while (y[0] >= 0) {
    const auto at = [&](const State &d, double share) {
      State z = y;
      for (std::size_t i = 0; i < 4; ++i)
        z[i] += share * h * d[i];
      return z;
    };
    const State a = rates(y), b = rates(at(a, 0.5)), d = rates(at(b, 0.5)), e = rates(at(d, 1));
    for (std::size_t i = 0; i < 4; ++i)
      y[i] += h * (a[i] + 2 * b[i] + 2 * d[i] + e[i]) / 6;
  }
  const Motion &after = impact.after[0];
  const double left = after.velocity.x - sphere.radius * after.spin.y;
  measured::expect_below(row, "sticking_slip", std::abs(left - y[2]) / slip, 5e-3);
}

// Both turn the same way, so that they rub: each gets the same push across, opposite, and is slowed alike.
void expect_rubbing(const std::string &test, const OfTwo &two, double v, double spin) {
  const dem::Model model = two.model();
  const double m1 = model.particles.mass[0], m2 = model.particles.mass[1], m = dem::reduced(m1, m2);
  const Impact impact = two.hit({{v, 0, 0}, {0, 0, spin}}, {{-v, 0, 0}, {0, 0, spin}});
  const std::array<Motion, 2> after{impact.after[0], impact.after[1]};
  const double e = (after[1].velocity.x - after[0].velocity.x) / (2 * v);
  const double most = two.friction * m * (1 + e) * 2 * v; // N s
  const double slip = spin * (two.first_radius + two.second_radius);
  const double pushed = m1 * (after[0].velocity.y);
  EXPECT_NEAR(pushed, -m2 * after[1].velocity.y, 1e-9 * std::abs(pushed));
  EXPECT_LE(std::abs(pushed), (1 + 2e-3) * most);
  EXPECT_LT(pushed * slip, 0); // against how its own surface moves
  const std::array<double, 2> radius{two.first_radius, two.second_radius}, mass{m1, m2};
  for (const std::size_t i : {0, 1})
    EXPECT_NEAR(0.4 * mass[i] * radius[i] * (after[i].spin.z - spin),
                -std::abs(pushed) * std::copysign(1, spin), 5e-3 * std::abs(pushed));
  if (std::abs(slip) < 3.7 * most / m) return;
  measured::expect_below(row, test + "_speed", std::abs(std::abs(pushed) / most - 1), 3e-3);
}

TEST(impact, seven_two_identical_spheres_that_spin) {
  for (const double spin : {-1000.0, -200.0, -20.0, 20.0, 200.0, 1000.0})
    expect_rubbing("test_7", {aluminium, 0.01, 0.01, 0.5, 0.4}, 0.2, spin);
}

TEST(impact, eight_two_different_spheres_that_spin) {
  for (const double spin : {-1000.0, -200.0, -20.0, 20.0, 200.0, 1000.0})
    expect_rubbing("test_8", {aluminium, 0.01, 0.05, 0.5, 0.4}, 0.2, spin);
}

} // namespace
} // namespace platen::coupling::impact_test
