// Motions that are no cones, each of which somebody might take for them: not one is told as a cone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "base/pi.h"
#include "tests/dem/broken_specimens.h"
#include "tests/measured.h"

namespace platen::dem::false_cones_test {
namespace {

using namespace examples;

constexpr double h = Cylinder::length, rc = Cylinder::width; // in `radius`

using V = DeadZoneVerdict;
struct False {
  std::string what;
  Field field;
  std::vector<V> bottom = {}, top = {}; // any of them, by the motion alone; none: whatever is no cone
  bool broken = true;                   // much of the specimen, so that broken bonds alone do not decide
  Vector3 platen = of_top;
};

void add_bands(std::vector<False> &all) {
  for (const double angle : {18., 20., 22., 25., 27., 30., 31., 35.})
    for (const double thick : {0., 1., 4., 8.})
      all.push_back({"bands that cross " + std::to_string(angle) + " " + std::to_string(thick),
                     crossing_planes(angle * degree, thick),
                     {V::wedge},
                     {V::wedge}});
  const std::vector<V> of_band{V::large, V::leans, V::wedge, V::does_not_narrow};
  for (const double angle : {10., 15., 20., 25., 30., 35., 40., 45., 50.})
    for (const double thick : {2., 6.})
      all.push_back(
          {"one band " + std::to_string(angle) + " " + std::to_string(thick),
           [=](const Vector3 &x) {
             const double off = (x.z - h / 2) * std::sin(angle * degree) - x.x * std::cos(angle * degree);
             return std::abs(off) < thick / 2 ? Vector3{1, 0, 0} + outwards(x) : off > 0 ? of_top : of_bottom;
           },
           of_band, of_band});
}

// Half ellipsoids and what is blunter still, on both platens.
void add_domes(std::vector<False> &all) {
  for (const double high : {13., 15., 17., 20., 22., 25., 28., 31., 33., 35., 40.})
    for (const double power : {2., 3.})
      all.push_back({"domes " + std::to_string(high) + " " + std::to_string(power), [=](const Vector3 &x) {
                       const auto in = [&](double z) {
                         return z < high &&
                                std::hypot(x.x, x.y) < .97 * rc * std::sqrt(1 - std::pow(z / high, power));
                       };
                       return in(x.z) ? of_bottom : in(h - x.z) ? of_top : outwards(x) + half_way;
                     }});
}

// Smoothly, and nothing has broken.
void add_barrels(std::vector<False> &all) {
  for (const double closes : {.1, .3, .5, 1., 2.})
    for (const double smooth : {1., 2.})
      all.push_back({"a barrel " + std::to_string(closes) + " " + std::to_string(smooth),
                     [=](const Vector3 &x) {
                       const double s = x.z / h;
                       return std::pow(4 * s * (1 - s), smooth) * std::hypot(x.x, x.y) / rc * outwards(x) +
                              Vector3{0, 0, -closes * s};
                     },
                     {},
                     {},
                     false,
                     {0, 0, -closes}});
}

// All of it crumbles, without a place that holds.
void add_diffuse(std::vector<False> &all) {
  for (const unsigned seed : {1u, 2u, 3u})
    for (const double noise : {.1, .3, 1.})
      all.push_back({"crumbles " + std::to_string(noise),
                     [noise, random = std::mt19937(seed)](const Vector3 &x) mutable {
                       std::normal_distribution<double> by_chance;
                       const Vector3 crumb{by_chance(random), by_chance(random), by_chance(random)};
                       return std::hypot(x.x, x.y) / rc * outwards(x) + x.z / h * of_top + noise * crumb;
                     }});
}

// Pieces from platen to platen that part from each other: halves to eighths, bent, leaning, and shells.
void add_columns(std::vector<False> &all) {
  for (const int pieces : {2, 3, 4, 6, 8})
    for (const bool bent : {false, true})
      all.push_back({std::to_string(pieces) + (bent ? " columns that bend" : " columns that lean"),
                     [=](const Vector3 &x) {
                       const double turn = 2 * pi / pieces,
                                    way = (std::floor(std::atan2(x.y, x.x) / turn) + .5) * turn;
                       const double far = bent ? 4 * x.z / h * (1 - x.z / h) : 1 - x.z / h;
                       return far * Vector3{std::cos(way), std::sin(way), 0} + x.z / h * of_top;
                     }});
  for (const auto &[inner, verdict] : {std::pair{.4, V::small_base},
                                       {.6, V::does_not_narrow},
                                       {.7, V::does_not_narrow},
                                       {.8, V::does_not_narrow}})
    all.push_back({"a core of " + std::to_string(inner) + " between shells",
                   [inner = inner](const Vector3 &x) {
                     return (std::hypot(x.x, x.y) > inner * rc ? outwards(x) : Vector3{}) + x.z / h * of_top;
                   },
                   {verdict},
                   {verdict}});
  all.push_back({"halves that part all along",
                 [](const Vector3 &x) {
                   return Vector3{x.x < 0 ? -1. : 1., 0, 0} + x.z / h * of_top;
                 },
                 {V::nothing, V::small_base},
                 {V::nothing, V::small_base}});
  all.push_back({"quarters",
                 [](const Vector3 &x) {
                   return 4 * x.z / h * (1 - x.z / h) * Vector3{x.x < 0 ? -1. : 1., x.y < 0 ? -1. : 1., 0} +
                          x.z / h * of_top;
                 },
                 {V::low},
                 {V::low}});
  all.push_back({"spread evenly",
                 [](const Vector3 &x) { return std::hypot(x.x, x.y) / rc * outwards(x) + x.z / h * of_top; },
                 {V::small_base},
                 {V::small_base}});
}

// At both ends, and at one of them.
void add_layers(std::vector<False> &all) {
  for (const double high : {5., 12., 19., 30.})
    all.push_back({"layers " + std::to_string(high), [=](const Vector3 &x) {
                     return x.z < high ? of_bottom : h - x.z < high ? of_top : outwards(x) + half_way;
                   }});
  for (const auto &[high, verdict] : {std::pair{5., V::low}, {h / 4, V::blunt}, {h / 2, V::large}})
    all.push_back(
        {"a layer below " + std::to_string(high),
         [high = high](const Vector3 &x) { return x.z < high ? of_bottom : outwards(x) + half_way; },
         {verdict},
         {V::nothing}});
}

TEST(false_cones, not_one_of_them_is_told_as_a_cone) {
  std::vector<False> all;
  add_bands(all), add_domes(all), add_barrels(all), add_diffuse(all), add_columns(all), add_layers(all);
  EXPECT_GE(all.size(), 60u);
  const Cylinder whole;
  Cylinder broken;
  std::mt19937 random(7);
  std::vector<char> gone(broken.particles.size());
  for (char &g : gone)
    g = random() % 4 == 0;
  broken.cut_rows([&](std::size_t row) { return gone[row] ? Cylinder::crumbs : 1; });
  int cones = 0;
  const Specimen specimen = specimen_before(whole.particles, whole.shape);
  for (const False &one : all) {
    const Cylinder &c = one.broken ? broken : whole;
    const MotionAfterPeak motion = motion_of(specimen, one.field, one.platen);
    const FailureMeasures m = measure_failure(c.particles, c.bonds, c.shape, {}, motion);
    EXPECT_STRNE(word_of(judge_failure(m).pattern), "cones") << one.what;
    cones += judge_failure(m).pattern == FailurePattern::cones;
    const DeadZones zones = find_dead_zones(specimen, motion);
    for (const End end : {bottom_end, top_end}) {
      const DeadZone &zone = zones.at_end[end];
      const std::vector<V> &allowed = end == bottom_end ? one.bottom : one.top;
      const bool is_told = allowed.empty() || std::count(allowed.begin(), allowed.end(), zone.verdict) > 0;
      EXPECT_TRUE(!m.dead[end].is_cone() && is_told)
          << one.what << ", end " << end << ": " << words_of(zone.verdict) << ", r0 " << zone.base_ratio
          << ", half-angle " << zone.half_angle / degree << ", roundness " << zone.roundness
          << ", straightness " << zone.straightness << ", overlap " << zone.overlap;
    }
  }
  measured::note_figure(53, "motions_that_are_no_cones", static_cast<double>(all.size()), ">= 60");
  measured::note_figure(53, "of_them_told_as_cones", cones, "= 0");
}

} // namespace
} // namespace platen::dem::false_cones_test
