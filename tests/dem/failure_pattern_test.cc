// One word for how a specimen has failed, and planes and directions of its broken bonds.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <tuple>

#include "dem/measure/cone.h"
#include "dem/measure/cracks.h"
#include "dem/measure/failure_pattern.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/examples.h"
#include "tests/same_state.h"

namespace platen::dem::failure_pattern_test {
namespace {

using namespace examples;

constexpr double h = Cylinder::length; // lengths in `radius`

// Which side of a plane through the middle, at an angle (degrees) to the axis; `unit` of places, m.
auto sides(double angle, double unit = radius) {
  return [=](const Vector3 &x) {
    const double z = x.z - h / 2 * unit;
    return z * std::sin(angle * degree) > x.x * std::cos(angle * degree) ? 1 : 2;
  };
}

struct Case {
  const char *what;
  std::function<int(const Vector3 &)> label;
  FailurePattern pattern;
  DecidedBy by;
  Field motion = {}; // none: nothing is known of it
};

TEST(failure_pattern, is_told_from_how_a_specimen_was_cut) {
  const Cone cone{{0, 0, 34}, {0, 0, -1}, 30 * degree};
  const auto between_cones = [&](const Vector3 &x) {
    const Vector3 mirrored{x.x, x.y, h - x.z};
    return cone.distance(x) < 0 || cone.distance(mirrored) < 0 ? 1 : Cylinder::crumbs;
  };
  const Field two_cones = [&](const Vector3 &x) {
    if (cone.distance(x) < 0) return of_bottom;
    return cone.distance({x.x, x.y, h - x.z}) < 0 ? of_top : outwards(x) + half_way;
  };
  const std::vector<Case> cases{
      {"intact", [](const Vector3 &) { return 1; }, FailurePattern::none, DecidedBy::few_broken},
      {"cones", between_cones, FailurePattern::cones, DecidedBy::two_cones, two_cones},
      {"cones that nobody saw move", between_cones, FailurePattern::undecided, DecidedBy::nothing},
      // Parts of it move with the platens, and the plane is looked at first.
      {"shear plane that moves as cones do", sides(30, 1), FailurePattern::shear_plane, DecidedBy::one_plane,
       two_cones},
      {"shear plane", sides(30, 1), FailurePattern::shear_plane, DecidedBy::one_plane},
      {"split in two", sides(0, 1), FailurePattern::splitting, DecidedBy::one_plane},
      {"split in four", [](const Vector3 &x) { return 2 * (x.x > 0) + (x.y > 0); }, FailurePattern::splitting,
       DecidedBy::columns},
      {"one end crushed", [](const Vector3 &x) { return x.z < 16 ? Cylinder::crumbs : 1; },
       FailurePattern::crushing, DecidedBy::crushed_end},
      {"all crushed", [](const Vector3 &) { return Cylinder::crumbs; }, FailurePattern::crushing,
       DecidedBy::crushed_end},
      // Torn across: nothing that compression does.
      {"two halves", [](const Vector3 &x) { return x.z < h / 2 ? 1 : 2; }, FailurePattern::none,
       DecidedBy::few_broken},
      {"a crushed middle between slabs",
       [](const Vector3 &x) { return std::abs(x.z - h / 2) < 9 ? Cylinder::crumbs : 1; },
       FailurePattern::undecided, DecidedBy::nothing}};
  for (const Case &one : cases) {
    Cylinder c;
    c.cut([&](const Vector3 &x) { return one.label(x / radius); });
    const MotionAfterPeak motion =
        one.motion ? motion_of(specimen_before(c.particles, c.shape), one.motion) : MotionAfterPeak{};
    const FailureVerdict verdict = judge_failure(measure_failure(c.particles, c.bonds, c.shape, {}, motion));
    EXPECT_STREQ(word_of(verdict.pattern), word_of(one.pattern)) << one.what;
    EXPECT_EQ(static_cast<int>(verdict.by), static_cast<int>(one.by)) << one.what;
  }
}

// Ends sound, the middle gone: by damage these were cones.
TEST(failure_pattern, two_planes_that_cross_are_no_cones) {
  for (const double angle : {25 * degree, 35 * degree})
    for (const double thick : {4., 8.}) {
      Cylinder c;
      c.cut([&](const Vector3 &x) { return part_of_cross(x / radius, angle, thick); });
      const FailureMeasures m =
          measure_failure(c.particles, c.bonds, c.shape, {},
                          motion_of(specimen_before(c.particles, c.shape), crossing_planes(angle, thick)));
      EXPECT_STRNE(word_of(judge_failure(m).pattern), "cones") << angle / degree << " " << thick;
      for (const DeadZone &zone : m.dead)
        EXPECT_STREQ(words_of(zone.verdict), words_of(DeadZoneVerdict::wedge));
    }
}

double &damage(FacetBond::State<double> &s) {
  return s.damage;
}
double &damage(ElastoDamagePlastic::State<double> &s) {
  return s.tension_damage;
}
// `by` of a midpoint in `radius`.
template <class Law>
void damage_bonds(Cylinder &c, const std::function<double(const Vector3 &)> &by) {
  for (std::size_t k = 0; k < c.bonds.size(); ++k) {
    auto remembered = c.bonds.memory<typename Law::template State<double>>(k);
    damage(remembered) = by(reference_midpoint(c.particles, c.bonds, k) / radius);
    c.bonds.set_memory(k, remembered);
  }
}

// Facets soften long before they fail: their mean damage counts. Interfaces count when they have failed.
TEST(failure_pattern, ends_and_middle_of_facets_are_judged_by_their_damage) {
  const auto of_place = [](const Vector3 &x) { return x.z < 15 ? .41 : x.z > h - 15 ? .3 : .05; };
  Cylinder facet(*facets().bond), interface(*interfaces().bond);
  damage_bonds<FacetBond>(facet, of_place), damage_bonds<ElastoDamagePlastic>(interface, of_place);
  FailureMeasures m = measure_failure(facet.particles, facet.bonds, facet.shape);
  EXPECT_NEAR(m.damage.end_bottom, .41, 1e-12);
  EXPECT_NEAR(m.damage.end_top, .3, 1e-12);
  EXPECT_NEAR(m.damage.middle, .05, 1e-12);
  EXPECT_EQ(judge_failure(m).by, DecidedBy::crushed_end);
  const FailureMeasures whole = measure_failure(interface.particles, interface.bonds, interface.shape);
  EXPECT_EQ(whole.damage.worse_end(), 0);
  EXPECT_EQ(judge_failure(whole).by, DecidedBy::few_broken);
  const auto judged = [&](double at_ends, double elsewhere) {
    damage_bonds<FacetBond>(facet, [=](const Vector3 &x) { return x.z < 15 ? at_ends : elsewhere; });
    m = measure_failure(facet.particles, facet.bonds, facet.shape);
    return judge_failure(m).by;
  };
  EXPECT_EQ(judged(.39, .05), DecidedBy::nothing);
  EXPECT_EQ(judged(.0201, .0201), DecidedBy::nothing);
  EXPECT_EQ(judged(.0199, .0199), DecidedBy::few_broken);
  EXPECT_NEAR(m.broken_fraction, .0199, 1e-12);
  damage_bonds<FacetBond>(facet, [](const Vector3 &) { return 0; });
  facet.cut([](const Vector3 &x) { return x.z < 15 * radius ? Cylinder::crumbs : 1; });
  EXPECT_EQ(measure_failure(facet.particles, facet.bonds, facet.shape).damage.end_bottom,
            1); // broken is lost
}

// A plane of failed facets decides where as much is lost in it as elsewhere.
TEST(failure_pattern, a_plane_of_facets_is_compared_with_all_that_is_lost) {
  for (const double angle : {0., 30.}) {
    Cylinder c(*facets().bond);
    c.cut(sides(angle));
    const double broken = static_cast<double>(c.bonds.initial_count() - c.bonds.size());
    for (const double share : {.9, 1.1}) { // lost elsewhere, over what is broken in the plane
      const double damage = share * broken / static_cast<double>(c.bonds.size());
      damage_bonds<FacetBond>(c, [=](const Vector3 &) { return damage; });
      const FailureMeasures m = measure_failure(c.particles, c.bonds, c.shape);
      EXPECT_NEAR(m.planes.broken, (1 + share) * broken, 1e-9 * broken);
      EXPECT_NEAR(m.broken_fraction, (1 + share) * broken / static_cast<double>(c.bonds.initial_count()),
                  1e-12);
      EXPECT_EQ(judge_failure(m).by == DecidedBy::one_plane, share < 1) << angle << " " << share;
      EXPECT_EQ(m.planes.steep_fraction > .5, angle == 0 && share < 1);
    }
  }
}

// A still zone is a cone if a tenth of what is around it is lost.
TEST(failure_pattern, cones_of_facets_lie_within_what_is_damaged) {
  const Cone cone{{0, 0, 34}, {0, 0, -1}, 30 * degree};
  const auto within = [&](const Vector3 &x) {
    return cone.distance(x) < 0 || cone.distance({x.x, x.y, h - x.z}) < 0;
  };
  const Field moved = [&](const Vector3 &x) {
    return !within(x) ? outwards(x) + half_way : x.z < h / 2 ? of_bottom : of_top;
  };
  Cylinder c(*facets().bond);
  for (const double around : {.09, .115}) {
    damage_bonds<FacetBond>(c, [&](const Vector3 &x) { return within(x) ? 0 : around; });
    const FailureMeasures m = measure_failure(c.particles, c.bonds, c.shape, {},
                                              motion_of(specimen_before(c.particles, c.shape), moved));
    EXPECT_EQ(judge_failure(m).pattern, around > .1 ? FailurePattern::cones : FailurePattern::undecided);
  }
}

// One end's cone may have lost its tip, not both.
TEST(failure_pattern, both_ends_decide) {
  using V = DeadZoneVerdict;
  for (const auto &[bottom, top, pattern] :
       std::vector<std::tuple<V, V, const char *>>{{V::cone, V::cone, "cones"},
                                                   {V::cone, V::dome, "cones"},
                                                   {V::dome, V::cone, "cones"},
                                                   {V::dome, V::dome, "undecided"},
                                                   {V::cone, V::large, "undecided"},
                                                   {V::doubtful, V::cone, "undecided"},
                                                   {V::cone, V::small_base, "undecided"}}) {
    FailureMeasures m;
    m.broken_fraction = .4;
    m.dead[bottom_end].verdict = bottom, m.dead[top_end].verdict = top;
    EXPECT_STREQ(word_of(judge_failure(m).pattern), pattern) << words_of(bottom) << ", " << words_of(top);
  }
}

TEST(failure_pattern, a_plane_decides_with_half_of_all_broken_bonds_across_the_specimen) {
  FailureMeasures m;
  m.broken_fraction = .4, m.width = .05;
  m.planes.count = 1, m.planes.broken = 1000;
  const auto decided = [&m](double bonds, double extent, double inclination) {
    m.planes.largest.bonds = bonds, m.planes.largest.extent = extent,
    m.planes.largest.inclination = inclination;
    return judge_failure(m).by == DecidedBy::one_plane;
  };
  EXPECT_TRUE(decided(500, .0451, 1.13));
  EXPECT_FALSE(decided(499, .0451, 1.13));
  EXPECT_FALSE(decided(500, .0449, 1.13));
  EXPECT_FALSE(decided(500, .0451, 1.131));
  m.planes.count = 0;
  EXPECT_FALSE(decided(500, .0451, 1.13));
}

// A cube between dry platens: its ends are damaged and stay where they are.
TEST(failure_pattern, an_end_that_did_not_spread_is_not_crushed) {
  FailureMeasures m;
  m.damage = {.45, .4, .55};
  m.broken_fraction = .5;
  m.end_spread = .18;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::undecided);
  m.end_spread = 1;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::crushing);
  m.end_spread = std::numeric_limits<double>::quiet_NaN(); // no skin left
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::crushing);
}

