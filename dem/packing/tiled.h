// Large close packings: copies of a periodic box of spheres, placed next to each other without seams, cut to
// shape and grown further between the walls. SI units.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dem/packing/growth.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Generation of a tiled packing. Far from the walls it repeats with each period, except for the motion of the
// last growth: statistics of many tiles are those of one.
struct TilingReport {
  GrowthReport tile;     // in its own length unit
  GrowthReport specimen; // all of it
  double period = 0;     // m, along x, y and z
  double tiles = 0;      // volume of the shape over that of a tile
};

constexpr double fewest_tiles = 2;
constexpr std::size_t most_tiled_spheres = 100000000;

// Spheres of the required mean radius (m), radii uniform between (1 - spread/2) and (1 + spread/2) of the
// mean, jammed inside the shape and finished as in random_close_packing(), in less time. Copies of one tile
// of `tile_spheres` (periodic_close_packing) cover the shape; spheres are kept if their centres lie deeper
// inside than a jammed packing loses to its walls; all are grown until they are over-full, so that those near
// a wall find places against it, and shrunk until the last overlap vanishes. No sphere is fixed, so there is
// no border between repeated and other parts. Mean radius within 1 %, as the number of spheres is not
// corrected. The same seed gives the same packing bit for bit on any number of threads. About 420 bytes a
// sphere during generation, 32 afterwards.
//
// `at_rest`: residual force over mean contact force at which each stage of the last growth ends. The
// default, 2.5 times that for random positions, takes a third of the iterations, for .04 contacts a sphere
// fewer; 3e-2 takes half of these, for .1 fewer at a gap of 1e-3 R: for the largest specimens.
//
// Throws std::invalid_argument: shape not valid or a disc, radius not positive, spread outside [0, 1.9],
// tile_spheres as periodic_close_packing() refuses, a shape of fewer than fewest_tiles or of more than
// most_tiled_spheres; std::runtime_error if the packing does not jam.
Specimen tiled_close_packing(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres,
                             std::uint64_t seed, TilingReport *report = nullptr, double at_rest = 1e-2);

// Volume of the shape over that of a tile with this number of spheres, within a percent.
double tiles_in(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres);

} // namespace platen::dem
