// The results of a row of a contact layer in a step.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/vector3.h"

namespace platen::coupling {

// The load on the body and the force on the particle: one cache line. The force is before the weights,
// because kernels write four numbers at once.
struct alignas(64) RowLoad {
  int particle = -1; // -1: no contact
  int face = -1;
  Vector3 force; // N
  std::array<double, 4> weights{};
};
static_assert(sizeof(RowLoad) == 64);

// Values for the particle and for output only.
struct alignas(32) RowTorque {
  Vector3 torque;          // N m, about the particle's centre
  double normal_force = 0; // N, part of the force along the normal
};

// Contributions to the sums of the layer. One thread reads them for all rows in every step; the rest of a row
// stays with the thread that has its particle.
struct alignas(32) RowWork {
  double elastic = 0, friction_loss = 0, damping_loss = 0; // J
  double depth = -1; // 1, overlap over radius of Hertz; negative: no contact
};

// The point of contact. Other data of a contact are in its row's history.
struct RowContact {
  Vector3 point, normal; // m, 1
};

// Columns of the same rows.
struct RowResults {
  std::vector<RowLoad> load;
  std::vector<RowTorque> torque;
  std::vector<RowWork> work;
  std::vector<RowContact> contact;

  std::size_t size() const { return load.size(); }
  void resize(std::size_t rows) {
    load.resize(rows), torque.resize(rows), work.resize(rows), contact.resize(rows);
  }
  void move(std::size_t from, std::size_t to) {
    load[to] = load[from], torque[to] = torque[from], work[to] = work[from], contact[to] = contact[from];
  }
  void append(const RowLoad &l, const RowTorque &t, const RowWork &w, const RowContact &c) {
    load.push_back(l), torque.push_back(t), work.push_back(w), contact.push_back(c);
  }
  std::size_t bytes() const {
    return load.capacity() * sizeof(RowLoad) + torque.capacity() * sizeof(RowTorque) +
           work.capacity() * sizeof(RowWork) + contact.capacity() * sizeof(RowContact);
  }
};

constexpr double idle_margin = 1e-9; // of a gap, for round-off

} // namespace platen::coupling
