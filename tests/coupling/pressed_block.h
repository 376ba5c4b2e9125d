// One rigid sphere pressed on an elastic block, solved to equilibrium with the contact layer between them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "coupling/contact/contact_layer.h"
#include "dem/packing/specimen.h"
#include "fem/elastic_solid.h"
#include "fem/grids.h"

namespace platen::coupling {

constexpr double radius = 1e-3;                // m, of the sphere
constexpr fem::Material rock{2600, 50e9, 0.3}; // of the block
inline const double plane_modulus = rock.young_modulus / (1 - rock.poisson_ratio * rock.poisson_ratio);

// Hertz 1882, with a the radius of the contact.
inline double hertz_approach(double a) {
  return a * a / radius;
}
inline double hertz_force(double a) {
  return 4.0 / 3.0 * plane_modulus * a * a * a / radius;
}
inline double hertz_approach_under(double force) {
  return hertz_approach(std::cbrt(0.75 * force * radius / plane_modulus));
}

// A block below z = 0 with cubes of edge h where the sphere presses and longer ones towards its sides and its
// held lower end, at least `reach` away.
inline fem::Grid graded_block(double h, double reach) {
  constexpr int even = 3; // cubes on each side
  constexpr double growth = 1.7;
  std::vector<double> place = {0};
  double step = h;
  while (place.back() < reach || place.size() <= even) {
    if (place.size() > even) step *= growth;
    place.push_back(place.back() + step);
  }
  const int n = static_cast<int>(place.size()) - 1;
  const double whole = n;
  const fem::Grid numbers =
      fem::make_grid(fem::BoxPlate{{-whole, -whole, -whole}, {whole, whole, 0}, {2 * n, 2 * n, n}});
  const auto graded = [&place](double x) {
    return std::copysign(place[static_cast<std::size_t>(std::lround(std::abs(x)))], x);
  };
  return fem::moved_grid(numbers, [&](const Vector3 &p) {
    return Vector3{graded(p[0]), graded(p[1]), graded(p[2])};
  });
}

struct PressedBlock {
  dem::Particles particles;
  fem::ElasticSolid block;
  ContactLayer layer;

  // `stiffness` (N/m) is that of the whole contact; `once`: without the indentation of the mesh coming on
  // top.
  PressedBlock(fem::Grid grid, int degree, double stiffness, bool once)
      : particles(one_sphere(), 2500, false),
        block(std::move(grid), {rock}, fem::Clamp{fem::low_end_tag}, options(degree)),
        layer(particles, block,
              contact(stiffness, once ? block.face_compliance() : std::vector<fem::FaceCompliance>{})) {}

  // Force (N) between both at rest, with the sphere `approach` (m) deep at (x, y), measured from the block's
  // face without load. The load goes a part of the way to the force that its own indentation leaves, until
  // that is within 1e-4 of it. In the valley of its indentation the closest point of a sphere changes sides,
  // and only the size of the force comes to rest.
  double press(double x, double y, double approach) {
    constexpr double part = 0.6;
    particles.position[0] = {x, y, radius - approach};
    for (int round = 0; round < 60; ++round) {
      block.aim(load_, 0);
      block.clear_loads();
      particles.force[0] = {};
      layer.make_list(particles, block);
      layer.add_forces(particles, block, 0);
      Vector3 sum{};
      for (const Vector3 &load : load_)
        sum = sum + load;
      const double force = norm(particles.force[0]);
      if (std::abs(force - norm(sum)) < 1e-4 * force) return force;
      for (std::size_t v = 0; v < load_.size(); ++v)
        load_[v] = load_[v] + part * (block.contact_load(static_cast<int>(v)) - load_[v]);
    }
    ADD_FAILURE() << "no equilibrium at " << x << ", " << y;
    return 0;
  }

private:
  static dem::Specimen one_sphere() {
    dem::Specimen s;
    s.centre = {{0, 0, radius}};
    s.radius = {radius};
    return s;
  }
  static fem::ElasticOptions options(int degree) {
    fem::ElasticOptions o;
    o.degree = degree;
    o.motion = fem::ElasticMotion::quasi_static;
    o.solver = fem::LinearSolver::direct; // many loads, few nodes
    return o;
  }
  static SurfaceContact contact(double stiffness, std::vector<fem::FaceCompliance> compliance) {
    SurfaceContact c;
    c.particle_stiffness = stiffness;
    c.face_compliance = std::move(compliance);
    c.skin = 0.3 * radius;
    return c;
  }

  std::vector<Vector3> load_ = std::vector<Vector3>(block.surface().vertices.size(), Vector3{});
};

} // namespace platen::coupling
