// Dead zones: parts of a specimen that move with its platens while the stress falls; whether they are cones.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/archive.h"
#include "base/vector3.h"
#include "dem/measure/fragments.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Motion of a platen from one state to another; small rotations.
struct PlatenMotion {
  Vector3 displacement; // m, of the middle of its face
  Vector3 turn;         // rad, about that middle
};

// Motion from the peak (A) to where the stress first falls below .8 of it (B), or to the end.
struct MotionAfterPeak {
  std::vector<Vector3> displacement;   // m, of each sphere
  std::array<PlatenMotion, 2> platens; // [bottom_end], [top_end]
  bool known() const { return !displacement.empty(); }
};

struct DeadZoneRules {
  double still = 0.2;  // of the opening of the skin: largest motion of a dead sphere against the platen
  double gap = 0.05;   // of the smaller radius, between neighbours
  double reach = 0.5;  // mean radii: spheres whose surface is this near to the end plane touch the platen
  double bin = 1. / 6; // of the radius of the specimen
  double tip = 0.15;   // of the same: narrower bins are not fitted
  double sure_base = 0.8, least_base = 0.5;        // r0: a cone above the first, none below the second
  double largest_volume = 0.35;                    // of the specimen
  double least_angle = 0.17, largest_angle = 0.87; // rad: 10 and 50; a Mohr-Coulomb solid has 45 at most
  double largest_tilt = 0.44;                      // rad: 25 degrees
  double largest_offset = 0.7;                     // of the apex from the axis, of the specimen's radius
  double least_roundness = 0.65, least_straightness = 0.52, least_overlap = 0.7; // 1
};

// Why a dead zone is no cone: the first reason that holds.
enum class DeadZoneVerdict : std::int64_t {
  not_measured = 0,
  cone,
  nothing,         // no sphere that touches the platen moves with it
  small_base,      // r0 below `least_base`
  low,             // fewer than three bins
  large,           // the specimen moves with one platen
  blunt,           // full section over half of its height
  does_not_narrow, // half-angle outside the range: a column, or a layer
  leans,
  wedge,    // sections are not round
  ragged,   // no cone has its shape
  doubtful, // r0 between the bounds
  unbroken, // too few bonds around it have broken: the specimen barrels (failure_pattern.h)
  dome      // slope increases towards the platen: a cone without its tip, or none
};
const char *words_of(DeadZoneVerdict why);

// The dead zone on one platen; all is measured at the positions before the test.
//
// `base_ratio`, r0: in bins of a sixth of the specimen's radius Rc from the platen on, r = Rc sqrt(dead
// volume over volume); r0 is r of the first bin over Rc. For a box Rc is that of a circle with the area of
// its section, and a pyramid is reported as the cone of its volume. Half-angle and apex are those of a line
// through r against height, up to the last bin before r < .15 Rc; of the first bins that the rim cuts (r >
// .95 Rc) only the last counts. The axis is a line through the centres of the sections.
//
// `roundness`: shorter over longer axis of the sections that the rim does not cut, by their second moments,
// mean weighted by volume: 1 for a circle. `straightness`: slope of the flank in its lower half over that in
// its upper half, 1 at most, in bins half as high if there are fewer than eight: a dome is flat on top. Half
// ellipsoids of any height have .25 to .5, paraboloids .54 to .68, cones that were cut .9 and more.
// `overlap`: volume in dead zone and cone over that in either. `confidence` is the product of all three.
struct DeadZone {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  DeadZoneVerdict verdict = DeadZoneVerdict::not_measured;
  double spheres = 0;
  double base_ratio = unknown;      // r0
  double volume_fraction = unknown; // of all spheres
  double height = unknown;          // m, from the end plane to its highest surface within the bins
  double half_angle = unknown;      // rad
  double apex_depth = unknown;      // m, from the end plane to where the flanks meet
  double tilt = unknown;            // rad, between its axis and that of the specimen
  Vector3 apex;                     // m
  Vector3 axis;                     // 1, from the apex towards the platen
  double roundness = unknown, straightness = unknown, overlap = unknown, confidence = unknown;
  void describe(Archive &archive);
  bool is_cone() const { return verdict == DeadZoneVerdict::cone; }
};

struct DeadZones {
  double opening = std::numeric_limits<double>::quiet_NaN(); // m, U: largest of ten slices of the skin
  // Whether a sphere is dead and connected to an End's platen by dead neighbours; if to both, the nearer one.
  std::array<std::vector<char>, 2> members;
  std::array<DeadZone, 2> at_end; // [bottom_end], [top_end]
};

// `before` is the specimen before the test; the motion has one entry per sphere of it. For a disc, or if the
// skin has not opened, nothing is measured.
DeadZones find_dead_zones(const Specimen &before, const MotionAfterPeak &motion,
                          const DeadZoneRules &rules = {});

} // namespace platen::dem
