// A rigid body that turns by itself on a spherical seat: a rotor in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/pi.h"
#include "fem/rigid_body.h"
#include "fem/rotor.h"

namespace platen::fem::rigid_seat_test {
namespace {

constexpr Material steel{7850, 210e9, 0.3};
constexpr double a = 0.06, b = 0.04, c = 0.01; // m, along x, y, z

// Over z = 0, on a seat in the middle of its lower face.
RigidBody plate() {
  return RigidBody(make_grid(BoxPlate{{-a / 2, -b / 2, 0}, {a / 2, b / 2, c}, {2, 2, 1}}), steel, Vector3{});
}
constexpr double mass = 7850 * a * b * c;
// kg m^2, about the seat.
constexpr double inertia_x = mass * ((b * b + c * c) / 12 + c * c / 4),
                 inertia_y = mass * ((a * a + c * c) / 12 + c * c / 4),
                 inertia_z = mass * (a * a + b * b) / 12;

std::vector<int> lower_corners(const RigidBody &body) {
  std::vector<int> corners;
  for (std::size_t v = 0; v < body.surface().vertices.size(); ++v) {
    const Vector3 &p = body.surface().vertices[v];
    if (p.z == 0 && std::abs(p.x) == a / 2 && std::abs(p.y) == b / 2) corners.push_back(static_cast<int>(v));
  }
  return corners;
}

// Springs of one stiffness (N/m) from the lower corners to where they stood.
class OnSprings {
public:
  OnSprings(RigidBody &body, double stiffness, bool upright)
      : body_(body), stiffness_(stiffness), upright_(upright), corners_(lower_corners(body)) {
    for (const int v : corners_)
      start_.push_back(body.surface().vertices[static_cast<std::size_t>(v)]);
    press();
  }
  void step(double dt) {
    body_.kick(0.5 * dt), body_.drift(dt);
    press();
    body_.kick(0.5 * dt);
  }
  double energy() const {
    double sum = 0;
    for (std::size_t k = 0; k < corners_.size(); ++k)
      sum += 0.5 * stiffness_ * norm_squared(pull(k));
    return sum;
  }

private:
  Vector3 pull(std::size_t k) const { // m
    const Vector3 d = start_[k] - body_.surface().vertices[static_cast<std::size_t>(corners_[k])];
    return upright_ ? Vector3{0, 0, d.z} : d;
  }
  void press() {
    body_.clear_loads();
    for (std::size_t k = 0; k < corners_.size(); ++k)
      body_.add_surface_force(corners_[k], stiffness_ * pull(k));
  }
  RigidBody &body_;
  double stiffness_;
  bool upright_;
  std::vector<int> corners_;
  std::vector<Vector3> start_;
};

// Four springs along z tilt it about x with 4 k (b/2)^2 and about y with 4 k (a/2)^2. Tilts of 1e-4 rad: what
// is left is (w dt)^2 / 24 of velocity Verlet.
TEST(rigid_seat, a_plate_on_springs_oscillates_at_the_root_of_stiffness_over_inertia) {
  constexpr double k = 1e6;
  for (const int axis : {0, 1}) {
    const double omega = axis == 0 ? std::sqrt(k * b * b / inertia_x) : std::sqrt(k * a * a / inertia_y);
    RigidBody body = plate();
    ASSERT_EQ(lower_corners(body).size(), 4u);
    Vector3 start{};
    start[axis] = 1e-4 * omega;
    body.set_velocity({}, start);
    OnSprings springs(body, k, true);
    const double dt = 2 * pi / omega / 500;
    const double energy = body.energy_balance().kinetic;
    EXPECT_NEAR(energy, 0.5 * (axis == 0 ? inertia_x : inertia_y) * dot(start, start), 1e-12 * energy);
    double before = 0, crossing = 0;
    int crossings = 0;
    for (int step = 1; crossings < 20; ++step) {
      springs.step(dt);
      const Quaternion &turn = body.rotation();
      const double tilt = axis == 0 ? turn.x : turn.y;
      if (step > 1 && tilt * before <= 0) {
        crossing = (step - 1 + before / (before - tilt)) * dt, ++crossings;
      }
      before = tilt;
      ASSERT_NEAR(body.energy_balance().kinetic + springs.energy(), energy, 1e-4 * energy);
    }
    EXPECT_NEAR(crossing * omega / pi / 20, 1, 2e-5);
    EXPECT_EQ(norm(body.displacement()), 0); // the seat is the machine's
  }
}

// What the loads do to the turning is in its energy; the machine does nothing at a seat that stands.
TEST(rigid_seat, works_and_angular_momentum_are_those_of_the_loads) {
  RigidBody body = plate();
  body.set_velocity({0, 0, -0.3});
  const Vector3 force{20, -10, -500};
  Vector3 impulse{};
  double seat_work = 0;
  const double dt = 1e-6;
  for (int step = 0; step < 3000; ++step) {
    body.clear_loads();
    body.add_surface_force(5, force);
    impulse = impulse + dt * body.moment(body.centre());
    body.kick(dt), body.drift(dt);
    seat_work -= dt * dot(force, body.velocity());
  }
  const Vector3 w = rotate(conjugate(body.rotation()), body.angular_velocity());
  const Vector3 momentum = rotate(body.rotation(), {inertia_x * w.x, inertia_y * w.y, inertia_z * w.z});
  EXPECT_GT(norm(momentum), 1e-3);
  EXPECT_LT(norm(momentum - impulse), 1e-10 * norm(impulse));
  const EnergyBalance balance = body.energy_balance();
  EXPECT_GT(balance.kinetic, 1e-3);
  EXPECT_NEAR(balance.clamp_work, seat_work, 1e-12 * std::abs(seat_work));
  // Where it turns, to second order in the step.
  EXPECT_NEAR(balance.kinetic, balance.load_work + balance.clamp_work, 1e-6 * balance.kinetic);
}

// Three unlike moments of inertia, some whole turns.
TEST(rigid_seat, a_body_left_alone_keeps_energy_and_angular_momentum) {
  RigidBody body = plate();
  body.set_velocity({}, {20, -10, 30});
  const auto momentum = [&] {
    const Vector3 w = rotate(conjugate(body.rotation()), body.angular_velocity());
    return rotate(body.rotation(), {inertia_x * w.x, inertia_y * w.y, inertia_z * w.z});
  };
  const Vector3 start = momentum();
  const double energy = body.kinetic_energy();
  for (int step = 0; step < 20000; ++step) {
    body.drift(1e-4);
    ASSERT_NEAR(body.energy_balance().kinetic, energy, 1e-4 * energy);
  }
  EXPECT_LT(norm(momentum() - start), 1e-10 * norm(start));
  EXPECT_LT(std::abs(body.rotation().w), 1 - 1e-3); // turned
}

// A jump dv of the seat under the centre of mass at r: the body stays behind, I w = -m r x dv; the machine's
// impulse is that of the whole body, and its work half of that times dv.
TEST(rigid_seat, a_jump_of_the_seat_leaves_the_body_behind) {
  RigidBody body = plate();
  const Vector3 jump{0.3, -0.2, 0.1}, r{0, 0, c / 2};
  body.set_velocity(jump);
  const Vector3 turning = -mass * cross(r, jump);
  const Vector3 w{turning.x / inertia_x, turning.y / inertia_y, turning.z / inertia_z};
  EXPECT_LT(norm(body.angular_velocity() - w), 1e-12 * norm(w));
  const Vector3 impulse = mass * (jump + cross(w, r));
  EXPECT_NEAR(body.kinetic_energy(), 0.5 * dot(impulse, jump), 1e-12 * body.kinetic_energy());
  EXPECT_NEAR(body.energy_balance().clamp_work, body.energy_balance().kinetic, 1e-15);
  body.set_velocity({});
  EXPECT_LT(norm(body.angular_velocity()), 1e-13 * norm(w));
  EXPECT_NEAR(body.energy_balance().clamp_work, 0, 1e-15);
}

// Springs alike in all directions: the fastest of its three oscillations sets the step.
TEST(rigid_seat, is_stable_up_to_its_step_and_not_beyond) {
  constexpr double k = 1e6;
  const double square =
      std::max({k * (b * b) / inertia_x, k * (a * a) / inertia_y, k * (a * a + b * b) / inertia_z});
  RigidBody body = plate();
  VertexSprings springs{std::vector<double>(body.surface().vertices.size(), 0.0), {}};
  springs.dashpot = springs.stiffness;
  EXPECT_EQ(body.stable_step(springs), std::numeric_limits<double>::infinity());
  for (const int v : lower_corners(body))
    springs.stiffness[static_cast<std::size_t>(v)] = k;
  const double limit = body.stable_step(springs);
  EXPECT_NEAR(limit, 2 / std::sqrt(square), 1e-9 * limit);
  for (const bool above : {false, true}) {
    RigidBody run = plate();
    run.set_velocity({}, {1e-6, 2e-6, 3e-6});
    OnSprings ground(run, k, false);
    for (int step = 0; step < 200; ++step)
      ground.step((above ? 1.02 : 0.98) * limit);
    EXPECT_EQ(norm(run.angular_velocity()) > 1e-3, above);
  }
  // A dashpot of critical damping and more of it: half-step velocities (dt^2 w^2 + 2 dt c / I <= 4).
  for (const int v : lower_corners(body))
    springs.dashpot[static_cast<std::size_t>(v)] = 1e-5 * k;
  const double rate = 1e-5 * square, damped = body.stable_step(springs);
  EXPECT_NEAR(damped * damped * square + 2 * damped * rate, 4, 1e-9);
}

TEST(rigid_seat, the_fastest_of_three_turns_is_found) {
  EXPECT_DOUBLE_EQ(largest_eigenvalue({3, 0, 0, 0, 1, 0, 0, 0, 2}), 3);
  EXPECT_DOUBLE_EQ(largest_eigenvalue({2, 0, 0, 0, 2, 0, 0, 0, 2}), 2);
  EXPECT_EQ(largest_eigenvalue({}), 0);
  // diag(1, 1/2, 1/4) times ones on ones: its only root is the trace.
  EXPECT_NEAR(largest_eigenvalue({1, 1, 1, .5, .5, .5, .25, .25, .25}), 1.75, 1e-12);
  // Of [2 1; 1 2] beside 5/2: 3 and 1.
  EXPECT_NEAR(largest_eigenvalue({2, 1, 0, 1, 2, 0, 0, 0, 2.5}), 3, 1e-12);
}

// The bound by which contacts are searched for: what the farthest vertex really went.
TEST(rigid_seat, tells_how_far_its_farthest_vertex_went) {
  RigidBody body = plate();
  body.set_velocity({0, 0, -0.1}, {3, -2, 1});
  const std::vector<Vector3> before = body.surface().vertices;
  body.drift(1e-3);
  double farthest = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vector3 path = body.surface().vertices[v] - before[v];
    farthest = std::max(farthest, norm(path));
    EXPECT_LT(norm(path - 1e-3 * body.surface().velocities[v]), 1e-15);
  }
  EXPECT_GT(farthest, 1e-4); // more than the seat
  EXPECT_EQ(body.last_move(), farthest);
}

// A load of F along z at the distance e from the seat bears F e on the ball, whose friction bears F times its
// arm.
TEST(rigid_seat, friction_holds_it_until_the_load_lies_farther_than_its_arm) {
  constexpr double load = 2e3, dt = 1e-6; // N, s
  const double e = a / 2;
  for (const double arm : {1.001 * e, 0.999 * e, 0.4 * e, 0.0}) {
    RigidBody body(make_grid(BoxPlate{{-a / 2, -b / 2, 0}, {a / 2, b / 2, c}, {2, 2, 1}}), steel, Vector3{},
                   arm);
    std::vector<int> loaded; // the corners of x = a/2
    for (const int v : lower_corners(body))
      if (body.surface().vertices[static_cast<std::size_t>(v)].x > 0) loaded.push_back(v);
    const auto press = [&] {
      body.clear_loads();
      for (const int v : loaded)
        body.add_surface_force(v, {0, 0, 0.5 * load});
    };
    constexpr int steps = 50;
    press();
    for (int k = 0; k < steps; ++k) {
      body.kick(0.5 * dt), body.drift(dt);
      press();
      body.kick(0.5 * dt);
    }
    const double expected = arm > e ? 0 : load * (e - arm) / inertia_y * steps * dt; // rad/s
    EXPECT_NEAR(-body.angular_velocity().y, expected, 1e-3 * expected)
        << arm; // the load comes nearer as it turns
    const EnergyBalance energy = body.energy_balance();
    EXPECT_NEAR(energy.kinetic + energy.rubbed - energy.load_work - energy.clamp_work, 0,
                1e-12 * energy.kinetic);
    const double turned = arm > e ? 0 : 0.5 * expected * steps * dt; // rad
    EXPECT_NEAR(energy.rubbed, load * arm * turned, 2e-3 * load * arm * turned) << arm;
    EXPECT_EQ(is_identity(body.rotation()), arm > e);
  }
}

TEST(rigid_seat, friction_stops_a_turning_plate_and_takes_all_of_its_energy) {
  constexpr double load = 2e3, dt = 1e-6, arm = 5e-3, speed = 3; // rad/s
  RigidBody body(make_grid(BoxPlate{{-a / 2, -b / 2, 0}, {a / 2, b / 2, c}, {2, 2, 1}}), steel, Vector3{},
                 arm);
  body.set_velocity({}, {0, 0, speed}); // about the axis of the load: nothing else turns it
  const double whole = 0.5 * inertia_z * speed * speed;
  EXPECT_NEAR(body.energy_balance().kinetic / whole, 1, 1e-12);
  const std::vector<int> corners = lower_corners(body);
  const auto press = [&] {
    body.clear_loads();
    for (const int v : corners)
      body.add_surface_force(v, {0, 0, 0.25 * load});
  };
  press();
  const double until = inertia_z * speed / (load * arm); // s
  int steps = 0;
  for (; norm(body.angular_velocity()) > 0 && steps < 10000; ++steps) {
    body.kick(0.5 * dt), body.drift(dt);
    press();
    body.kick(0.5 * dt);
  }
  EXPECT_NEAR(steps * dt, until, 1.5 * dt);
  EXPECT_NEAR(body.energy_balance().rubbed / whole, 1, 1e-9);
  EXPECT_EQ(body.energy_balance().kinetic, 0);
}

} // namespace
} // namespace platen::fem::rigid_seat_test
