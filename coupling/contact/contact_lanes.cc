// Rows of a contact layer in SIMD vectors: the input of the kernel.
#include "coupling/contact/contact_layer.h"

namespace platen::coupling {

void ContactLayer::compute_in_lanes(const dem::Particles &p, const fem::LoadedSurface &body, double dt,
                                    std::size_t first, std::size_t count, const SurfacePoints &points) {
  kernels::LayerColumns c{};
  c.particle = particle_.data(), c.offset = offset_.data(), c.dashpot = dashpot_.data();
  if (spring_ != nullptr) {
    c.normal = normal_->data(), c.spring = spring_->data();
    c.sliding = sliding_->data(), c.slip = slip_->data();
  }
  c.idle_until = idle_until_.data();
  c.velocity = p.velocity.data();
  if (p.has_rotation()) c.angular_velocity = p.angular_velocity->data();
  c.radius = p.radius.data(), c.mass = p.mass.data();
  kernels::LayerStep step;
  step.dt = dt, step.travelled = travelled_;
  step.stiffness = stiffness_, step.damping = parameters_.damping;
  step.tangential_ratio = parameters_.tangential_ratio;
  step.friction = {parameters_.friction_static, parameters_.dynamic()};
  const fem::SurfaceMesh &surface = body.surface();
  const std::vector<fem::FaceCompliance> &yields = parameters_.face_compliance;
  const kernels::LayerSurface faces{surface.velocities.data(), surface.faces[0].data(), surface.only_shifted,
                                    yields.empty() ? nullptr : yields[0][0].data()};
  compute_rows_(
      c, faces, step, points, &due_[first], count,
      {&results_.load[first], &results_.torque[first], &results_.work[first], &results_.contact[first]});
}

} // namespace platen::coupling
