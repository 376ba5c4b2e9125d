// A few spheres and one plate, with the smallest integrator that moves them: the leapfrog, written out.
#pragma once

#include <vector>

#include "coupling/contact/contact_layer.h"
#include "dem/packing/specimen.h"
#include "fem/grids.h"
#include "fem/rigid_body.h"

namespace platen::coupling {

constexpr fem::Material steel{7850, 210e9, 0.3};
constexpr double sphere_radius = 1e-3;  // m
constexpr double plate_stiffness = 1e6; // N/m, of particle and contact (rigid plate)

// A plate whose upper face is z = 0, [-half, half] in x and y, `across` x `across` quads on it.
inline fem::RigidBody plate(double half, int across) {
  return fem::RigidBody(
      fem::make_grid(fem::BoxPlate{{-half, -half, -0.01}, {half, half, 0}, {across, across, 1}}), steel);
}

inline dem::Specimen spheres(const std::vector<Vector3> &centres, double radius = sphere_radius) {
  dem::Specimen specimen;
  specimen.centre = centres;
  specimen.radius.assign(centres.size(), radius);
  return specimen;
}

inline SurfaceContact frictional(double friction_static, double friction_dynamic) {
  SurfaceContact p;
  p.particle_stiffness = plate_stiffness;
  p.friction_static = friction_static;
  p.friction_dynamic = friction_dynamic;
  p.skin = 0.3 * sphere_radius;
  return p;
}

struct SphereScene {
  dem::Particles particles;
  fem::RigidBody body;
  ContactLayer layer;
  Vector3 gravity;

  SphereScene(fem::RigidBody plate_body, const std::vector<Vector3> &centres, const SurfaceContact &contact,
              bool rotation = true, double radius = sphere_radius, double density = 2500)
      : particles(spheres(centres, radius), density, rotation),
        body(std::move(plate_body)),
        layer(particles, body, contact) {}

  void describe(Archive &archive) {
    archive.table("particles", particles.table);
    archive.part("body", body);
    archive.part("contacts", layer);
  }

  // Forces at the present positions, history advanced by the motion of the last dt.
  void compute_forces(double dt) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.force[i] = particles.mass[i] * gravity;
      if (particles.has_rotation()) (*particles.torque)[i] = {};
    }
    body.clear_loads();
    layer.add_forces(particles, body, dt);
  }

  // Moves everything by its present velocities, then computes forces: motion imposed from outside.
  void carry(double dt) {
    double farthest = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.position[i] += dt * particles.velocity[i];
      farthest = std::max(farthest, dt * norm(particles.velocity[i]));
    }
    layer.moved(farthest + body.largest_move(dt));
    body.drift(dt);
    compute_forces(dt);
  }

  void half_kick(double dt) {
    for (std::size_t i = 0; i < particles.size(); ++i) {
      particles.velocity[i] += (0.5 * dt / particles.mass[i]) * particles.force[i];
      if (particles.has_rotation())
        (*particles.angular_velocity)[i] += (0.5 * dt / (*particles.inertia)[i]) * (*particles.torque)[i];
    }
  }

  void step(double dt) {
    half_kick(dt);
    carry(dt);
    half_kick(dt);
  }

  double kinetic_energy() const {
    double sum = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      sum += 0.5 * particles.mass[i] * norm_squared(particles.velocity[i]);
      if (particles.has_rotation())
        sum += 0.5 * (*particles.inertia)[i] * norm_squared((*particles.angular_velocity)[i]);
    }
    return sum;
  }

  Vector3 load() const { return body.total_force(); }
};

} // namespace platen::coupling
