// Settings of a specimen that nothing breaks, for tests against closed forms.
#pragma once

#include "coupling/platen_test.h"

namespace platen::coupling {

inline dem::ParallelBond::Parameters unbreakable_bond() {
  dem::ParallelBond::Parameters bond;
  bond.stiffness_ratio = 0.4;
  return bond;
}

// Ground ends of `end_layer` mean radii between platens without friction that close at 0.02 m/s.
inline PlatenTestSettings elastic_settings(double end_layer,
                                           const dem::BondParameters &bond = unbreakable_bond()) {
  PlatenTestSettings s;
  s.model.bond_layout.modulus = 36e9; // Pa
  s.model.bond_layout.gap.value = 0.05;
  s.model.bond = bond;
  s.model.local_damping = 0.5;
  s.ends = Ends::ground;
  s.end_layer = end_layer;
  s.platens.thickness = 2e-3; // m
  s.loading.rate = 0.02;      // m/s
  return s;
}

// m, of what the machine moves; rigid: of the platens.
inline double clamp_closure(const PlatenTest &test) {
  return test.bottom().body().displacement()[2] - test.top().body().displacement()[2];
}

} // namespace platen::coupling
