#include "fem/rigid_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/require.h"
#include "base/vector3.h"
#include "fem/rotor.h"

namespace platen::fem {

RigidBody::RigidBody(Grid grid, const Material &material) : grid_(std::move(grid)), material_(material) {
  require(grid_ != nullptr, "body: no grid");
  check(material, "body");
  NodeSurface extracted = extract_surface(grid_);
  set_surface(std::move(extracted.surface));
  grid_vertex_ = std::move(extracted.node);
  reference_vertices_ = surface_.vertices;
  surface_.only_shifted = true;
  find_inertia(volume_moments(grid_));
}

RigidBody::RigidBody(Grid grid, const Material &material, const Vector3 &seat, double friction_arm)
    : RigidBody(std::move(grid), material) {
  require(friction_arm >= 0 && std::isfinite(friction_arm), "body: the arm of a seat's friction is below 0");
  turns_ = true;
  friction_arm_ = friction_arm;
  pivot_ = seat;
  arm_ = mass() * (reference_centre_ - seat);
  add_about_origin(inertia_, mass(), reference_centre_ - seat);
  inverse_inertia_ = inverse(inertia_);
  surface_.only_shifted = false;
}

void RigidBody::find_inertia(const VolumeMoments &m) {
  volume_ = m.volume;
  pivot_ = reference_centre_ = m.centroid;
  const double trace = m.second[0] + m.second[4] + m.second[8];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      inertia_[3 * i + j] = material_.density * ((i == j ? trace : 0.0) - m.second[3 * i + j]);
}

Vector3 RigidBody::current_position(const Vector3 &reference) const {
  // Without rotation only the displacement is added: a flat face stays flat to the last bit.
  if (is_identity(rotation_)) return reference + displacement_;
  return centre() + rotate(rotation_, reference - pivot_);
}

void RigidBody::place_vertices() {
  const Vector3 middle = centre();
  const bool turns = angular_velocity_ != Vector3{};
  surface_.only_shifted = !turns_ && !turns && is_identity(rotation_);
  for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
    surface_.vertices[v] = current_position(reference_vertices_[v]);
    surface_.velocities[v] =
        turns ? velocity_ + cross(angular_velocity_, surface_.vertices[v] - middle) : velocity_;
  }
}

void RigidBody::set_velocity(const Vector3 &velocity) {
  set_velocity(velocity, turns_ ? angular_velocity_ : Vector3{});
}

// A velocity jump of the seat also acts on the body's inertia; a prescribed change of rotation is added.
void RigidBody::set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity) {
  if (velocity == velocity_ && angular_velocity == angular_velocity_) return;
  if (turns_) {
    const double before = turning_energy();
    const Vector3 change = rotate(conjugate(rotation_), angular_velocity - angular_velocity_);
    spin_ =
        spin_ + rotate(rotation_, inertia_ * change) - cross(rotate(rotation_, arm_), velocity - velocity_);
    find_angular_velocity();
    clamp_work_ += turning_energy() - before;
  } else {
    angular_velocity_ = angular_velocity;
  }
  velocity_ = velocity;
  place_vertices();
}

void RigidBody::find_angular_velocity() {
  angular_velocity_ = rotate(rotation_, inverse_inertia_ * rotate(conjugate(rotation_), spin_));
}

void RigidBody::kick(double dt) {
  if (!turns_) return;
  const Vector3 force = total_force(), turning = moment(centre()), before = angular_velocity_;
  const double energy = turning_energy();
  spin_ = spin_ + dt * turning;
  if (friction_arm_ > 0) hold_back(dt * friction_arm_ * norm(force));
  find_angular_velocity();
  const double work = 0.5 * dt * dot(turning, before + angular_velocity_);
  clamp_work_ -= dt * dot(force, velocity_);
  load_work_ += dt * dot(force, velocity_) + work;
  if (friction_arm_ > 0) rubbed_ += work - (turning_energy() - energy);
  place_vertices();
}

// Takes angular momentum until the body rests: what is left of a step's moment is less than friction can
// bear.
void RigidBody::hold_back(double impulse) {
  if (const double spin = norm(spin_); spin > 0) spin_ = std::max(0.0, 1 - impulse / spin) * spin_;
}

