#include "coupling/contact_layer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "coupling/transfer.h"
#include "dem/laws/rotating_plane.h"
#include "dem/parallel.h"

namespace platen::coupling {

using dem::CoulombFriction;
using dem::cross;
using dem::dot;
using dem::norm_squared;
using dem::Vector3;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rocking_limit = 0.5; // moment of a seat over N R: the resultant stays within half the radius

constexpr double idle_margin = 1e-9;       // of a gap, for round-off
constexpr std::size_t rows_per_block = 64; // a row costs as much as some dozen bonds

void require(bool holds, const std::string &what) {
  if (!holds) throw std::invalid_argument("surface contact: " + what);
}

void check(const SurfaceContact &p, bool column, bool rotation) {
  require(column || p.particle_stiffness > 0, "particle stiffness must be positive");
  require(p.body_stiffness > 0, "body stiffness must be positive");
  require(p.tangential_ratio > 0, "tangential stiffness ratio must be positive");
  require(p.friction_static >= 0, "static friction must not be negative");
  require(p.friction_dynamic >= 0, "dynamic friction must not be negative");
  require(p.damping >= 0 && p.damping < infinite, "damping must not be negative");
  require(p.seat_modulus >= 0 && p.seat_modulus < infinite, "seat modulus must not be negative");
  require(p.seat_modulus == 0 || rotation, "seats need particles that rotate");
  require(p.skin > 0, "skin must be positive");
}

std::size_t index(int row) {
  return static_cast<std::size_t>(row);
}

} // namespace

// How particle and surface move against each other at the closest point.
struct ContactLayer::Kinematics {
  double gap = 0;           // m
  double opening_speed = 0; // m/s
  Vector3 slide;            // m/s, relative velocity in the contact plane
  Vector3 rocking;          // rad/s, relative rotation in the contact plane; only with seats
  double spin = 0;          // rad/s of the surface about the normal
  double k_n = 0, c_n = 0;  // N/m, N s/m
  double radius = 0;        // m
};

struct ContactLayer::RowForce {
  bool active = false;
  SurfacePoint at;
  double normal_force = 0; // N, >= 0 unless tied
  double dashpot = 0;      // N, part of the normal force
  Vector3 shear;           // N
  Vector3 moment;          // N m, of the seat
  Vector3 force;           // N, normal and shear
  ActiveContact contact;   // where it touches
  CoulombFriction::State spring, seat;
  double idle_until = 0;                                   // m, of travelled_
  double slip = 0;                                         // m, of this step
  double elastic = 0, friction_loss = 0, damping_loss = 0; // J
};

ContactLayer::ContactLayer(const dem::Particles &particles, const fem::Body &body,
                           const SurfaceContact &parameters, const dem::Column<double> *particle_stiffness)
    : parameters_(parameters),
      particle_stiffness_(particle_stiffness),
      smallest_radius_(infinite),
      search_(body.surface(), parameters.skin) {
  check(parameters, particle_stiffness != nullptr, particles.has_rotation());
  for (const double r : particles.radius)
    smallest_radius_ = std::min(smallest_radius_, r);
  const bool friction = parameters.friction_static > 0 || parameters.friction_dynamic > 0;
  const bool tangential = friction || parameters.attachment == Attachment::glued;
  if (tangential || parameters.seat_modulus > 0) normal_ = &table_.add<Vector3>("normal", "1");
  if (tangential) {
    spring_ = &table_.add<Vector3>("tangential_force", "N");
    sliding_ = &table_.add<int>("sliding", "1");
    slip_ = &table_.add<double>("slip", "m");
  }
  if (parameters.seat_modulus > 0) {
    seat_spring_ = &table_.add<Vector3>("seat_moment", "N m");
    seat_sliding_ = &table_.add<int>("seat_sliding", "1");
  }
}

std::size_t ContactLayer::add_row(int particle) {
  const auto place = std::lower_bound(particle_.begin(), particle_.end(), particle);
  const std::size_t row = static_cast<std::size_t>(place - particle_.begin());
  if (place != particle_.end() && *place == particle) return row;
  const std::size_t last = table_.size();
  table_.resize(last + 1);
  particle_[last] = particle;
  std::vector<int> order(last + 1);
  for (std::size_t k = 0; k <= last; ++k)
    order[k] = static_cast<int>(k < row ? k : (k == row ? last : k - 1));
  table_.permute(order);
  return row;
}

ContactLayer::~ContactLayer() = default;

