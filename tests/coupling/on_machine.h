// Specimens on a spring of the machine behind the top platen: one sphere, and a brittle cylinder.
#pragma once

#include "coupling/platen_test.h"
#include "tests/coupling/small_cylinder.h"

namespace platen::coupling {

// One sphere: two contacts, half of the stiffness of one, in series with the machine.
inline constexpr double contact = 1e7; // N/m

inline PlatenTestSettings one_sphere(double machine) {
  PlatenTestSettings s;
  s.model.rotation = false;
  s.model.local_damping = 0.5;
  s.platens.stiffness.kind = dem::Stiffness::Kind::absolute;
  s.platens.stiffness.value = contact;
  s.platens.thickness = 1e-3;
  s.platens.elements_across = 2;
  s.platens.machine.stiffness = machine;
  s.platens.machine.damping = 0.3;
  s.loading.rate = 0.01;
  s.loading.ramp = 2e-4;
  return s;
}
inline const dem::Specimen &sphere() {
  static const dem::Specimen s = [] {
    dem::Specimen one;
    one.shape = dem::box(2e-3, 2e-3, 2e-3);
    one.centre = {{0, 0, 1e-3}}, one.radius = {1e-3};
    return one;
  }();
  return s;
}

// Brittle, under a machine that is as stiff as the specimen or much softer.
inline PlatenTestSettings crushing(double machine) {
  PlatenTestSettings s;
  s.model.bond_layout.modulus = 36e9;
  s.model.bond_layout.gap.value = 0.05;
  s.model.bond = dem::ParallelBond::Parameters{0.4, 2e6, 6e6, 0.7853981633974483, 0.3};
  s.model.contact = dem::ContactSettings{};
  s.model.contact->damping = 0;
  s.model.local_damping = 0.3;
  s.ends = Ends::ground;
  s.end_layer = 0.5;
  s.platens.top = s.platens.bottom = {0.3, 0.2};
  s.platens.thickness = 2e-3;
  s.platens.machine.stiffness = machine;
  s.loading.rate = 1;
  s.loading.ramp = 1e-6;
  return s;
}
inline const dem::Specimen &cylinder() {
  static const dem::Specimen s = small_cylinder();
  return s;
}

inline void steps_to(PlatenTest &test, long steps) {
  while (test.steps() < steps) {
    test.advance(steps - test.steps());
    test.model.take_cracks();
  }
}
inline void advance_to(PlatenTest &test, double seconds) {
  while (test.time() < seconds)
    steps_to(test, test.steps() + 100);
}

} // namespace platen::coupling