// As version 2 wrote it: the same, and what a sound piece on each platen was fitted by.
struct MeasuresOfVersionTwo {
  struct Cone {
    void describe(Archive &archive) {
      archive.version(1);
      std::int64_t verdict = 3;
      double number = .5;
      Vector3 vector{1, 2, 3};
      archive("verdict", verdict);
      for (const char *name : {"spheres", "volume_fraction", "overlap", "roundness", "confidence"})
        archive(name, number);
      for (const char *name : {"height", "apex_depth"})
        archive(name, number, "m");
      for (const char *name : {"half_angle", "tilt"})
        archive(name, number, "rad");
      archive("apex", vector, "m");
      archive("axis", vector);
    }
  };
  FailureMeasures measures;
  void describe(Archive &archive) {
    measures.describe(archive);
    Cone bottom, top;
    archive.part("cone_bottom", bottom);
    archive.part("cone_top", top);
  }
};

TEST(failure_pattern, states_with_cones_by_damage_are_read) {
  MeasuresOfVersionTwo old;
  old.measures.damage = {.45, .4, .55};
  old.measures.broken_fraction = .5;
  const State state = with_rows<std::int32_t>(state_of(old), "state/version", {2});
  FailureMeasures read;
  set_state(read, state);
  EXPECT_TRUE(same_state(old.measures, read));
  EXPECT_THROW(set_state(read, without(state, "cone_top")), StateError);
}

