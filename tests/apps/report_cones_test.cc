// Fitted cones as the report draws them.
#include "apps/report/cones.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(ReportCones, what_was_not_looked_for_is_not_told_as_absent) {
  report::Run run;
  run.summary = {{"cone_top", nullptr}, {"cone_bottom", nullptr}}; // of a build that did not look
  EXPECT_EQ(cone_of(run, Side::top, ConeTime::fall).verdict, FittedCone::Verdict::not_measured);
  run.summary["pattern"] = "crushing";
  EXPECT_EQ(cone_of(run, Side::top, ConeTime::fall).verdict, FittedCone::Verdict::none);
  EXPECT_EQ(cone_of(run, Side::top, ConeTime::end).verdict, FittedCone::Verdict::not_measured);
  run.summary["final_pattern"] = "cones";
  run.summary["final_cone_top"] = {{"half_angle_deg", 45.0},
                                   {"confidence", 0.5},
                                   {"apex_m", {0.001, 0.0, 0.07}},
                                   {"axis", {0.0, 0.0, 1.0}}};
  const FittedCone cone = cone_of(run, Side::top, ConeTime::end);
  EXPECT_EQ(cone.verdict, FittedCone::Verdict::found);
  EXPECT_NEAR(cone.half_angle, 0.785398, 1e-6);
  EXPECT_EQ(words_of(cone), "45 degrees (confidence 0.50)");
}

} // namespace
} // namespace platen::apps::report
