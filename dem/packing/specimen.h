// A packed specimen before it is bonded: sphere centres and radii inside a shape, and the contact of its end
// faces with flat platens. SI units, axis along z.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/pi.h"
#include "base/vector3.h"

namespace platen::dem {

enum class ShapeKind { cylinder, box, disc };

// A notch as a saw cuts it: from the lower face of a box at mid-length, through its full breadth along y.
struct Notch {
  double depth = 0; // m, along z; 0: none
  double width = 0; // m, along x; 0: a cut that removes nothing

  bool is_there() const { return depth > 0; }
  bool holds(const Vector3 &x) const { return x.z < depth && std::abs(x.x) < 0.5 * width; }
  // Whether the line from a to b passes the middle of the notch below its tip.
  bool parts(const Vector3 &a, const Vector3 &b) const {
    if ((a.x < 0) == (b.x < 0)) return false;
    return a.z + a.x / (a.x - b.x) * (b.z - a.z) < depth;
  }
};

// A cylinder of radius r and height h on 0 <= z <= h, axis x = y = 0; or a box [-lx/2, lx/2] x [-ly/2, ly/2]
// x [0, h]. (A bar is a box or cylinder that is long along z.) Or a disc on its rim: a cylinder of radius r
// along y, |y| <= w/2, on 0 <= z <= h = 2 r.
struct Shape {
  ShapeKind kind = ShapeKind::cylinder;
  double radius = 0;               // m, cylinder, disc
  double width_x = 0, width_y = 0; // m, box; for a disc: 2 r and its thickness
  double height = 0;               // m
  Notch notch = {};                // only of a box

  // m^2, by which a load along z is divided; for a disc pi r w, which gives 2 P / (pi D w).
  double cross_section() const {
    if (kind == ShapeKind::disc) return pi * radius * width_y;
    return kind == ShapeKind::cylinder ? pi * radius * radius : width_x * width_y;
  }
  double volume() const { // m^3
    if (kind == ShapeKind::disc) return cross_section() * radius;
    return cross_section() * height - notch.depth * notch.width * width_y;
  }
};

Shape cylinder(double radius, double height);             // m
Shape box(double width_x, double width_y, double height); // m
double surface_area(const Shape &shape);                  // m^2, ends included
Shape disc(double radius, double thickness);              // m
double lateral_perimeter(const Shape &shape);             // m, of the cross-section
double smallest_width(const Shape &shape);                // m: diameter, an edge, or the height
// Distance from a point to the nearest wall or end plane, or a notch, m; negative outside (there, for a box,
// the largest distance to a face plane).
double wall_clearance(const Shape &shape, const Vector3 &point);
Shape scaled(Shape shape, double factor); // every length
// For a box that is periodic along x, y and z: its edges (m), and the image in it of any point.
Vector3 periods(const Shape &box);
Vector3 within(const Shape &box, const Vector3 &point);
// Throws std::invalid_argument, naming the measure, unless every measure of the shape is positive and finite.
void require_valid(const Shape &shape);

struct Specimen {
  Shape shape;
  std::vector<Vector3> centre; // m
  std::vector<double> radius;  // m

  std::size_t size() const { return centre.size(); }
};

// A standing cylinder turned onto its rim; other shapes stay as they are.
Specimen laid_down(const Specimen &specimen);

// A bar that was packed along z, turned along x: the old x axis points up, y stays. Only boxes; others stay
// as they are.
Specimen laid_along_x(const Specimen &specimen);

// A box without the spheres whose centres lie in the notch; its shape has the notch, across which no bond is
// made then. A second call removes nothing. Throws std::invalid_argument for another shape, and unless depth
// and width are finite and not negative.
Specimen notched(const Specimen &specimen, const Notch &notch);

inline double sphere_volume(double radius) { // m^3
  return 4.0 / 3.0 * pi * radius * radius * radius;
}

struct BoundingBox {
  Vector3 low, high; // m
};
// Of the shape, or of the spheres (surfaces included; the origin without spheres).
BoundingBox bounding_box(const Shape &shape);
BoundingBox bounding_box(const Specimen &specimen);

double mean_radius(const Specimen &specimen);       // m, 0 without spheres
double smallest_radius(const Specimen &specimen);   // m, 0 without spheres
double largest_radius(const Specimen &specimen);    // m, 0 without spheres
double volume_of_spheres(const Specimen &specimen); // m^3, overlaps counted twice

// Problems of a specimen in plain words, one problem per entry, ids from 0; empty if there are none. Checked:
// as many radii as centres, radii positive and finite, centres finite, no two centres closer than 1e-9 of the
// smaller radius (they have no direction of contact), no sphere outside the shape by more than wall_tolerance
// (in mean radii). Stops after max_problems with a last line that counts the rest.
std::vector<std::string> check_specimen(const Specimen &specimen, double wall_tolerance = 1e-3,
                                        std::size_t max_problems = 10);

enum class EndPreparation {
  as_packed, // no change: a platen touches spheres where they are
  ground,    // as if sawn flat: all spheres near an end touch at once, each with its own zero gap
  // as ground, but the face lies below its end plane (depth_of_face)
  convex,
  concave,
  not_parallel,
  rough
};
enum class FacedEnds { top, bottom, both }; // which of them are not flat
inline bool are_ground(EndPreparation ends) {
  return ends != EndPreparation::as_packed;
}

// m, by which the end face of a cylinder or box lies below its end plane at a sphere's x and y; `height`, m,
// from the highest point of the face to the lowest. Convex and concave: of a sphere about the axis, at the
// rim (the corners of a box) and on the axis. Not parallel: increasing with x. Rough: of each sphere at
// random, uniform, from its place and `seed`. Ground and as packed: 0.
double depth_of_face(EndPreparation form, double height, const Shape &shape, const Vector3 &centre,
                     std::uint64_t seed = 0);

// Spheres seated on one end plane, in order of their number.
struct EndSeats {
  std::vector<int> particle;
  std::vector<double>
      offset; // m, gap at rest between the sphere's surface and the end plane; may be a little < 0
};

struct SpecimenEnds {
  EndSeats bottom, top; // at z = 0 and z = height of the shape
};

// The seats of both ends. Unless as packed: all spheres whose surface lies within end_layer mean radii of the
// plane, z
// - R for the bottom, height - z - R for the top; the layer determines how many spheres carry the platen
// (docs/glossary.md, End layer). As packed: none. A sphere may be seated on both ends.
// Throws std::invalid_argument unless end_layer is finite and not negative.
SpecimenEnds seat_ends(const Specimen &specimen, EndPreparation preparation, double end_layer);

} // namespace platen::dem
