// The strips between which a bar along x is bent.
#pragma once

#include <vector>

#include "dem/packing/specimen.h"
#include "fem/grids.h"

namespace platen::coupling {

// Boxes along y, all alike, that make up one rigid body.
struct Strips {
  std::vector<double> middles;     // m, x
  double width = 0;                // m, along x
  double length = 0;               // m, along y, about y = 0
  double z_low = 0, thickness = 0; // m
  int elements_across = 8;         // along x and along y
  bool presses_from_above = false; // its lower face meets the bar, else its upper one
};
fem::Grid make_grid(const Strips &strips);

// Each strip has a sphere of the specimen within `depth` (m) of its face.
bool each_meets_a_sphere(const Strips &strips, const dem::Specimen &specimen, double depth);

} // namespace platen::coupling
