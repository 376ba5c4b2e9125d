// The cones that stay on the platens when a specimen fails: how high, how steep, and whether there are any.
#pragma once

#include <array>
#include <cstdint>

#include "base/archive.h"
#include "base/vector3.h"
#include "dem/measure/fragments.h"

namespace platen::dem {

// Why a piece is no cone; the first that holds.
enum class NoCone : std::int64_t {
  not_measured = 0, // nothing was measured
  found,            // it is one
  nothing_stands,   // no sound sphere touches the platen
  spans,            // the piece goes on to the other platen
  few_spheres,      // less than `least_spheres`
  thin,             // lower than `least_height`: a skin, or crumbs
  blunt,            // full section over half of its height or more: the rest of a specimen broken elsewhere
  does_not_narrow,  // half-angle outside the range: a column, or a plate
  leans,            // its axis is not the specimen's
  one_sided,        // flanks do not go round: a wedge
  ragged            // no cone has its shape
};
const char *words_of(NoCone why);

// Where a cone ends and something else begins. Lengths in mean sphere radii.
struct ConeRules {
  int least_spheres = 40;
  double least_height = 6;
  double least_angle = 0.17, largest_angle = 1.05; // rad: 10 and 60 degrees
  double largest_tilt = 0.44;                      // rad: 25 degrees
  double largest_offset = 0.7;                     // of the apex from the axis, of the specimen's half-width
  double least_roundness = 0.55, least_overlap = 0.6; // 1
};

// A piece of sound spheres (fragments.h) on one platen, measured where its spheres were at the start:
// what it weighs and how it is cut does not change when it is carried away or turned.
//
// A cone is fitted to the piece (cone_fit.h) up to the slice in which it is narrower than four radii: what
// ends below a tip (a stump) is judged by its flanks alone. The fit begins from the slope of the equivalent
// radius, the median over all pairs of slices that the rim does not cut (Theil and Sen). For the fit the
// piece is counted with its skin, spheres that have lost too much to be sound and hang on it by two bonds or
// more, two layers deep: a clean cut makes spheres along it unsound, at edges more of them than on faces, and
// without them angles come out wrong by up to 4 degrees. (The volume is of sound ones.)
//
// `overlap`: volume of spheres in both piece and cone over that in either. `roundness`: share of twelve
// sectors about the cone's axis that have piece inside and something else outside within three radii of the
// flank, most of it on its right side. `confidence` is their product: 0.9 of a clean cut, 0.33 where a piece
// is just taken for a cone.
//
// Limits: half-angles come out within 2 degrees of a clean cut whose flanks are rough by a radius, where the
// specimen is 36 radii wide; of a stump, where it is 13 radii high; a stump of 9 radii is wrong by up to 5. A
// dome is taken for the cone that is nearest, a pyramid (of a box) too. Pieces of real runs are ragged, and
// judged by `confidence`. Sound pieces that touch in the middle are one that spans, and no cone.
struct ConePiece {
  NoCone verdict = NoCone::not_measured;
  double spheres = 0;         // skin included, as for the height
  double height = 0;          // m, from the end plane to the highest surface of a sphere
  double half_angle = 0;      // rad
  double volume_fraction = 0; // of all spheres that ever had a bond
  double apex_depth = 0;      // m, where the flanks meet, from the end plane
  double tilt = 0;            // rad, of the cone's axis to the specimen's
  Vector3 apex;               // m, where the specimen stood at the start
  Vector3 axis;               // 1, from the apex towards the platen
  double overlap = 0, roundness = 0, confidence = 0; // 1
  void describe(Archive &archive);
  bool is_cone() const { return verdict == NoCone::found; }
};

// [bottom_end], [top_end]. Of a cylinder or box; of a disc, which is pressed across, verdicts are
// `not_measured`.
std::array<ConePiece, 2> measure_cones(const Particles &particles, const Bonds &bonds,
                                       const SoundPieces &pieces, const Shape &shape,
                                       const ConeRules &rules = {});

} // namespace platen::dem
