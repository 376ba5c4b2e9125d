#include "fem/rigid_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/require.h"
#include "base/vector3.h"

namespace platen::fem {
RigidBody::RigidBody(Grid grid, const Material &material) : grid_(std::move(grid)), material_(material) {
  require(grid_ != nullptr, "body: no grid");
  check(material, "body");
  NodeSurface extracted = extract_surface(grid_);
  set_surface(std::move(extracted.surface));
  grid_vertex_ = std::move(extracted.node);
  reference_vertices_ = surface_.vertices;
  surface_.only_shifted = true;

  const VolumeMoments m = volume_moments(grid_);
  volume_ = m.volume;
  reference_centre_ = m.centroid;
  const double trace = m.second[0] + m.second[4] + m.second[8];
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      inertia_[3 * i + j] = material.density * ((i == j ? trace : 0.0) - m.second[3 * i + j]);
}

Vector3 RigidBody::current_position(const Vector3 &reference) const {
  // Without rotation the sum is kept plain: a flat face stays flat to the last bit.
  if (is_identity(rotation_)) return reference + displacement_;
  return centre() + rotate(rotation_, reference - reference_centre_);
}

void RigidBody::place_vertices() {
  const Vector3 middle = centre();
  const bool turns = angular_velocity_ != Vector3{};
  surface_.only_shifted = !turns && is_identity(rotation_);
  for (std::size_t v = 0; v < surface_.vertices.size(); ++v) {
    surface_.vertices[v] = current_position(reference_vertices_[v]);
    surface_.velocities[v] =
        turns ? velocity_ + cross(angular_velocity_, surface_.vertices[v] - middle) : velocity_;
  }
}

void RigidBody::set_velocity(const Vector3 &velocity, const Vector3 &angular_velocity) {
  if (velocity == velocity_ && angular_velocity == angular_velocity_) return;
  velocity_ = velocity;
  angular_velocity_ = angular_velocity;
  place_vertices();
}

void RigidBody::drift(double dt) {
  last_move_ = largest_move(dt);
  if (velocity_ == Vector3{} && angular_velocity_ == Vector3{}) return;
  displacement_ = displacement_ + dt * velocity_;
  if (angular_velocity_ != Vector3{})
    rotation_ = normalised(normalised(rotation_quaternion(dt * angular_velocity_)) * rotation_);
  place_vertices();
}

double RigidBody::largest_move(double dt) const {
  double reach = 0;
  if (angular_velocity_ != Vector3{})
    for (const Vector3 &v : reference_vertices_)
      reach = std::max(reach, norm(v - reference_centre_));
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
  return energy;
}

double RigidBody::stable_step(const VertexSprings &) const {
  return std::numeric_limits<double>::infinity();
}

void RigidBody::describe(Archive &archive) {
  archive.version(1);
  archive("displacement", displacement_, "m");
  archive("rotation", rotation_);
  archive("velocity", velocity_, "m/s");
  archive("angular_velocity", angular_velocity_, "rad/s");
  describe_loads(archive);
  if (archive.reads()) place_vertices();
}

} // namespace platen::fem