void ContactLayer::seat(int particle, double offset) {
  require(std::isfinite(offset), "a seat's offset must be finite");
  const std::size_t row = add_row(particle);
  seated_[row] = 1;
  offset_[row] = offset;
  search_.forget();
}

int ContactLayer::seat_within(const dem::Particles &particles, const fem::Body &body, double depth) {
  std::vector<double> reach(particles.size());
  for (std::size_t i = 0; i < reach.size(); ++i)
    reach[i] = particles.radius[i] + depth;
  search_.rebuild(body.surface(), particles.position, reach, {});
  int count = 0;
  const std::vector<int> near = search_.particles();
  for (std::size_t k = 0; k < near.size(); ++k) {
    const std::size_t i = index(near[k]);
    const double gap =
        search_.closest(body.surface(), k, particles.position[i]).distance - particles.radius[i];
    if (gap > depth) continue;
    seat(near[k], gap);
    ++count;
  }
  search_.forget();
  return count;
}

int ContactLayer::seats() const {
  return static_cast<int>(seated_particles().size());
}

std::vector<int> ContactLayer::seated_particles() const {
  std::vector<int> rows;
  for (std::size_t k = 0; k < table_.size(); ++k)
    if (seated_[k]) rows.push_back(particle_[k]);
  return rows;
}

void ContactLayer::moved(double distance) {
  if (!(distance <= smallest_radius_))
    throw std::runtime_error("a particle moved " + std::to_string(distance) +
                             " m against a surface in one step, more than the smallest radius " +
                             std::to_string(smallest_radius_) +
                             " m: it could pass through a face unseen; use a smaller time step");
  search_.moved(distance);
  travelled_ += distance;
}

void ContactLayer::update_search(const dem::Particles &particles, const fem::Body &body) {
  if (!search_.stale()) return;
  std::vector<double> reach(particles.radius.begin(), particles.radius.end());
  for (std::size_t k = 0; k < table_.size(); ++k)
    reach[index(particle_[k])] += std::max(0.0, offset_[k]);
  search_.rebuild(body.surface(), particles.position, reach, seated_particles());
  set_rows(search_.particles());
}

void ContactLayer::make_list(const dem::Particles &particles, const fem::Body &body) {
  search_.forget();
  update_search(particles, body);
}

// Rows for exactly these particles; those that stay keep their history, new ones start without.
void ContactLayer::set_rows(const std::vector<int> &particles) {
  const std::size_t old_rows = table_.size();
  std::vector<int> order(particles.size());
  int fresh = static_cast<int>(old_rows);
  std::size_t old = 0;
  for (std::size_t k = 0; k < particles.size(); ++k) {
    while (old < old_rows && particle_[old] < particles[k])
      ++old;
    order[k] = old < old_rows && particle_[old] == particles[k] ? static_cast<int>(old) : fresh++;
  }
  table_.resize(static_cast<std::size_t>(fresh));
  table_.permute(order);
  for (std::size_t k = 0; k < particles.size(); ++k)
    particle_[k] = particles[k];
  idle_until_.assign(particles.size(), 0);
}

double ContactLayer::stiffness(int particle) const {
  const double k = particle_stiffness_ != nullptr ? (*particle_stiffness_)[index(particle)]
                                                  : parameters_.particle_stiffness;
  return 1.0 / (1.0 / k + 1.0 / parameters_.body_stiffness);
}

std::size_t ContactLayer::bytes() const {
  return table_.size() * table_.bytes_per_row() + row_forces_.capacity() * sizeof(RowForce) +
         active_.capacity() * sizeof(ActiveContact) + search_.bytes();
}

bool ContactLayer::tied(std::size_t row) const {
  return parameters_.attachment == Attachment::glued && seated_[row];
}

bool ContactLayer::holds_history(std::size_t row) const {
  return dashpot_[row] != 0 || (spring_ != nullptr && norm_squared((*spring_)[row]) > 0) ||
         (seat_spring_ != nullptr && norm_squared((*seat_spring_)[row]) > 0);
}

// A row is passed over while nothing can have brought its particle to the surface since it was last looked
// at.
void ContactLayer::find_due_rows() {
  due_.clear();
  for (std::size_t row = 0; row < table_.size(); ++row)
    if (!(travelled_ < idle_until_[row])) due_.push_back(row);
  row_forces_.resize(due_.size());
}

