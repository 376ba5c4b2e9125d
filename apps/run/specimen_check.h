// Is what stands between the platens a specimen? Found before the first step.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/scene/scene.h"
#include "coupling/platen_test.h"
#include "dem/packing/specimen.h"

namespace platen::apps {

struct SpecimenState {
  std::size_t spheres = 0, bonds = 0;
  int pieces = 0;                       // of at least two spheres that bonds hold together
  int loose = 0;                        // spheres without a bond
  double largest_piece = 0;             // share of the bonded spheres
  bool spans = false;                   // it reaches both platens of the loaded axis, within `reach`
  double reach = 0;                     // m
  double deepest_overlap = 0;           // over the smaller of the two radii
  std::array<int, 2> deepest{{-1, -1}}; // the ids of these spheres
  std::array<double, 2> from_ends{}; // m, of the outermost sphere from the low and the high end of that axis
  std::vector<std::size_t> in_flaw;  // of each flaw: bonds that it cuts or weakens
  dem::SolidSection section;
  double mean_radius = 0;          // m
  double radius_asked = not_given; // m; NaN of spheres from a file
};

// Throws InputError, naming the entry, where there are fewer than four.
void require_spheres(const Scene &scene, const dem::Specimen &specimen);
// Of a test that has been set up and not stepped.
SpecimenState state_of(const Scene &scene, const dem::Specimen &specimen, const coupling::PlatenTest &test);
// Throws InputError, naming the entry, where it is none: no bonds where the scene
// has a bond law, pieces, a body that does not reach from platen to platen, spheres in one another.
void require_specimen(const Scene &scene, const SpecimenState &state);
// Lines for the screen at the start.
std::string text_of(const SpecimenState &state);
// "98 % of the shape's section, 97 to 99 % by height"; "" where nothing was measured.
std::string text_of(const dem::SolidSection &section);

} // namespace platen::apps
