// Rows of a contact layer in packs: what the kernel is given.
#include <algorithm>
#include <iterator>

#include "coupling/contact/contact_layer.h"

namespace platen::coupling {

void ContactLayer::compute_in_packs(const dem::Particles &p, const fem::LoadedSurface &body, double dt,
                                    std::size_t first, std::size_t count, const SurfacePoints &points) {
  kernels::LayerColumns c{};
  c.particle = particle_.data(), c.offset = offset_.data(), c.dashpot = dashpot_.data();
  if (spring_ != nullptr) {
    c.normal = normal_->data(), c.spring = spring_->data();
    c.sliding = sliding_->data(), c.slip = slip_->data();
  }
  c.idle_until = idle_until_.data();
  c.position = p.position.data(), c.velocity = p.velocity.data();
  if (p.has_rotation()) c.angular_velocity = p.angular_velocity->data();
  c.radius = p.radius.data(), c.mass = p.mass.data();
  kernels::LayerStep step;
  step.dt = dt, step.travelled = travelled_;
  step.stiffness = stiffness_, step.damping = parameters_.damping;
  step.tangential_ratio = parameters_.tangential_ratio;
  step.friction_static = parameters_.friction_static, step.friction_dynamic = parameters_.dynamic();
  const fem::SurfaceMesh &surface = body.surface();
  const kernels::LayerSurface faces{surface.velocities.data(), surface.faces[0].data(), surface.only_shifted};
  double k_n[SurfacePoints::most];
  std::fill(std::begin(k_n), std::end(k_n), stiffness_);
  if (!parameters_.face_compliance.empty())
    for (std::size_t k = 0; k < count; ++k)
      k_n[k] = spring(points.face[k], points.weights_at(k));
  compute_rows_(c, faces, step, points, k_n, &due_[first], count, &loads_[first], &contacts_[first]);
}

} // namespace platen::coupling
