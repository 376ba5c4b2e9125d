// A free block that flies apart, with everything that a step may have: what is compared between ranks and one
// process.
#pragma once

#include <memory>

#include "base/random.h"
#include "dem/model.h"
#include "tests/dem/examples.h"

namespace platen::dist::testing {

using namespace dem::examples;
using dem::Model;
using dem::ModelSettings;

constexpr double side = 26; // of the block, in radii

inline std::unique_ptr<Model> block_of(const ModelSettings &settings) {
  auto model = std::make_unique<Model>(packed_box(side, side, side), settings);
  dem::Particles &p = model->particles;
  Random random(9);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i] = .1 * (p.position[i] / radius) + 2 * random.direction();
    if (p.has_rotation()) (*p.angular_velocity)[i] = (.1 / radius) * random.direction();
  }
  if (model->contacts) model->contacts->search(p, model->bonds.get(), 0);
  return model;
}

// Ten steps in one go now and then.
inline void run(Model &model, int steps, double dt) {
  for (int s = 0; s < steps; ++s) {
    if (s % 10 == 0)
      model.begin_step(dt);
    else
      model.end_and_begin_step(dt, dt);
    model.compute_forces(dt);
    if (s % 10 == 9) model.end_step(dt);
  }
}

inline ModelSettings with_all() {
  ModelSettings settings = breakable();
  settings.contact->damping = .2;
  settings.local_damping = .1;
  settings.bond_dashpot = .05;
  settings.gravity = {0, 0, -9.81};
  settings.scheme = dem::Scheme::tchamwa_wielgosz;
  settings.dissipation = 1.1;
  settings.strength_scatter = dem::StrengthScatter{4, 2};
  return settings;
}

} // namespace platen::dist::testing