void ContactLayer::add_forces(dem::Particles &particles, fem::Body &body, double dt) {
  update_search(particles, body);
  find_due_rows();
  // Rows have a particle each, so that threads never meet; what they share, sums and body, is served after.
  dem::for_each(
      due_.size(),
      [&](std::size_t k) {
        RowForce &r = row_forces_[k];
        r = row_force(particles, body, due_[k], dt);
        keep_history(due_[k], r);
        if (r.active) load_particle(particles, due_[k], r);
      },
      rows_per_block);

  active_.clear();
  active_weights_.clear();
  elastic_energy_ = 0;
  double friction_loss = 0, damping_loss = 0;
  for (std::size_t k = 0; k < due_.size(); ++k) {
    const RowForce &r = row_forces_[k];
    idle_until_[due_[k]] = r.idle_until;
    friction_loss += r.friction_loss;
    damping_loss += r.damping_loss;
    if (!r.active) continue;
    elastic_energy_ += r.elastic;
    active_.push_back(r.contact);
    active_weights_.push_back(r.at.local.weights);
    apply_force(body, r.at, -r.force);
    if (norm_squared(r.moment) > 0) apply_moment(body, r.at.face, -r.moment);
  }
  friction_work += friction_loss;
  damping_work += damping_loss;
}

void ContactLayer::keep_history(std::size_t row, const RowForce &r) {
  dashpot_[row] = r.dashpot;
  if (normal_ != nullptr) (*normal_)[row] = r.active ? r.at.normal : Vector3{};
  if (spring_ != nullptr) {
    (*spring_)[row] = r.spring.spring;
    (*sliding_)[row] = r.spring.sliding;
    (*slip_)[row] = r.active ? (*slip_)[row] + r.slip : 0;
  }
  if (seat_spring_ != nullptr) {
    (*seat_spring_)[row] = r.seat.spring;
    (*seat_sliding_)[row] = r.seat.sliding;
  }
}

void ContactLayer::load_particle(dem::Particles &particles, std::size_t row, RowForce &r) {
  const std::size_t i = index(particle_[row]);
  r.force = r.normal_force * r.at.normal + r.shear;
  particles.force[i] += r.force;
  if (particles.has_rotation()) (*particles.torque)[i] += cross(r.at.local.point, r.force) + r.moment;
  ActiveContact &c = r.contact;
  c.particle = particle_[row];
  c.face = r.at.face;
  c.point = particles.position[i] + r.at.local.point;
  c.normal = r.at.normal;
  c.normal_force = r.normal_force;
  c.shear = r.shear;
  c.sliding = r.spring.sliding != 0;
  c.slip = slip_ != nullptr ? (*slip_)[row] : 0;
}

// Reads the row's history and writes nothing but its own result.
ContactLayer::RowForce ContactLayer::row_force(const dem::Particles &particles, const fem::Body &body,
                                               std::size_t row, double dt) {
  const std::size_t i = index(particle_[row]);
  RowForce result;
  result.at = search_.closest(body.surface(), row, particles.position[i]);
  Kinematics motion;
  motion.radius = particles.radius[i];
  motion.gap = result.at.distance - particles.radius[i] - offset_[row];
  result.active = motion.gap < 0 || tied(row);
  if (!result.active && !holds_history(row)) {
    result.idle_until = travelled_ + (1 - idle_margin) * motion.gap;
    return result;
  }

  const Vector3 arm = result.at.local.point, &n = result.at.normal;
  const Vector3 spin = particles.has_rotation() ? (*particles.angular_velocity)[i] : Vector3{};
  const SurfaceMotion surface = surface_motion(body.surface(), result.at);
  const Vector3 v = particles.velocity[i] + cross(spin, arm) - surface.velocity;
  motion.opening_speed = dot(v, n);
  motion.slide = v - motion.opening_speed * n;
  motion.spin = surface.spin;
  motion.k_n = stiffness(particle_[row]);
  if (parameters_.damping > 0)
    motion.c_n = 2 * parameters_.damping * std::sqrt(motion.k_n * particles.mass[i]);
  normal_force(row, motion, dt, result);
  if (spring_ != nullptr) tangential_force(row, motion, dt, result);
  if (seat_spring_ != nullptr && seated_[row]) {
    const Vector3 w = spin - face_rotation(body.surface(), result.at.face);
    motion.rocking = w - dot(w, n) * n;
    seat_moment(row, motion, dt, result);
  }
  return result;
}

// The work of the dashpot by the trapezoid rule, as the leapfrog does it. Where the sum is held at zero the
// dashpot has used up the spring's force, and what the spring gives back is lost to it.
void ContactLayer::normal_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  if (result.active) {
    const double spring = -motion.k_n * motion.gap;
    result.normal_force = spring - motion.c_n * motion.opening_speed;
    if (!tied(row)) result.normal_force = std::max(0.0, result.normal_force);
    result.dashpot = result.normal_force - spring;
    result.elastic = 0.5 * motion.k_n * motion.gap * motion.gap;
  }
  result.damping_loss = -0.5 * (dashpot_[row] + result.dashpot) * motion.opening_speed * dt;
}

