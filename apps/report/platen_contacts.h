// What the spheres at a platen do to it: pressure and shear over the radius, and where they stick or slide.
#pragma once

#include <array>
#include <vector>

#include "apps/report/frames.h"

namespace platen::apps::report {

// Contacts with one platen in one frame of contacts.pvd.
struct PlatenContacts {
  std::vector<double> x, y;         // m
  std::vector<double> normal_force; // N, pressing
  std::vector<double> inward_shear; // N, on the specimen, towards the axis
  std::vector<double> shear;        // N, size
  std::vector<bool> sliding;
  std::size_t size() const { return x.size(); }
  double sliding_share() const; // of the contacts; NaN without any
};

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

} // namespace platen::apps::report
