// Elastic platens in every test there is, and the rigid ones beside them: what is pulled, bent, split, held.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "coupling/platen_test.h"
#include "dem/packing/advancing_front.h"
#include "dem/packing/growth.h"
#include "fem/elastic_solid.h"
#include "tests/coupling/elastic_problem.h"
#include "tests/coupling/small_cylinder.h"

namespace platen::coupling {

using fem::ElasticMotion;

inline constexpr double steel = 200e9; // Pa
inline constexpr std::array both_motions{ElasticMotion::explicit_steps, ElasticMotion::quasi_static};

inline const dem::Specimen &cylinder() {
  static const dem::Specimen s = small_cylinder();
  return s;
}

inline const dem::Specimen &block() {
  static const dem::Specimen s = dem::advancing_front(
      dem::box(12e-3, 12e-3, 14e-3), {dem::RadiusDistribution::Kind::uniform, 0.7e-3, 1e-3}, 3);
  return s;
}

inline const dem::Specimen &bar() {
  static const dem::Specimen s =
      dem::laid_along_x(dem::random_close_packing(dem::box(4e-3, 4e-3, 14e-3), 0.6e-3, 0.25, 3));
  return s;
}

inline dem::Specimen disc(unsigned seed) {
  return dem::laid_down(dem::random_close_packing(dem::cylinder(4e-3, 4e-3), 0.6e-3, 0.25, seed));
}
inline const dem::Specimen &disc() {
  static const dem::Specimen s = disc(3);
  return s;
}

// Nothing breaks, slides or is damped by signs of velocities, so that nothing decides by the last bits.
inline PlatenTestSettings smooth() {
  PlatenTestSettings s = elastic_settings(0.5);
  s.model.local_damping = 0;
  s.platens.damping = 0.1;
  s.platens.elements_across = 6;
  s.platens.thickness = 4e-3;
  s.loading.rate = 0.2;
  s.loading.ramp = 2e-5;
  return s;
}

inline PlatenTestSettings elastic(PlatenTestSettings s, ElasticMotion motion, double young) {
  s.platens.material.young_modulus = young;
  s.platens.elastic = ElasticPlatens{};
  s.platens.elastic->motion = motion;
  return s;
}

inline PlatenTestSettings pulled() {
  PlatenTestSettings s = smooth();
  s.platens.glued = true;
  s.loading.tension = true;
  return s;
}

inline PlatenTestSettings bent() {
  PlatenTestSettings s = smooth();
  s.end_layer = 1;
  s.platens.strip_width = 3e-3;
  s.platens.span = 10e-3;
  s.platens.thickness = 2e-3;
  return s;
}

inline PlatenTestSettings split(double strip) {
  PlatenTestSettings s = smooth();
  s.end_layer = 1;
  s.platens.strip_width = strip;
  s.platens.thickness = 2e-3;
  return s;
}

inline PlatenTestSettings walled() {
  PlatenTestSettings s = smooth();
  s.loading.wall = true;
  return s;
}

inline PlatenTestSettings hydrostatic(bool sleeve) {
  PlatenTestSettings s = smooth();
  s.loading.cell.emplace();
  s.loading.cell->pressure = 5e6;
  s.loading.cell->ramp = 4e-5;
  s.loading.cell->alone = true;
  if (sleeve) {
    s.loading.cell->sleeve.emplace();
    s.loading.cell->sleeve->thickness = 1.5e-3;
    s.loading.cell->sleeve->mass_scaling = 1;
  }
  return s;
}

inline PlatenTestSettings held_at(double stress) {
  PlatenTestSettings s = smooth();
  s.model.local_damping = 0.3;
  s.loading.rate = 1;
  s.loading.servo = true;
  s.loading.top_stress = stress;
  s.loading.hold = 4e-5;
  s.loading.target_strain = 1;
  return s;
}

inline void advance_to(PlatenTest &test, long steps) {
  while (test.steps() < steps) {
    test.advance(steps - test.steps());
    test.model.take_cracks();
  }
}

inline void advance_to_end(PlatenTest &test, long most) {
  while (!test.program().finished() && test.steps() < most) {
    test.advance(most);
    test.model.take_cracks();
  }
  EXPECT_TRUE(test.program().finished()) << "after " << most << " steps";
}

// But for what platens without inertia are behind their loads.
inline double residual(const PlatenTest &test) {
  const dem::EnergyLedger energy = test.energy();
  return std::abs((energy.residual() + energy.unbalanced) / energy.boundary);
}

} // namespace platen::coupling