void ContactLayer::tangential_force(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  const Vector3 &n = result.at.normal;
  const bool touched = norm_squared((*normal_)[row]) > 0;
  CoulombFriction::State state{(*spring_)[row], (*sliding_)[row]};
  if (touched)
    state.spring = spin_in_plane(carry_with_plane(state.spring, (*normal_)[row], n), n, motion.spin * dt);
  CoulombFriction friction{{parameters_.friction_static, parameters_.friction_dynamic}};
  double pressing = result.active ? result.normal_force : 0;
  if (tied(row)) {
    friction.parameters = {infinite, infinite};
    pressing = 1; // any force that presses: glue has no limit
  }
  const double k_t = parameters_.tangential_ratio * motion.k_n;
  const CoulombFriction::Result t = friction(state, -dt * motion.slide, pressing, k_t);
  result.spring = state;
  result.shear = t.force;
  result.slip = t.slip;
  result.friction_loss += t.dissipated;
  result.elastic += 0.5 * norm_squared(t.force) / k_t;
}

// A flat end of a ground sphere rocks on an elastic base: a spring with a limit, the law of friction with
// angles for paths and R/2 for the coefficient.
void ContactLayer::seat_moment(std::size_t row, const Kinematics &motion, double dt, RowForce &result) {
  const Vector3 &n = result.at.normal;
  const double stiffness =
      2 * parameters_.seat_modulus * pi * motion.radius * motion.radius * motion.radius / 8;
  double limit = rocking_limit * motion.radius, pressing = result.active ? result.normal_force : 0;
  if (tied(row)) {
    limit = infinite;
    pressing = 1;
  }
  CoulombFriction::State state{(*seat_spring_)[row], (*seat_sliding_)[row]};
  if (norm_squared((*normal_)[row]) > 0)
    state.spring = spin_in_plane(carry_with_plane(state.spring, (*normal_)[row], n), n, motion.spin * dt);
  const CoulombFriction::Result m =
      CoulombFriction{{limit, limit}}(state, -dt * motion.rocking, pressing, stiffness);
  result.seat = state;
  result.moment = m.force;
  result.friction_loss += m.dissipated;
  result.elastic += 0.5 * norm_squared(m.force) / stiffness;
}

std::vector<double> ContactLayer::vertex_slip(const fem::Body &body) const {
  std::vector<double> sum(body.surface().vertices.size()), weight(sum.size());
  for (std::size_t k = 0; k < active_.size(); ++k)
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::size_t v = index(body.surface().faces[index(active_[k].face)][corner]);
      sum[v] += active_weights_[k][corner] * active_[k].slip;
      weight[v] += active_weights_[k][corner];
    }
  // Weights below this are round-off of a contact on the far edge of the face.
  constexpr double no_weight = 1e-12;
  for (std::size_t v = 0; v < sum.size(); ++v)
    sum[v] = weight[v] > no_weight ? sum[v] / weight[v] : 0;
  return sum;
}

std::vector<dem::GroundSpring> ContactLayer::ground_springs(const dem::Particles &particles,
                                                            const fem::Body &body) const {
  std::vector<dem::GroundSpring> springs;
  for (std::size_t row = 0; row < search_.particles().size(); ++row) {
    const int i = search_.particles()[row];
    const double r = particles.radius[index(i)];
    const SurfacePoint at = search_.closest(body.surface(), row, particles.position[index(i)]);
    dem::GroundSpring spring;
    spring.particle = i;
    spring.normal = at.normal;
    spring.arm = at.local.point;
    spring.normal_stiffness = stiffness(i);
    if (spring_ != nullptr)
      spring.tangential_stiffness = parameters_.tangential_ratio * spring.normal_stiffness;
    if (seat_spring_ != nullptr && row < table_.size() && seated_[row])
      spring.rotational_stiffness = 2 * parameters_.seat_modulus * pi * r * r * r / 8;
    springs.push_back(spring);
  }
  return springs;
}

ServoLoad ContactLayer::servo_load(const dem::Particles &particles) const {
  ServoLoad load;
  for (const int particle : particle_) {
    const double k = stiffness(particle);
    load.stiffness += k;
    load.impedance += std::sqrt(k * particles.mass[index(particle)]);
  }
  return load;
}

} // namespace platen::coupling