void RigidBody::drift(double dt) {
  if (turns_) return drift_on_seat(dt);
  last_move_ = largest_move(dt);
  if (velocity_ == Vector3{} && angular_velocity_ == Vector3{}) return;
  displacement_ = displacement_ + dt * velocity_;
  turn(dt);
  place_vertices();
}

void RigidBody::turn(double dt) {
  if (angular_velocity_ != Vector3{})
    rotation_ = normalised(normalised(rotation_quaternion(dt * angular_velocity_)) * rotation_);
}

// Rotates by the angular velocity at half the step, since the inertia rotates with the body.
void RigidBody::drift_on_seat(double dt) {
  const std::vector<Vector3> before = surface_.vertices;
  const Quaternion start = rotation_;
  displacement_ = displacement_ + dt * velocity_;
  turn(0.5 * dt);
  find_angular_velocity();
  rotation_ = start;
  turn(dt);
  find_angular_velocity();
  place_vertices();
  last_move_ = 0;
  for (std::size_t v = 0; v < before.size(); ++v) {
    const Vector3 displacement = surface_.vertices[v] - before[v];
    last_move_ = std::max(last_move_, norm(displacement));
    if (dt != 0) surface_.velocities[v] = (1 / dt) * displacement;
  }
}

double RigidBody::largest_move(double dt) const {
  double reach = 0;
  if (angular_velocity_ != Vector3{})
    for (const Vector3 &v : reference_vertices_)
      reach = std::max(reach, norm(v - pivot_));
  return std::abs(dt) * (norm(velocity_) + norm(angular_velocity_) * reach);
}

double RigidBody::kinetic_energy() const {
  double energy = 0.5 * mass() * dot(velocity_, velocity_);
  if (angular_velocity_ != Vector3{}) {
    const Vector3 w = rotate(conjugate(rotation_), angular_velocity_);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        energy += 0.5 * w[i] * inertia_[3 * i + j] * w[j];
  }
  if (turns_) energy += dot(velocity_, cross(angular_velocity_, rotate(rotation_, arm_)));
  return energy;
}

EnergyBalance RigidBody::energy_balance() const {
  EnergyBalance balance;
  if (!turns_) return balance;
  balance.kinetic = turning_energy();
  balance.load_work = load_work_, balance.clamp_work = clamp_work_, balance.rubbed = rubbed_;
  return balance;
}

// Springs of all vertices, with equal stiffness in all directions, against a rotation about the seat.
// Dashpots act on velocities of half a step before, as in ElasticSolid.
double RigidBody::stable_step(const VertexSprings &springs) const {
  if (!turns_) return std::numeric_limits<double>::infinity();
  Matrix3 stiffness{}, dashpots{};
  for (std::size_t v = 0; v < reference_vertices_.size(); ++v) {
    const Vector3 r = reference_vertices_[v] - pivot_;
    add_about_origin(stiffness, springs.stiffness[v], r);
    add_about_origin(dashpots, springs.dashpot[v], r);
  }
  const double omega = std::sqrt(std::max(0.0, largest_eigenvalue(inverse_inertia_ * stiffness)));
  const double xi = 0.5 * largest_eigenvalue(inverse_inertia_ * dashpots) / omega;
  return omega > 0 ? 2 / omega * (std::sqrt(1 + xi * xi) - xi) : std::numeric_limits<double>::infinity();
}

Picture RigidBody::picture(const std::vector<double> &slip) const {
  std::vector<Vector3> displacement;
  for (const Vector3 &v : grid_->vertices)
    displacement.push_back(is_identity(rotation_) ? displacement_ : current_position(v) - v);
  return picture_of("body", *this, grid_vertex_, slip, grid_->vertices, displacement, grid_->cells);
}

void RigidBody::describe(Archive &archive) {
  archive.version(1);
  archive("displacement", displacement_, "m");
  archive("rotation", rotation_, "1", unit_length());
  archive("velocity", velocity_, "m/s");
  archive("angular_velocity", angular_velocity_, "rad/s");
  if (turns_) {
    archive("angular_momentum", spin_, "kg m2/s");
    archive("load_work", load_work_, "J");
    archive("clamp_work", clamp_work_, "J");
    if (friction_arm_ > 0) archive("seat_friction_work", rubbed_, "J");
  }
  describe_loads(archive);
  if (archive.reads()) place_vertices();
}

} // namespace platen::fem
