// How the idealised loop lays its network out: rows of particles, blocks of four bonds, and one part per
// thread; and the two loops of its step.
#pragma once

#include <array>
#include <vector>

#include "limit/idealised_loop.h"

namespace platen::bench {

constexpr int lanes = 4;
typedef double Pack __attribute__((vector_size(8 * lanes))); // GCC's and Clang's vector extension

// Rows of a particle, 272 bytes together. The unit of gather and scatter is an aligned row of four.
struct alignas(64) Pose {
  Pack place; // x, y, z, spare: m
  Pack turn;  // quaternion w, x, y, z: from the reference
};
struct alignas(64) Load { // one that bonds add to, and one that it is reset to in each step
  Pack force, torque;     // x, y, z, spare: N, N m
};
struct alignas(64) Motion {
  Pack velocity, spin; // x, y, z, spare: m/s, rad/s
};
struct Increments {
  double per_force, per_torque; // dt / m, dt / I
};
static_assert(sizeof(Pose) + 2 * sizeof(Load) + sizeof(Motion) + sizeof(Increments) ==
                  IdealisedLoop::bytes_per_particle,
              "as documented");

// Four bonds, streamed in order.
struct alignas(64) BondBlock {
  int first[lanes], second[lanes];
  Pack arm_first[3], arm_second[3]; // reference arms from the centres to the contact point, m
  Pack rest_length;                 // m
  Pack normal, shear;               // k_n A, k_s A, N/m
  Pack bending;                     // k_n I, N m
  Pack excess[3];                   // k_s J - k_n I, N m: once, twice and four times
};
static_assert(sizeof(BondBlock) == lanes * IdealisedLoop::bytes_per_bond, "as documented");

// What the bonds are made of; the loop is no calibrated concrete.
constexpr double bond_modulus = 40e9, sphere_density = 2500, stiffness_ratio = 0.4; // Pa, kg/m^3, k_s / k_n

// Neighbouring rows and the bonds whose first particle is among them. Bonds that cross to another part's rows
// add to `ghosts`, which the owner of the rows collects afterwards.
struct Part {
  int begin = 0, end = 0; // rows
  std::vector<BondBlock> inner, crossing;
  std::vector<std::array<int, lanes>> slots; // in ghosts, of the second particles of crossing blocks
  std::vector<int> ghost_rows;               // sorted
  std::vector<Load> ghosts;
};

// Parts with about equally many bonds, their rows only.
std::vector<Part> cut(const Network &network, int count);
// Adds the bonds. To be called by the part's own thread, so that the memory is near it.
void fill(Part &part, const Network &network);

// The step itself, and nothing else of it, is in kernels.cc, which alone is compiled with this machine's own
// instructions, which the product never is.

// Pointers to the columns, by row.
struct Columns {
  Pose *poses;
  Load *loads;         // what the bonds add to
  const Load *applied; // what the loads are reset to
  Motion *motions;
  const Increments *increments;
};

// Gather, compute, scatter: adds the part's bonds to loads and to the part's ghosts.
void add_bond_forces(Part &part, const Columns &columns);
// Kick and drift of the part's rows; resets their loads.
void integrate(const Part &part, const Columns &columns, double time_step);

} // namespace platen::bench
