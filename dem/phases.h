// Two phases of one specimen: aggregates in a matrix, with bonds of three kinds.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace platen::dem {

struct Bonds;
struct Particles;

enum class Phase : int { matrix = 0, aggregate = 1 };

// What a kind of bond has over those between two spheres of the matrix, > 0.
struct PhaseFactors {
  double modulus = 1, strength = 1;
};

struct Phases {
  // A sphere is of the aggregate where its radius is above this ...
  double radius_above = std::numeric_limits<double>::infinity(); // m
  std::vector<int> aggregate_ids;                                // ... or where its id is one of these
  PhaseFactors aggregate, interface; // bonds between two spheres of the aggregate; of one and one

  // By the number of spheres of the aggregate in a pair.
  std::array<PhaseFactors, 3> factors() const { return {PhaseFactors{}, interface, aggregate}; }
  bool scatters() const { return aggregate.strength != 1 || interface.strength != 1; } // strengths differ
};

// Adds the column `phase` and fills it. Throws std::invalid_argument where an id is no particle's.
void mark_phases(Particles &particles, const Phases &phases);
// Spheres of the aggregate in a pair; 0 where there are no phases.
int aggregates_of_pair(const Particles &particles, int first, int second);
// Multiplies stiffness and strength of each bond by the factors of its kind. Bonds must be as they were laid.
void apply_phases(Bonds &bonds, const Particles &particles, const Phases &phases);

} // namespace platen::dem
