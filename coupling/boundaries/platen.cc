#include "coupling/boundaries/platen.h"

#include <cmath>
#include <ostream>

namespace platen::coupling {

Platen::Platen(std::string name, std::unique_ptr<fem::Body> body, const dem::Particles &particles,
               const SurfaceContact &contact)
    : ContactBoundary(std::move(name)), body_(std::move(body)), layer_(particles, *body_, contact) {}

void Platen::drift(const Step &step, const Command &command) {
  body_->set_velocity(command.velocity);
  body_->kick(0.5 * step.dt);
  body_->drift(step.dt);
  body_->clear_loads();
}

void Platen::finish(const Step &) {
  force_ = body_->total_force();
}

bool Platen::is_finite() const {
  return std::isfinite(force_[0] + force_[1] + force_[2]);
}

ServoLoad Platen::servo_load(const dem::Particles &particles) const {
  return layer_.servo_load(particles);
}

void Platen::write_vtu(std::ostream &stream) const {
  body_->write_vtu(stream, layer_.vertex_slip(*body_));
}

std::vector<dem::GroundSpring> Platen::whole_springs(const dem::Particles &particles) {
  layer_.make_list(particles, *body_);
  return layer_.ground_springs(particles, *body_, true);
}

// The mean of what forces left of the middle and right of it say.
double Platen::midspan_moment(double z) const {
  const fem::SurfaceMesh &mesh = body_->surface();
  double sum = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3 &load = body_->contact_load(static_cast<int>(v)), &x = mesh.vertices[v];
    // Force on the bar: -load. A push up at |x| pulls the lower side, as does a pull outwards below z.
    const double outwards = std::copysign(1.0, x[0]) * load[0];
    sum += -load[2] * std::abs(x[0]) - outwards * (z - x[2]);
  }
  return 0.5 * sum;
}

void Platen::describe(Archive &archive) {
  archive.version(1);
  archive("force", force_, "N");
  archive.part("body", *body_);
  archive.part("contacts", layer_);
}

void RigidPlaten::finish(const Step &step) {
  const Vector3 before = force_;
  Platen::finish(step);
  power_ = dot(before + force_, body_->velocity());
}

} // namespace platen::coupling
