// What moves with a platen after the peak: cones are found with their angles, all else is told from them.
#include "dem/measure/dead_zone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "dem/measure/cone.h"
#include "tests/dem/broken_specimens.h"

namespace platen::dem::dead_zone_test {
namespace {

using namespace examples;

constexpr double h = Cylinder::length, rc = Cylinder::width; // in `radius`

const Specimen &specimen() {
  static const Specimen made = [] {
    const Cylinder c;
    return specimen_before(c.particles, c.shape);
  }();
  return made;
}

DeadZones zones_of(const Field &field, const Vector3 &top = of_top) {
  return find_dead_zones(specimen(), motion_of(specimen(), field, top));
}

// A cone on a platen: half-angle and tilt in degrees, depth of its apex in `radius`.
struct Wanted {
  double half_angle = 0, depth = 0, tilt = 0;
  Cone cone(End end) const { // its axis passes at half its height through that of the specimen
    const double t = tilt * degree, up = end == top_end ? -1 : 1;
    return {{.5 * depth * std::tan(t), 0, end == top_end ? h - depth : depth},
            {-std::sin(t), 0, -up * std::cos(t)},
            half_angle * degree};
  }
  double base() const { return std::min(1.0, depth * std::tan(half_angle * degree) / rc); }
};

// Two cones, and the rest pushed outwards.
Field cones(const Wanted &bottom, const Wanted &top) {
  return [low = bottom.cone(bottom_end), high = top.cone(top_end)](const Vector3 &x) {
    return low.distance(x) < 0 ? of_bottom : high.distance(x) < 0 ? of_top : outwards(x) + half_way;
  };
}

void expect_cone(const DeadZone &found, const Wanted &wanted, End end, const std::string &which) {
  const Cone cone = wanted.cone(end);
  EXPECT_TRUE(found.is_cone()) << which << words_of(found.verdict);
  EXPECT_NEAR(found.half_angle / degree, wanted.half_angle, 2) << which;
  EXPECT_NEAR(found.base_ratio, wanted.base(), .1) << which;
  EXPECT_NEAR(found.apex_depth / radius, wanted.depth, 2) << which;
  EXPECT_NEAR(found.apex.z / radius, cone.apex.z, 2) << which;
  EXPECT_NEAR(found.apex.x / radius, cone.apex.x, 2) << which;
  EXPECT_NEAR(found.apex.y / radius, 0, 1.5) << which;
  EXPECT_GT(dot(found.axis, cone.axis), std::cos(3 * degree)) << which;
  EXPECT_NEAR(found.tilt / degree, wanted.tilt, 3) << which;
  EXPECT_GT(found.height / radius, .8 * wanted.depth) << which;
  EXPECT_LT(found.height / radius, wanted.depth + 1) << which;
  EXPECT_GT(found.confidence, .8) << which;
  if (wanted.base() < 1 && wanted.tilt == 0) { // the whole of it fits on the platen
    EXPECT_NEAR(found.volume_fraction / (wanted.base() * wanted.base() * wanted.depth / (3 * h)), 1, .1)
        << which;
  }
}

// As a cone is made it stands upright: what is below its apex is within.
TEST(dead_zone, a_cone_stands_on_its_base) {
  Cone cone;
  cone.apex = {0, 0, 10};
  cone.half_angle = 30 * degree;
  EXPECT_NEAR(cone.distance({0, 0, 6}), -4 * std::sin(30 * degree), 1e-12);
  EXPECT_NEAR(cone.distance({3, 0, 10}), 3 * std::cos(30 * degree), 1e-12);
  EXPECT_GT(cone.distance({0, 0, 14}), 0);
}

// Bases that end within the platen, and bases that the rim cuts.
TEST(dead_zone, half_angle_and_base_of_a_cone_are_found) {
  const std::vector<std::pair<Wanted, Wanted>> all{
      {{25, 44}, {35, 30}}, {{30, 34}, {30, 36}},       {{32, 34}, {28, 37}}, {{40, 28}, {35, 34}},
      {{30, 45}, {40, 24}}, {{30, 34, 8}, {35, 32, 5}}, {{22, 52}, {45, 21}}};
  for (const auto &[bottom, top] : all) {
    const DeadZones zones = zones_of(cones(bottom, top));
    const std::string which = std::to_string(bottom.half_angle) + " ";
    expect_cone(zones.at_end[bottom_end], bottom, bottom_end, which + "bottom ");
    expect_cone(zones.at_end[top_end], top, top_end, which + "top ");
    EXPECT_NEAR(zones.opening, .1 * radius, .01 * radius);
  }
}

// Volume of a cone whose base fits on the platen, over that of the specimen.
TEST(dead_zone, its_share_of_the_volume_is_that_of_the_cone) {
  for (const Wanted w : {Wanted{30, 34}, Wanted{25, 42}}) {
    const double share = w.base() * w.base() * w.depth / (3 * h);
    for (const DeadZone &zone : zones_of(cones(w, w)).at_end)
      EXPECT_NEAR(zone.volume_fraction / share, 1, .1);
  }
}

// Between .5 and .8 of the end nothing is decided, below there is none.
TEST(dead_zone, the_base_decides) {
  for (const auto &[wanted, verdict] :
       std::vector<std::pair<Wanted, DeadZoneVerdict>>{{{30, 31}, DeadZoneVerdict::cone},
                                                       {{26, 32}, DeadZoneVerdict::doubtful},
                                                       {{26, 26}, DeadZoneVerdict::doubtful},
                                                       {{20, 26}, DeadZoneVerdict::small_base}})
    for (const DeadZone &zone : zones_of(cones(wanted, wanted)).at_end)
      EXPECT_STREQ(words_of(zone.verdict), words_of(verdict)) << wanted.base() << " " << zone.base_ratio;
}

// No solid of Mohr and Coulomb leaves a cone of more than 45 degrees; what looks like one of up to 50 is
// taken.
TEST(dead_zone, what_is_wider_than_50_degrees_is_no_cone) {
  for (const auto &[wanted, verdict] : std::vector<std::pair<Wanted, DeadZoneVerdict>>{
           {{46, 20}, DeadZoneVerdict::cone}, {{57, 20}, DeadZoneVerdict::does_not_narrow}})
    for (const DeadZone &zone : zones_of(cones(wanted, wanted)).at_end) {
      EXPECT_STREQ(words_of(zone.verdict), words_of(verdict)) << zone.half_angle / degree;
      EXPECT_NEAR(zone.half_angle / degree, wanted.half_angle, 4); // the rim cuts most of its flank
    }
}

// Both platens go the same way further, and one leans: cones are what goes with them.
TEST(dead_zone, what_the_platens_do_by_themselves_is_taken_off) {
  const Wanted bottom{30, 34}, top{28, 37};
  MotionAfterPeak m = motion_of(specimen(), cones(bottom, top));
  const Vector3 carried{3 * radius, -radius, 2 * radius}, turn{.004, -.02, .01}, face{0, 0, h * radius};
  const Cone cone = top.cone(top_end);
  for (std::size_t i = 0; i < specimen().size(); ++i) {
    m.displacement[i] += carried;
    if (cone.distance(specimen().centre[i] / radius) < 0)
      m.displacement[i] += cross(turn, specimen().centre[i] - face);
  }
  for (PlatenMotion &platen : m.platens)
    platen.displacement += carried;
  m.platens[top_end].turn = turn;
  const DeadZones zones = find_dead_zones(specimen(), m);
  // What opens the skin is told of the specimen as a whole: it was carried by more than that.
  expect_cone(zones.at_end[bottom_end], bottom, bottom_end, "bottom ");
  expect_cone(zones.at_end[top_end], top, top_end, "top ");
}

TEST(dead_zone, it_hangs_on_the_platen_by_neighbours_that_are_dead) {
  const Cone cone = Wanted{30, 34}.cone(bottom_end);
  for (const double foot : {0., 3.}) { // left below a cone that is cut off from its platen
    const auto floating = [&](const Vector3 &x) {
      const bool stays = cone.distance(x) < 0 && (x.z > 7 || (x.z < foot && std::hypot(x.x, x.y) < 6));
      return stays ? of_bottom : outwards(x) + half_way;
    };
    const DeadZone zone = zones_of(floating).at_end[bottom_end];
    EXPECT_EQ(zone.verdict, foot > 0 ? DeadZoneVerdict::small_base : DeadZoneVerdict::nothing);
    EXPECT_LT(zone.spheres, 60);
    EXPECT_EQ(zone.spheres > 0, foot > 0);
  }
}

// All three components count, and .2 of the opening is the bound.
TEST(dead_zone, what_slides_or_sinks_beside_its_platen_is_not_dead) {
  for (const Vector3 &way : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}})
    for (const double far : {.15, .25}) {
      const Wanted w{30, 34};
      const DeadZones zones = zones_of([&, low = w.cone(bottom_end)](const Vector3 &x) {
        return low.distance(x) < 0 ? far * way : outwards(x) + half_way;
      });
      EXPECT_EQ(zones.at_end[bottom_end].is_cone(), far < .2) << far;
    }
}

