#include "limit/idealised_loop.h"
#include "base/pi.h"
#include "base/random.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/parallel.h"
#include "limit/bond_forces.h"
#include "limit/parts.h"

namespace platen::bench {

namespace {

constexpr double share_of_safe_step = 0.2;
constexpr double first_speed = 1e-3; // m/s, per axis: strains of about 1e-6

double bond_energy(const BondBlock &b, const Pose *poses, int l) {
  const Pose &i = poses[b.first[l]], &j = poses[b.second[l]];
  const auto vector = [](const Pack &a, int from) {
    return Vector<double>{a[from], a[from + 1], a[from + 2]};
  };
  const auto arm = [&](const Pack *a) { return Vector<double>{a[0][l], a[1][l], a[2][l]}; };
  const Vector<double> d = vector(j.place, 0) - vector(i.place, 0), p = vector(i.turn, 1),
                       q = vector(j.turn, 1);
  const double length = std::sqrt(dot(d, d)), stretch = length - b.rest_length[l];
  const Vector<double> n = (1 / length) * d;
  const Vector<double> u =
      d - turned(i.turn[0], p, arm(b.arm_first)) - turned(j.turn[0], q, arm(b.arm_second));
  const Vector<double> us = u - dot(u, n) * n;
  const Vector<double> v = i.turn[0] * q - j.turn[0] * p + cross(p, q);
  const double vn = dot(v, n);
  return 0.5 * (b.normal[l] * stretch * stretch + b.shear[l] * dot(us, us)) +
         2 * (b.bending[l] * dot(v, v) + b.excess[0][l] * vn * vn);
}

} // namespace

struct IdealisedLoop::State {
  std::vector<Part> parts; // one for each thread
  std::size_t particles, bonds;
  double mass, inertia, time_step; // kg, kg m^2, s
  // Made here, but first touched by the thread that owns the rows, so that the memory is near it.
  std::unique_ptr<Pose[]> poses;
  std::unique_ptr<Load[]> loads, applied;
  std::unique_ptr<Motion[]> motions;
  std::unique_ptr<Increments[]> increments;

  State(const Network &network, int threads);
  Columns columns() const {
    return {poses.get(), loads.get(), applied.get(), motions.get(), increments.get()};
  }
  void place(const Part &part, const Network &network);
  void push();
  void collect_ghosts(const Part &part);
  template <class Work>
  void for_each_part(const Work &work) {
    const ThreadLimit limit(static_cast<int>(parts.size()));
    at_once(parts.size(), [&](std::size_t k) { work(parts[k]); });
  }
};

IdealisedLoop::State::State(const Network &network, int threads)
    : parts(cut(network, threads)),
      particles(network.position.size()),
      bonds(network.first.size()),
      poses(new Pose[particles]),
      loads(new Load[particles]),
      applied(new Load[particles]),
      motions(new Motion[particles]),
      increments(new Increments[particles]) {
  const double r = network.radius;
  mass = 4.0 / 3.0 * pi * r * r * r * sphere_density;
  inertia = 0.4 * mass * r * r;
  // Bonds are about 2 R long: k_n A = E pi R / 2. Gershgorin's bound with 14 of them on a sphere, more than
  // equal spheres find room for: omega^2 < 2 * 14 k_n A / m in translation, and less than twice that with
  // rotation.
  const double stiffness = bond_modulus * pi * r / 2;
  time_step = share_of_safe_step * 2.0 / std::sqrt(2.0 * 2.0 * 14.0 * stiffness / mass);
  for_each_part([&](Part &part) {
    fill(part, network);
    place(part, network);
  });
  push();
}

void IdealisedLoop::State::place(const Part &part, const Network &network) {
  for (int k = part.begin; k < part.end; ++k) {
    const auto &x = network.position[static_cast<std::size_t>(k)];
    poses[k] = {Pack{x[0], x[1], x[2], 0}, Pack{1, 0, 0, 0}};
    loads[k] = applied[k] = Load{};
    motions[k] = Motion{};
    increments[k] = {time_step / mass, time_step / inertia};
  }
}

// Random velocities without net momentum.
void IdealisedLoop::State::push() {
  Random random(1);
  Pack mean{};
  for (std::size_t k = 0; k < particles; ++k) {
    for (int c = 0; c < 3; ++c)
      motions[k].velocity[c] = first_speed * random.uniform(-1, 1);
    mean += motions[k].velocity / static_cast<double>(particles);
  }
  for (std::size_t k = 0; k < particles; ++k)
    motions[k].velocity -= mean;
}

// Adds what other parts' bonds did to this part's rows.
void IdealisedLoop::State::collect_ghosts(const Part &part) {
  for (Part &other : parts) {
    const std::vector<int> &rows = other.ghost_rows;
    auto at = std::lower_bound(rows.begin(), rows.end(), part.begin);
    for (; at != rows.end() && *at < part.end; ++at) {
      Load &ghost = other.ghosts[static_cast<std::size_t>(at - rows.begin())];
      loads[*at].force += ghost.force;
      loads[*at].torque += ghost.torque;
      ghost = Load{};
    }
  }
}

IdealisedLoop::IdealisedLoop(const Network &network, int threads) : state_(new State(network, threads)) {}
IdealisedLoop::~IdealisedLoop() = default;

double IdealisedLoop::run(int steps) {
  const auto start = std::chrono::steady_clock::now();
  State &s = *state_;
  for (int k = 0; k < steps; ++k) {
    s.for_each_part([&](Part &part) { add_bond_forces(part, s.columns()); });
    s.for_each_part([&](const Part &part) {
      s.collect_ghosts(part);
      integrate(part, s.columns(), s.time_step);
    });
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

IdealisedLoop::Check IdealisedLoop::check() const {
  Check total;
  Pack momentum{};
  for (std::size_t k = 0; k < state_->particles; ++k) {
    const Motion &m = state_->motions[k];
    const Pack v2 = m.velocity * m.velocity, w2 = m.spin * m.spin;
    const double square = v2[0] + v2[1] + v2[2];
    total.kinetic_energy += 0.5 * (state_->mass * square + state_->inertia * (w2[0] + w2[1] + w2[2]));
    total.sum_of_momenta += state_->mass * std::sqrt(square);
    momentum += state_->mass * m.velocity;
  }
  const Pack square = momentum * momentum;
  total.momentum = std::sqrt(square[0] + square[1] + square[2]);
  for (const Part &part : state_->parts)
    for (const std::vector<BondBlock> *blocks : {&part.inner, &part.crossing})
      for (const BondBlock &b : *blocks)
        for (int l = 0; l < lanes; ++l)
          total.bond_energy += bond_energy(b, state_->poses.get(), l);
  return total;
}

std::size_t IdealisedLoop::bonds() const {
  return state_->bonds;
}
std::size_t IdealisedLoop::particles() const {
  return state_->particles;
}

} // namespace platen::bench
