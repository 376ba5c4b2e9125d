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
  double normal_force = 0;                                 // N, share of the force along the normal
  double elastic = 0, friction_loss = 0, damping_loss = 0; // J
  double depth = 0;                                        // 1, overlap over radius
};

static_assert(sizeof(RowLoad) == 2 * 64);

// Where it touches. What else is told of a contact is in its row's history.
struct RowContact {
  Vector3 point, normal; // m, 1
};

constexpr double idle_margin = 1e-9; // of a gap, for round-off

} // namespace platen::coupling
