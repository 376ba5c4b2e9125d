// The mark that a step of Platen is compared against: the same bonded network, but gather, compute, scatter
// and integrate alone, in double precision and with this machine's own instructions. No failure checks, no
// energy sums, no contacts, no platens, no damping.
//
// Fixed sizes of the mark: 222 flops and 112 bytes streamed per bond, 272 bytes per particle.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace platen::bench {

// Equal spheres and the bonds between them. Particles follow space (a Morton curve, say), bonds are sorted by
// (first, second).
struct Network {
  std::vector<std::array<double, 3>> position; // m
  std::vector<int> first, second;              // first < second
  double radius = 0;                           // m
};

class IdealisedLoop {
public:
  static constexpr int flops_per_bond = 222; // counted in bond_forces.h, and 12 to add them
  static constexpr int bytes_per_bond = 112;
  static constexpr int bytes_per_particle = 272;

  // Totals of the state, to show that the loop moves a real network.
  struct Check {
    double kinetic_energy = 0, bond_energy = 0; // J; velocities are half a step ahead of positions
    double momentum = 0, sum_of_momenta = 0;    // kg m/s: |sum m v| and sum m |v|
  };

  // The network unstrained, its spheres in small random motion without net momentum. Bonds of one modulus, as
  // thick as the spheres; the step is a fifth of a safe one.
  IdealisedLoop(const Network &network, int threads);
  ~IdealisedLoop();
  IdealisedLoop(const IdealisedLoop &) = delete;
  IdealisedLoop &operator=(const IdealisedLoop &) = delete;

  double run(int steps); // s, by the wall clock
  std::size_t bonds() const;
  std::size_t particles() const;
  Check check() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace platen::bench
