// A boundary of one's own: a thin elastic jacket around a cylinder (wound fibres, a steel tube), without
// friction and without stiffness along the axis. Where the skin moves outwards by u, it presses back with
// p = E t u / R^2, the formula of a thin tube; where the skin moves inwards it lies loose.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <coupling/boundary.h>
#include <dem/packing/specimen.h>

#include "base/pi.h"

class Jacket : public platen::coupling::Boundary {
public:
  struct Parameters {
    double modulus = std::numeric_limits<double>::quiet_NaN();   // Pa, E of the jacket around the specimen
    double thickness = std::numeric_limits<double>::quiet_NaN(); // m, t
  };

  // Around the spheres whose surface lies within a mean radius of the mantle of the shape, a cylinder.
  Jacket(const platen::dem::Particles &particles, const platen::dem::Shape &shape,
         const Parameters &parameters)
      : Boundary("jacket"), mantle_(2 * platen::pi * shape.radius * shape.height) {
    double mean_radius = 0; // m
    for (const double r : particles.radius)
      mean_radius += r / static_cast<double>(particles.size());
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (shape.radius - distance(particles, i) - particles.radius[i] < mean_radius) rows_.push_back(i);
    for (const std::size_t i : rows_)
      at_start_.push_back(distance(particles, i));
    // Each sphere stands for an equal part of the mantle.
    const double area = mantle_ / static_cast<double>(rows_.size());
    stiffness_ = parameters.modulus * parameters.thickness * area / (shape.radius * shape.radius);
  }

  void drift(const platen::coupling::Step &, const platen::coupling::Command &) override {}

  void apply_forces(platen::dem::Particles &particles, const platen::coupling::Step &) override {
    force_ = energy_ = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const std::size_t i = rows_[k];
      const double from_axis = distance(particles, i), outwards = from_axis - at_start_[k];
      if (outwards <= 0) continue;
      const double force = stiffness_ * outwards;
      const auto &x = particles.position[i];
      particles.force[i].x -= force * x.x / from_axis;
      particles.force[i].y -= force * x.y / from_axis;
      force_ += force;
      energy_ += 0.5 * force * outwards;
    }
  }

  // What it adds to the stable time step.
  void add_springs(const platen::dem::Particles &particles,
                   std::vector<platen::dem::GroundSpring> &springs) override {
    for (const std::size_t i : rows_) {
      platen::dem::GroundSpring spring;
      spring.particle = static_cast<int>(i);
      const auto &x = particles.position[i];
      const double from_axis = distance(particles, i);
      spring.normal = {-x.x / from_axis, -x.y / from_axis, 0};
      spring.normal_stiffness = stiffness_;
      springs.push_back(spring);
    }
  }

  void add_energy(platen::dem::EnergyLedger &energy) const override { energy.contacts += energy_; }
  double pressure() const override { return force_ / mantle_; } // Pa

  // All that changes between steps follows from the particles: there is nothing to keep but a version.
  void describe(platen::Archive &archive) override { archive.version(1); }

private:
  static double distance(const platen::dem::Particles &particles, std::size_t i) {
    return std::hypot(particles.position[i].x, particles.position[i].y);
  }

  double mantle_, stiffness_ = 0; // m^2, N/m
  std::vector<std::size_t> rows_; // of the particles of the skin
  std::vector<double> at_start_;  // m, from the axis
  double force_ = 0, energy_ = 0; // N, J
};