TEST(crack_planes, a_cut_through_the_specimen_is_one_plane_at_its_angle) {
  for (const double angle : {0., 30., 45., 90.}) {
    Cylinder c;
    c.cut(sides(angle));
    const auto planes = find_crack_planes(c.particles, c.bonds);
    const CrackPlanes sum = sum_up(planes, c.bonds);
    ASSERT_EQ(planes.size(), 1u) << angle;
    EXPECT_NEAR(planes[0].inclination / degree, angle, 1) << angle;
    EXPECT_NEAR(std::abs(planes[0].normal.x), std::cos(angle * degree), .02) << angle;
    EXPECT_GT(planes[0].flatness, .9) << angle;
    EXPECT_GT(sum.fraction, .98) << angle;
    EXPECT_EQ(sum.steep_fraction > .9, angle < 15) << angle;
    EXPECT_NEAR(norm(planes[0].centre - Vector3{0, 0, c.height() / 2}), 0, 2 * radius) << angle;
    // An ellipse with half-axes a and b has scatters a/2 and b/2.
    const double longer = std::max(1.0, 1 / std::max(.3, std::sin(angle * degree)));
    if (angle > 0)
      EXPECT_NEAR(planes[0].extent / radius, std::sqrt(12.) / 2 * Cylinder::width * longer, 6) << angle;
    else
      EXPECT_NEAR(planes[0].extent / radius, Cylinder::length, 6);
  }
}

