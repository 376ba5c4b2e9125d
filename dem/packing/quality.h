// Quality of a sphere packing: density, coordination, overlaps, isotropy, ends. SI units.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vector3.h"
#include "dem/packing/direction_cells.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Volume (m^3) of the part of a sphere inside the shape. Exact for spheres entirely inside; cut ones are
// integrated over slices along z (closed form for a disc cut by the circle of a cylinder, Gauss points for a
// rectangle), with an error below 1e-4 of the sphere.
double clipped_volume(const Vector3 &centre, double radius, const Shape &shape);

struct TouchingPair {
  int first = 0, second = 0; // first < second
  double gap = 0;            // m, negative where they overlap
};
// All pairs of spheres closer than the given gap (m, >= 0), ordered by first, then second.
std::vector<TouchingPair> touching_pairs(const Specimen &specimen, double gap);

struct QualityMeasure {
  double gap_tolerance = 1e-3; // in mean radii: spheres this close touch
  // In mean radii: the core is the part further than this from every wall and end. Two diameters, because
  // layering at a flat wall decays over that length in a polydisperse packing.
  double core_margin = 4;
};

// Measures of a packing. Those of the core are NaN if the shape is too small to have one.
struct PackingQuality {
  std::size_t spheres = 0;
  double mean_radius = 0;              // m
  double packing_fraction = 0;         // volume of all spheres over that of the shape, overlaps counted twice
  double core_packing_fraction = 0;    // volume of spheres clipped to the core over that of the core
  std::size_t core_spheres = 0;        // centres in the core
  std::size_t contacts = 0;            // pairs within the gap tolerance
  double coordination_number = 0;      // 2 contacts / spheres
  double core_coordination_number = 0; // contacts per sphere with its centre in the core
  std::size_t rattlers = 0;            // spheres with fewer than four contacts, walls and ends counted
  double max_overlap = 0;              // in mean radii, of pairs
  double mean_overlap = 0;             // in mean radii, over the pairs that overlap; 0 without any
  double max_wall_overlap = 0;         // in mean radii
  // Directions of the contacts that lie in the core; of all if there is no core.
  std::vector<AxisCell> directions;
  double isotropy_chi_squared = 0;                   // of these; isotropic: 1 +- .11
  std::size_t touching_bottom = 0, touching_top = 0; // spheres within the gap tolerance of z = 0, z = height
  double cover_bottom = 0, cover_top = 0;            // area of their great circles over the cross section
};

// Throws std::invalid_argument if check_specimen() refuses the numbers of the specimen (empty, radii not
// positive, centres not finite), or if a tolerance or margin is negative.
PackingQuality judge_packing(const Specimen &specimen, const QualityMeasure &measure = {});

} // namespace platen::dem