// Half ellipsoids are told as domes however low. Paraboloids, which lie half-way, have not the confidence of
// a cone that was cut (above .8).
TEST(dead_zone, a_dome_is_told_from_a_cone) {
  const auto dome = [](double high, double power, double exponent) {
    return [=](const Vector3 &x) {
      const auto in = [&](double z) {
        return z < high &&
               std::hypot(x.x, x.y) < .95 * rc * std::pow(1 - std::pow(z / high, power), exponent);
      };
      return in(x.z) ? of_bottom : in(h - x.z) ? of_top : outwards(x) + half_way;
    };
  };
  for (const double high : {15., 20., 28., 35.}) {
    for (const DeadZone &zone : zones_of(dome(high, 2, .5)).at_end) {
      EXPECT_STREQ(words_of(zone.verdict), words_of(DeadZoneVerdict::dome)) << high;
      EXPECT_LT(zone.straightness, .5) << high;
      EXPECT_LT(zone.confidence, .5) << high;
      EXPECT_GT(zone.base_ratio, .9) << high;
    }
    for (const DeadZone &zone : zones_of(dome(high, 1, .5)).at_end)
      EXPECT_LT(zone.confidence, .75) << high << " " << words_of(zone.verdict);
  }
}

// Displacements alone do not tell a smooth barrel from cones: broken bonds do. More barrels are in
// false_cones_test.cc.
TEST(dead_zone, a_specimen_that_barrels_without_breaking_has_no_cones) {
  Cylinder c;
  std::mt19937 random(5);
  const auto verdicts = [&](double closes, double smooth) {
    const Field barrel = [=](const Vector3 &x) {
      const double s = x.z / h, out = std::pow(4 * s * (1 - s), smooth) * std::hypot(x.x, x.y) / rc;
      return out * outwards(x) + Vector3{0, 0, -closes * s};
    };
    return measure_failure(c.particles, c.bonds, c.shape, {}, motion_of(specimen(), barrel, {0, 0, -closes}));
  };
  // What it takes for one of them to be a cone: that the rest breaks.
  EXPECT_EQ(verdicts(.3, 2).dead[top_end].verdict, DeadZoneVerdict::unbroken);
  const auto break_share = [&](double share) {
    std::vector<char> gone(c.particles.size());
    for (char &g : gone)
      g = static_cast<double>(random()) / 4294967296.0 < share;
    c.cut_rows([&](std::size_t row) { return gone[row] ? Cylinder::crumbs : 1; });
  };
  break_share(.03); // of the spheres lose theirs: twice that of the bonds
  EXPECT_EQ(verdicts(.3, 2).dead[top_end].verdict, DeadZoneVerdict::unbroken);
  break_share(.1);
  EXPECT_TRUE(verdicts(.3, 2).dead[top_end].is_cone());
}

