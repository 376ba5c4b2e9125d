// The cones that a run found on its platens, by displacement, as outlines for pictures.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "apps/report/run_folder.h"
#include "apps/report/sides.h"

namespace platen::apps::report {

constexpr double degree = pi / 180;

// What the summary says of one end at one time.
struct FittedCone {
  enum class Verdict { not_measured, none, found };
  Verdict verdict = Verdict::not_measured;
  double half_angle = 0;        // rad
  double confidence = 0;        // 1
  Position apex{};              // m, in the specimen before the test
  std::array<double, 3> axis{}; // 1, from the apex towards the platen
};

enum class ConeTime { fall, end }; // at 0.8 of the peak; at the end of the run

// Of what moves with the platen after the peak. Summaries of builds that did not look for it, or did not say
// where it stands, give `not_measured`: those without `dead_zone_top` told other cones by the same keys.
FittedCone cone_of(const Run &run, Side end, ConeTime time);

// Angle (rad) about the specimen's axis of the plane through it that the apexes and axes of the cones lie
// nearest to, an axis as far as it reaches over a third of the specimen's `height` (m); 0 without cones.
double angle_of_axes(const std::vector<FittedCone> &cones, double height);
// The same cone in a frame that is turned by the angle.
FittedCone turned(FittedCone cone, double angle);
Position turned(const Position &place, double angle);

// Where the cone's flank meets the plane y = 0, from its end plane up one side over the tip and down the
// other, at most `extent.half_width` from the axis; as the specimen was before the test. Points are (x, z),
// m; empty where the cone does not meet the plane.
std::vector<std::array<double, 2>> section_of(const FittedCone &cone, Side end, const Extent &extent);

// How far the spheres within the cone have gone: medians, so that crumbs which fell out of it do not count;
// m. Zero without spheres.
Position carried(const FittedCone &cone, const Spheres &spheres);

// "55 degrees (confidence 0.68)", "no cone", "not measured".
std::string words_of(const FittedCone &cone);

} // namespace platen::apps::report
