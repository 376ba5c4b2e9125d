// A bonded bar between its two ends: which spheres are clamped and loaded, and its measures as those of a
// perfect bar.
#pragma once

#include <vector>

#include "apps/bar/strength_of_materials.h"
#include "apps/scene/scene.h"
#include "dem/equilibrium.h"
#include "dem/model.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

// Spheres of one end, or of a slice.
struct BarEnd {
  std::vector<std::size_t> rows;
  double z = 0; // m, mean of their centres
};

// Mean motion of an end, as of a rigid body: m, and rad about z.
struct EndMotion {
  Vector3 moved;
  double twist = 0;
};

// How the bar is cut into parts, once it is packed. Spheres that hang together with the rest by no bond
// (loose in their cages) are no part of it: they carry nothing and stay where they are.
struct BarGeometry {
  std::vector<char> in_piece; // of each row: whether it belongs to the largest bonded piece
  std::size_t loose = 0;      // spheres that do not
  BarEnd low, high;           // within the depth of the end planes
  BarEnd quarter, half;       // slices at a quarter and half of the length from the upper end
  double mean_radius = 0;     // m, of all spheres
  // m, end planes of the perfect bar: a mean radius beyond the centres of the ends
  double bottom = 0, top = 0;
  double length() const { return top - bottom; } // m
  CrossSection bounding;                         // of the perfect bar
  // That carries forces (dem/measure/bond_network.h), and of inertia of rotation; of the middle half.
  CrossSection effective, mass;
  double mass_per_length = 0; // kg/m
  bool along_x = true;
};

// The perfect bar about a discrete one, after Andre et al. 2012, (12) and (13): length 2 R + mean z of the
// upper end - mean z of the lower one (their (12) adds the two means), and a section that lies a mean radius
// R outside the mean distance of the outermost centres, those within `depth` mean radii of the wall. Throws
// std::invalid_argument where an end holds no sphere.
BarGeometry measure_bar(const dem::Particles &particles, const dem::Bonds &bonds, const dem::Shape &shape,
                        double depth, bool along_x);

// Loads on an end: shares of a force by mass, and of a torque as a rigid body of these spheres would be
// turned: each takes (force) across its distance from the middle and (torque) about its own centre.
void add_force(dem::StaticCase &load, const dem::Particles &particles, const BarEnd &end,
               const Vector3 &force); // N
void add_torque(dem::StaticCase &load, const dem::Particles &particles, const BarEnd &end,
                double torque); // N m about z
// By least squares over the end, in the weights of the loads above, so that load times motion is the work.
EndMotion motion_of(const dem::Particles &particles, const BarEnd &end,
                    const std::vector<Vector3> &displacement, const std::vector<Vector3> &turn);
// The same of where the particles are now.
EndMotion motion_of(const dem::Particles &particles, const BarEnd &end);

} // namespace platen::apps