// A specimen upside down has its zones exchanged.
TEST(dead_zone, a_specimen_upside_down_has_the_same_cones) {
  const Wanted bottom{32, 34}, top{26, 40};
  const DeadZones upright = zones_of(cones(bottom, top));
  Specimen turned = specimen();
  MotionAfterPeak m = motion_of(turned, cones(bottom, top));
  for (Vector3 &x : turned.centre)
    x = {x.x, -x.y, h * radius - x.z};
  for (Vector3 &u : m.displacement)
    u = {u.x, -u.y, -u.z};
  for (PlatenMotion &platen : m.platens)
    platen.displacement.z *= -1;
  std::swap(m.platens[bottom_end], m.platens[top_end]);
  const DeadZones found = find_dead_zones(turned, m);
  for (const auto &[one, other] : {std::pair{bottom_end, top_end}, std::pair{top_end, bottom_end}}) {
    const DeadZone &before = upright.at_end[one], &after = found.at_end[other];
    EXPECT_NEAR(after.half_angle, before.half_angle, .01);
    EXPECT_NEAR(after.apex.z, h * radius - before.apex.z, .3 * radius);
    EXPECT_NEAR(after.axis.z, -before.axis.z, 1e-3);
    EXPECT_EQ(found.members[other], upright.members[one]);
  }
}

