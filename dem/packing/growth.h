// Random close packing: spheres grown between flat end walls and side walls until they jam. SI units.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dem/packing/specimen.h"

namespace platen::dem {

// Generation and quality of a jammed packing. Overlaps are in mean radii, pairs and walls together.
struct GrowthReport {
  std::size_t spheres = 0;
  int attempts = 0;              // packings made until the mean radius was near the required one
  int stages = 0;                // sizes at which the last packing was brought to rest
  long iterations = 0;           // of the minimiser, all attempts
  std::size_t loose_spheres = 0; // rattlers of the jammed state, seated on neighbours at the end
  double mean_radius = 0;        // m
  double packing_fraction = 0;   // whole container, overlaps not subtracted
  double contacts_per_sphere =
      0; // 2 pairs / spheres in the final, slightly overlapping state; walls not counted
  double mean_overlap = 0, max_overlap = 0;
  double residual_force = 0; // root mean square net force over the mean contact force
};

// Spheres of the required mean radius (m), radii uniform between (1 - spread/2) and (1 + spread/2) of the
// mean, jammed inside the shape: spheres touch every wall, also the flat ends z = 0 and z = height. Soft
// spheres at random positions are brought to rest, then shrunk in steps towards the size at which the last
// overlap would vanish (O'Hern et al. 2003, PRE 68:011306); the final mean overlap is 5e-5 mean radii, the
// largest about ten times that, and spheres that are still loose in their cages are seated on neighbours. The
// number of spheres is chosen so that the jammed mean radius meets the required one within 1 % (where whole
// numbers allow it). The same seed gives the same packing bit for bit. Spheres are numbered in spatial order.
//
// Throws std::invalid_argument: shape not valid or a disc (it is packed as a standing cylinder), radius not
// positive, spread outside [0, 1.9], spheres wider than the shape, more than 5 million spheres;
// std::runtime_error if the packing does not jam.
Specimen random_close_packing(const Shape &shape, double mean_radius, double spread, std::uint64_t seed,
                              GrowthReport *report = nullptr);
// The same for a given number of spheres; the mean radius follows.
Specimen random_close_packing_of(const Shape &shape, std::size_t spheres, double spread, std::uint64_t seed,
                                 GrowthReport *report = nullptr);

} // namespace platen::dem
