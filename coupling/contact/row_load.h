// What a row of a contact layer comes to in a step.
#pragma once

#include <array>

#include "base/vector3.h"

namespace platen::coupling {

// What it gives to particle, body and sums, kept small because all of it is read once more in the step.
struct alignas(64) RowLoad {
  int particle = -1; // -1: no contact
  int face = -1;
  std::array<double, 4> weights{};
  Vector3 force, torque;                                   // N, N m about the centre
  double elastic = 0, friction_loss = 0, damping_loss = 0; // J
  double depth = 0;                                        // 1, overlap over radius
};

// What else is told of it when somebody asks.
struct RowContact {
  Vector3 point, normal, shear, moment; // m, 1, N, N m
  double normal_force = 0, slip = 0;    // N, m
  bool sliding = false;
};

constexpr double idle_margin = 1e-9; // of a gap, for round-off

} // namespace platen::coupling
