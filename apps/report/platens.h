// What the spheres at a platen do to it: pressure and shear over the radius, and where they stick or slide.
// Pictures need an X server (display.h) and throw OutputError where the file cannot be written.
#pragma once

#include <filesystem>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// A contact with a platen.
struct PlatenContact {
  double x, y;         // m
  double normal_force; // N, pressing
  double inward_shear; // N, on the specimen, towards the axis
  bool sliding;
};
using PlatenContacts = std::vector<PlatenContact>; // with one platen in one frame of contacts.pvd

enum class PlatenEnd { bottom, top };

// Contacts that press upwards are those of the bottom platen, downwards those of the top one; those of a
// sleeve press sideways and are left out. Throws InputError where a field is missing.
PlatenContacts contacts_with(PlatenEnd end, const Frame &frame);

// Means over rings of equal area from the axis to `radius` (m).
struct RingProfile {
  std::vector<double> middle;                 // m, radius that halves the ring's area
  std::vector<double> pressure, inward_shear; // Pa
};
RingProfile profile_of(const PlatenContacts &contacts, double radius, int rings);

// Pressure on both platens and shear on the ends of the specimen against the distance from the axis, in the
// frame nearest to the peak. Round specimens; the run must have contacts.
void draw_platen_profiles(const Run &run, const Extent &extent, const std::filesystem::path &png);
// Every sphere at a platen in the same frame, seen along the axis: whether it sticks or slides.
void draw_stick_and_slip(const Run &run, const Extent &extent, const std::filesystem::path &png);

} // namespace platen::apps::report
