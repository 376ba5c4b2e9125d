// Fitted cones as the report draws them.
#include "apps/report/cones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace platen::apps::report {
namespace {

FittedCone upright(double half_angle, const std::array<double, 3> &apex, double down) {
  return {FittedCone::Verdict::found, half_angle, 1, apex, {0, 0, down}};
}

const Extent specimen{Extent::Form::cylinder, 0.025, 0, 0.1, 0.025};

TEST(ReportCones, through_its_axis_an_upright_cone_shows_a_triangle_cut_off_by_the_rim) {
  constexpr double half_angle = 0.6, tip = 0.05;
  const auto section = section_of(upright(half_angle, {0.002, 0, tip}, -1), Side::bottom, specimen);
  ASSERT_GT(section.size(), 10u);
  for (std::size_t k = 0; k < section.size(); ++k) {
    const auto [x, z] = section[k];
    const double side = k < section.size() / 2 ? -1 : 1,
                 flank = 0.002 + side * (tip - z) * std::tan(half_angle);
    EXPECT_NEAR(x, std::clamp(flank, -0.025, 0.025), 1e-9);
  }
  EXPECT_EQ(section.front()[1], 0);
  EXPECT_EQ(section.back()[1], 0);
}

TEST(ReportCones, points_of_the_section_of_a_leaning_cone_beside_the_plane_lie_on_its_flank) {
  FittedCone cone = upright(0.5, {0.001, -0.008, 0.06}, 1);
  cone.axis = {0.2, 0.1, std::sqrt(1 - 0.05)};
  const auto section = section_of(cone, Side::top, specimen);
  ASSERT_GT(section.size(), 10u);
  double lowest = 0.1;
  for (const auto &[x, z] : section) {
    lowest = std::min(lowest, z);
    if (std::abs(x) > 0.0249) continue; // held at the rim
    const double w[] = {x - 0.001, 0.008, z - 0.06};
    const double along = w[0] * cone.axis[0] + w[1] * cone.axis[1] + w[2] * cone.axis[2];
    EXPECT_NEAR(std::acos(along / std::hypot(w[0], w[1], w[2])), 0.5, 1e-6);
  }
  EXPECT_GT(lowest, 0.065); // beside the plane the tip is not cut
}

TEST(ReportCones, it_is_carried_by_the_most_of_its_spheres) {
  const FittedCone cone = upright(0.7, {0, 0, 0.05}, -1);
  Spheres spheres;
  const auto add = [&spheres](double x, double z, double moved) {
    spheres.initial.push_back({x, 0, z});
    spheres.position.push_back({x + moved, 0, z + 2 * moved});
  };
  for (int k = 0; k < 9; ++k)
    add(0.001 * k, 0.01, k == 0 ? 0.03 : 0.001); // one has fallen out
  for (int k = 0; k < 20; ++k)
    add(0.001 * k, 0.08, -0.01); // not of the cone
  for (auto *column : {&spheres.radius, &spheres.intact_bonds, &spheres.broken_bonds})
    column->resize(spheres.size(), 0.001);
  const auto moved = carried(cone, spheres);
  EXPECT_NEAR(moved[0], 0.001, 1e-12);
  EXPECT_NEAR(moved[1], 0, 1e-12);
  EXPECT_NEAR(moved[2], 0.002, 1e-12);
}

nlohmann::json told(double half_angle) {
  return {{"half_angle_deg", half_angle},
          {"confidence", 0.5},
          {"apex_m", {0.001, 0.0, 0.07}},
          {"axis", {0.0, 0.0, 1.0}}};
}

TEST(ReportCones, what_was_not_looked_for_is_not_told_as_absent) {
  using V = FittedCone::Verdict;
  report::Run run;
  const auto at = [&](Side end, ConeTime time) { return cone_of(run, end, time); };
  run.summary = {{"cone_top", nullptr}, {"cone_bottom", nullptr}}; // of a build that did not look
  EXPECT_EQ(at(Side::top, ConeTime::fall).verdict, V::not_measured);
  run.summary["pattern"] = "crushing"; // of one that looked by damage alone
  run.summary["cone_bottom"] = told(50);
  for (const Side end : {Side::top, Side::bottom})
    EXPECT_EQ(at(end, ConeTime::fall).verdict, V::not_measured);
  run.summary["dead_zone_top"] = nullptr; // the stress did not fall
  EXPECT_EQ(at(Side::top, ConeTime::fall).verdict, V::not_measured);
  run.summary["dead_zone_top"] = {{"base_ratio", 0.2}};
  EXPECT_EQ(at(Side::top, ConeTime::fall).verdict, V::none);
  EXPECT_EQ(at(Side::top, ConeTime::end).verdict, V::not_measured);
  run.summary["final_pattern"] = "cones";
  run.summary["final_cone_top"] = told(45);
  run.summary["final_dead_zone_top"] = {{"base_ratio", 0.9}};
  const FittedCone cone = at(Side::top, ConeTime::end);
  EXPECT_EQ(cone.verdict, V::found);
  EXPECT_NEAR(cone.half_angle, 0.785398, 1e-6);
  EXPECT_EQ(words_of(cone), "45 degrees (confidence 0.50)");
}

// Both apexes lie in it, and the axes: after the turn they are at y = 0.
TEST(ReportCones, the_cut_is_turned_to_the_axes) {
  FittedCone one = upright(0.5, {0.003, 0.004, 0.05}, -1), other = upright(0.5, {-0.006, -0.008, 0.05}, 1);
  one.axis = {0.06, 0.08, -std::sqrt(0.99)};
  const double angle = angle_of_axes({one, other, FittedCone{}}, 0.1);
  for (const FittedCone &cone : {one, other}) {
    const FittedCone seen = turned(cone, angle);
    EXPECT_NEAR(seen.apex[1], 0, 1e-12);
    EXPECT_NEAR(seen.axis[1], 0, 1e-12);
    EXPECT_NEAR(std::abs(seen.apex[0]), std::hypot(cone.apex[0], cone.apex[1]), 1e-12);
    EXPECT_EQ(seen.apex[2], cone.apex[2]);
  }
  EXPECT_EQ(angle_of_axes({FittedCone{}}, 0.1), 0);
}

// The apex lies along x, the axis leans along y: which of both counts more must not hang on the size.
TEST(ReportCones, the_cut_is_the_same_at_any_size) {
  const auto angle = [](double times) {
    FittedCone cone = upright(0.5, {0.006 * times, 0, 0.05 * times}, -1);
    cone.axis = {0.1, 0.2, -std::sqrt(0.95)};
    return angle_of_axes({cone}, 0.06 * times);
  };
  // 0.06 m high: the axis reaches 0.002 and 0.004 m aside over 0.02 m.
  EXPECT_NEAR(angle(1), 0.5 * std::atan2(2 * 0.002 * 0.004, 0.006 * 0.006 + 0.002 * 0.002 - 0.004 * 0.004),
              1e-12);
  for (const double times : {0.1, 10.0, 1e-3})
    EXPECT_NEAR(angle(times), angle(1), 1e-12) << times;
}

} // namespace
} // namespace platen::apps::report
