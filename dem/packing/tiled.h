// Large close packings: a box of spheres that repeats itself, laid side by side without seams, cut to shape
// and grown on between the walls. SI units.
#pragma once

#include <cstddef>
#include <cstdint>

#include "dem/packing/growth.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// How a packing of tiles came about. Far from the walls it is the same again at each period, but for what the
// last growth moved: statistics of many tiles are those of one.
struct TilingReport {
  GrowthReport tile;  // in its own unit of length
  GrowthReport whole; // of the specimen
  double period = 0;  // m, along x, y and z
  double tiles = 0;   // volume of the shape over that of a tile
};

constexpr double fewest_tiles = 2;
constexpr std::size_t most_tiled_spheres = 100000000;

// Spheres of the wanted mean radius (m), radii even between (1 - spread/2) and (1 + spread/2) of the mean,
// jammed inside the shape and left as random_close_packing() leaves them, in less time. Copies of one tile of
// `tile_spheres` (periodic_close_packing) are laid over the shape; spheres are kept whose centres lie deeper
// inside than a jammed packing loses to its walls; all are grown until they are over-full, so that those near
// a wall find places against it, and shrunk until the last overlap vanishes. Nothing is held, so there is no
// border between what is repeated and what is not. Mean radius within 1 %, as their number is not corrected.
// The same seed gives the same packing bit for bit on any number of threads.
// Some 420 bytes a sphere while it is made, 32 after.
//
// `at_rest`: residual force over mean contact force at which each stage of the last growth ends. Twice as
// loose as from random places takes a third of the iterations, for .04 contacts a sphere fewer; 3e-2 takes
// half of these, for .1 fewer at a gap of 1e-3 R: for the largest specimens.
//
// Throws std::invalid_argument: shape not valid or a disc, radius not positive, spread outside [0, 1.9],
// tile_spheres as periodic_close_packing() refuses, a shape of fewer than fewest_tiles or of more than
// most_tiled_spheres; std::runtime_error if the packing does not jam.
Specimen tiled_close_packing(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres,
                             std::uint64_t seed, TilingReport *report = nullptr, double at_rest = 1e-2);

// Volume of the shape over that of a tile of so many spheres, within a percent.
double tiles_in(const Shape &shape, double mean_radius, double spread, std::size_t tile_spheres);

} // namespace platen::dem
