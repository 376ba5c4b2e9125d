// What the spheres at a platen do to it: pressure and shear over the radius or the face, and where they stick
// or slide.
// Pictures need an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/sides.h"

namespace platen::apps::report {

// A contact with a platen, in its plane: (x, y) of top and bottom, (y, z) of left and right, (x, z) of front
// and back.
struct PlatenContact {
  double x, y;         // m
  double normal_force; // N, pressing
  double inward_shear; // N, on the specimen, towards the origin of the plane
  bool sliding;
  double shear_force = 0; // N, size
  double slip = 0;        // m, so far; 0 where the frame does not tell
};
using PlatenContacts = std::vector<PlatenContact>; // with one platen in one frame of contacts.pvd

// Contacts that press upwards are those of the bottom platen, and so on; those of a sleeve press sideways:
// they are no platen's as long as nobody asks for one there. Throws InputError where a field is missing.
PlatenContacts contacts_with(Side side, const Frame &frame);

// Means over rings of equal area from the axis to `radius` (m).
struct RingProfile {
  std::vector<double> middle;                 // m, radius that halves the ring's area
  std::vector<double> pressure, inward_shear; // Pa
};
RingProfile profile_of(const PlatenContacts &contacts, double radius, int rings);

// Pressure on both platens and shear on the ends of the specimen against the distance from the axis, in the
// frame nearest to the peak. Round specimens; the run must have contacts.
void draw_platen_profiles(const Run &run, const Extent &extent, const std::filesystem::path &png);
// Every sphere at a platen in the same frame, in the plane of each: whether it sticks or slides.
void draw_stick_and_slip(const Run &run, const Extent &extent, const std::filesystem::path &png);
// Pressure on each platen of a box over its face in the same frame, over the mean of the platen: in squares
// of about two spheres (mean radius in m) along each edge.
void draw_face_pressures(const Run &run, const Extent &extent, double radius,
                         const std::filesystem::path &png);

// Means of the normal force over squares, Pa; row by row from below, `columns` in a row.
struct FacePressure {
  int columns = 0, rows = 0;
  std::vector<double> pressure;
};
// Over a face from `low` to `high` (m); what lies beyond counts at its border.
FacePressure pressure_over(const PlatenContacts &contacts, std::array<double, 2> low,
                           std::array<double, 2> high, double square);

} // namespace platen::apps::report
