// Bonds of different strength: two phases of one specimen (aggregates in a matrix, with bonds of three
// kinds), and a random factor for each bond from a Weibull distribution.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/describe.h"

namespace platen::dem {

struct Bonds;
struct Particles;

enum class Phase : int { matrix = 0, aggregate = 1 };

// Factors of a kind of bond relative to bonds between two spheres of the matrix, > 0.
struct PhaseFactors {
  double modulus = 1, strength = 1;
};

struct Phases {
  // A sphere is of the aggregate if its radius is above this ...
  double radius_above = std::numeric_limits<double>::quiet_NaN(); // m; NaN: no sphere by its radius
  std::vector<int> aggregate_ids;                                 // ... or if its id is one of these
  PhaseFactors aggregate, interface; // bonds aggregate-aggregate; aggregate-matrix

  static constexpr const char *name = "Phases";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("radius_above", p.radius_above, "m", above(0), "Larger spheres are aggregate.");
    v("aggregate_modulus_factor", p.aggregate.modulus, "1", above_up_to(0, 1e3),
      "Modulus of bonds between two spheres of the aggregate, over that within the matrix.");
    v("aggregate_strength_factor", p.aggregate.strength, "1", above_up_to(0, 1e3),
      "Both strengths of bonds between two spheres of the aggregate, over those within the matrix.");
    v("interface_modulus_factor", p.interface.modulus, "1", above_up_to(0, 1e3),
      "Modulus of bonds between a sphere of the aggregate and one of the matrix, over that within the "
      "matrix.");
    v("interface_strength_factor", p.interface.strength, "1", above_up_to(0, 1e3),
      "Both strengths of bonds between aggregate and matrix, over those within the matrix.");
  }

  // Indexed by the number of spheres of the aggregate in a pair.
  std::array<PhaseFactors, 3> factors() const { return {PhaseFactors{}, interface, aggregate}; }
  bool scatters() const { return aggregate.strength != 1 || interface.strength != 1; } // strengths differ
};

// Adds the column `phase` and fills it. Throws std::invalid_argument if an id belongs to no particle.
void mark_phases(Particles &particles, const Phases &phases);
// Number of spheres of the aggregate in a pair; 0 without phases.
int aggregates_of_pair(const Particles &particles, int first, int second);
// Multiplies stiffness and strength of each bond by the factors of its kind. Bonds must be as created.
void apply_phases(Bonds &bonds, const Particles &particles, const Phases &phases);

struct StrengthScatter {
  double weibull_modulus = std::numeric_limits<double>::quiet_NaN(); // m > 0; large: hardly any scatter
  std::uint64_t seed = 1;

  static constexpr const char *name = "StrengthScatter";
  template <class Visitor, class Self>
  static void describe(Visitor &&v, Self &p) {
    v("weibull_modulus", p.weibull_modulus, "1", between(0.5, 1000),
      "Of the factors: the larger, the less scatter.");
  }
};

// `count` random numbers with the distribution P(s < x) = 1 - exp(-(x/s_0)^m), s_0 = 1 / Gamma(1 + 1/m),
// whose mean is 1 (Weibull 1951). A seed gives always the same sequence; `count` sets only its length. Throws
// std::invalid_argument unless m is positive and finite.
std::vector<double> weibull_factors(std::size_t count, const StrengthScatter &scatter);

// Multiplies the strength factor of each bond, in the order of records. Bonds must be as created.
void scatter_strengths(Bonds &bonds, const StrengthScatter &scatter);

} // namespace platen::dem