// Of a box the radius is that of a circle as large as its section.
TEST(dead_zone, a_pyramid_in_a_box_is_told_as_the_cone_of_its_volume) {
  Specimen box = specimen();
  const double side = 1.3 * rc; // within the cylinder
  box.shape = dem::box(side * radius, side * radius, h * radius);
  box.centre.clear(), box.radius.clear();
  for (std::size_t i = 0; i < specimen().size(); ++i) {
    const Vector3 &x = specimen().centre[i];
    if (std::max(std::abs(x.x), std::abs(x.y)) > .5 * side * radius) continue;
    box.centre.push_back(x), box.radius.push_back(specimen().radius[i]);
  }
  const double depth = 24, base = .48 * side; // of the pyramid: half a side
  const DeadZones zones =
      find_dead_zones(box, motion_of(box, [&](const Vector3 &x) {
                        const double wide = std::max(std::abs(x.x), std::abs(x.y));
                        const auto in = [&](double z) { return wide < base * (1 - z / depth); };
                        return in(x.z) ? of_bottom : in(h - x.z) ? of_top : outwards(x) + half_way;
                      }));
  for (const DeadZone &zone : zones.at_end) {
    EXPECT_TRUE(zone.is_cone()) << words_of(zone.verdict);
    EXPECT_NEAR(zone.half_angle, std::atan(2 * base / std::sqrt(pi) / depth), 3 * degree);
    EXPECT_NEAR(zone.base_ratio, .96, .1);
  }
}

TEST(dead_zone, nothing_is_measured_without_a_motion_or_of_a_disc) {
  EXPECT_EQ(find_dead_zones(specimen(), {}).at_end[top_end].verdict, DeadZoneVerdict::not_measured);
  const Field at_rest = [](const Vector3 &) { return Vector3{}; };
  EXPECT_EQ(zones_of(at_rest).at_end[top_end].verdict, DeadZoneVerdict::not_measured);
  Specimen lying = specimen();
  lying.shape = disc(rc * radius, h * radius);
  EXPECT_EQ(find_dead_zones(lying, motion_of(lying, cones({30, 34}, {30, 34}))).at_end[top_end].verdict,
            DeadZoneVerdict::not_measured);
}

} // namespace
} // namespace platen::dem::dead_zone_test