TEST(crack_planes, planes_apart_are_counted_one_by_one) {
  Cylinder c;
  c.cut([&](const Vector3 &x) { return static_cast<int>(std::floor(x.z / c.height() * 4)); });
  const auto planes = find_crack_planes(c.particles, c.bonds);
  ASSERT_EQ(planes.size(), 3u);
  for (const CrackPlane &plane : planes)
    EXPECT_NEAR(plane.inclination, pi / 2, degree);
  EXPECT_GE(planes[0].bonds, planes[1].bonds);
  EXPECT_NEAR(sum_up(planes, c.bonds).mean_inclination, pi / 2, degree);
}

// In a specimen with a fifth of its bonds broken at random, a sheet in which all are broken is still found.
TEST(crack_planes, a_sheet_is_found_in_diffuse_damage) {
  Cylinder c;
  std::mt19937 random(2);
  break_where(c.bonds, c.particles,
              [&](const Vector3 &m) { return random() % 5 == 0 || std::abs(m.x) < 2 * radius; });
  const auto planes = find_crack_planes(c.particles, c.bonds);
  ASSERT_GE(planes.size(), 1u);
  EXPECT_LT(planes[0].inclination, 3 * degree);
  EXPECT_GT(planes[0].flatness, .7);
  EXPECT_GT(planes[0].extent, .9 * c.height());
}

TEST(crack_planes, an_intact_specimen_and_a_crushed_one_have_none) {
  Cylinder c;
  EXPECT_TRUE(find_crack_planes(c.particles, c.bonds).empty());
  EXPECT_TRUE(std::isnan(sum_up({}, c.bonds).fraction));
  c.cut([](const Vector3 &) { return Cylinder::crumbs; });
  EXPECT_TRUE(find_crack_planes(c.particles, c.bonds).empty());
  EXPECT_EQ(sum_up({}, c.bonds).fraction, 0);
}

TEST(crack_rose, cracks_that_face_all_directions_alike_give_one_everywhere) {
  CrackRose rose;
  const int n = 200000; // points of a spiral, even on the sphere
  for (int k = 0; k < n; ++k) {
    const double z = 1 - (2 * k + 1.0) / n;
    rose.add({std::sqrt(1 - z * z), 0, z}, 1e-6);
  }
  for (const double share : rose.over_isotropic())
    EXPECT_NEAR(share, 1, 1e-3);
}

TEST(crack_rose, counts_area_by_the_angle_to_the_axis_in_either_sense) {
  CrackRose rose;
  rose.add({0, 0, -1}, 3e-6); // across the specimen
  rose.add({1, 0, 0}, 1e-6);  // along it
  rose.add({std::sin(45 * degree), 0, -std::cos(45 * degree)}, 2e-6);
  EXPECT_EQ(rose.area[0], 3e-6);
  EXPECT_EQ(rose.area[4], 2e-6);
  EXPECT_EQ(rose.area[8], 1e-6);
  const auto share = rose.over_isotropic();
  EXPECT_NEAR(share[0], .5 / (1 - std::cos(10 * degree)), 1e-9);
  EXPECT_NEAR(share[8], 1. / 6 / std::cos(80 * degree), 1e-9);
  EXPECT_TRUE(std::isnan(CrackRose{}.over_isotropic()[0]));
}

} // namespace
} // namespace platen::dem::failure_pattern_test
