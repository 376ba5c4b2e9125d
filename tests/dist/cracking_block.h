// A free block that flies apart: what is compared between ranks and one process.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "tests/dem/examples.h"

namespace platen::dist::testing {

using dem::Model;
using dem::ModelSettings;

inline std::unique_ptr<Model> block_of(const ModelSettings &settings) {
  return dem::examples::flying_block(settings, 26);
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

inline const ModelSettings &set_up(const std::string &name) {
  for (const dem::examples::SetUp &one : dem::examples::set_ups())
    if (one.name == name) return one.settings;
  throw std::out_of_range(name);
}

} // namespace platen::dist::testing
