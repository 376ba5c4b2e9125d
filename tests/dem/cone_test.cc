// Cones cut out of packings of spheres are found and measured; what is no cone is not taken for one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "dem/measure/cone.h"
#include "dem/measure/cone_fit.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double degree = pi / 180;

std::array<ConePiece, 2> cones_of(const Cylinder &c) {
  return measure_cones(c.particles, c.bonds, find_sound_pieces(c.particles, c.bonds, c.shape), c.shape);
}

// A cone on an end plane, as a test cuts it; lengths in `radius`.
struct Wanted {
  double half_angle = 0, tilt = 0; // degrees
  double depth = 0;                // of the apex
  double rough = 0;                // spheres within this of the flank are in or out by chance
  double kept = 1;                 // share of its height
};

// Distance to the flank, of a point with z upwards from the end plane.
double to_flank(const Wanted &w, const Vector3 &x) {
  const double tilt = w.tilt * degree;
  // The axis passes at half its height through that of the specimen.
  const Cone cone{{.5 * w.depth * radius * std::tan(tilt), 0, w.depth * radius},
                  {-std::sin(tilt), 0, -std::cos(tilt)},
                  w.half_angle * degree};
  return cone.distance(x);
}

// Two of them on opposite ends, all else crushed.
void cut_cones(Cylinder &c, const Wanted &bottom, const Wanted &top) {
  std::mt19937 random(7);
  std::vector<double> chance(c.particles.size());
  for (double &u : chance)
    u = 2 * static_cast<double>(random()) / 4294967296.0 - 1;
  c.cut_rows([&](std::size_t row) {
    const auto in = [&](const Wanted &w, const Vector3 &x) {
      return to_flank(w, x) < w.rough * chance[row] * radius && x.z < w.kept * w.depth * radius;
    };
    Vector3 x = c.particles.reference_position[row];
    if (in(bottom, x)) return 1;
    x.z = c.height() - x.z;
    return in(top, x) ? 2 : Cylinder::crumbs;
  });
}

std::array<ConePiece, 2> cones_of(const Wanted &bottom, const Wanted &top) {
  Cylinder c;
  cut_cones(c, bottom, top);
  return cones_of(c);
}

void expect_cone(const ConePiece &found, const Wanted &wanted, const std::string &which) {
  EXPECT_TRUE(found.is_cone()) << which << words_of(found.verdict);
  EXPECT_NEAR(found.half_angle / degree, wanted.half_angle, 2) << which;
  EXPECT_NEAR(found.tilt / degree, wanted.tilt, 3) << which;
  EXPECT_GT(found.confidence, .8) << which;
  // The apex lies deeper than it seems by the skin that a cut takes: a radius, over the sine.
  EXPECT_NEAR(found.apex_depth / radius, wanted.depth, 1.5 / std::sin(wanted.half_angle * degree)) << which;
  const double height = wanted.kept * wanted.depth;
  EXPECT_LT(found.height / radius, height + 1.5) << which;
  EXPECT_GT(found.height / radius, wanted.kept < 1 ? height - 1 : .75 * height) << which;
}

TEST(cone, half_angle_and_tilt_of_a_cut_cone_are_found) {
  // Bases that end within the platen and bases that its rim cuts off.
  for (const auto &[angle, depths] :
       std::vector<std::pair<double, std::array<double, 2>>>{{20, {36, 36}}, {30, {31, 36}}, {40, {24, 36}}})
    for (const double tilt : {0., 5., 10.})
      for (const double rough : {0., 1.}) {
        const Wanted bottom{angle, tilt, depths[0], rough}, top{angle, tilt, depths[1], rough};
        const auto found = cones_of(bottom, top);
        const std::string which = std::to_string(angle) + " by " + std::to_string(tilt) + " ";
        expect_cone(found[bottom_end], bottom, which + "bottom ");
        expect_cone(found[top_end], top, which + "top ");
      }
}

// Cut off at half of its height, flanks alone say where the tip was.
TEST(cone, a_stump_is_measured_as_the_cone_that_it_was) {
  for (const auto &[angle, depth] : std::vector<std::pair<double, double>>{{20, 36}, {30, 32}}) {
    const Wanted bottom{angle, 0, depth, 0, .5}, top{angle, 10, depth, 1, .5};
    const auto found = cones_of(bottom, top);
    const std::string which = std::to_string(angle) + " stump ";
    expect_cone(found[bottom_end], bottom, which + "bottom ");
    expect_cone(found[top_end], top, which + "top ");
  }
}

// The piece is a share of the volume that integration gives, less the skin that the cut makes unsound.
TEST(cone, a_steeper_cone_holds_less) {
  const Wanted slender{20, 0, 36}, blunt{30, 0, 36};
  const auto found = cones_of(slender, blunt);
  const auto share = [](const Wanted &w) { // of the cylinder; the rim cuts neither much
    const double base = w.depth * std::tan(w.half_angle * degree);
    return base * base * w.depth / 3 / (Cylinder::width * Cylinder::width * Cylinder::length);
  };
  EXPECT_LT(found[bottom_end].volume_fraction, share(slender));
  EXPECT_GT(found[bottom_end].volume_fraction, .6 * share(slender));
  EXPECT_LT(found[top_end].volume_fraction, share(blunt));
  EXPECT_GT(found[top_end].volume_fraction, .6 * share(blunt));
}

// What the ends are called does not matter: a specimen upside down has its cones exchanged.
// The top one too, in the frame of the specimen.
TEST(cone, apex_and_axis_are_those_that_were_cut) {
  const Wanted bottom{30, 8, 30}, top{25, 5, 34};
  const auto found = cones_of(bottom, top);
  for (const auto &[end, wanted] : {std::pair{bottom_end, bottom}, std::pair{top_end, top}}) {
    const double up = end == bottom_end ? 1 : -1, tilt = wanted.tilt * degree,
                 plane = end == bottom_end ? 0 : Cylinder::length * radius;
    const Vector3 axis{-std::sin(tilt), 0, -up * std::cos(tilt)}, &apex = found[end].apex;
    EXPECT_GT(dot(found[end].axis, axis), std::cos(3 * degree)) << end;
    EXPECT_NEAR(apex.x, .5 * wanted.depth * radius * std::tan(tilt), 2 * radius) << end;
    EXPECT_NEAR(apex.y, 0, 2 * radius) << end;
    EXPECT_NEAR(up * (apex.z - plane), found[end].apex_depth, 1e-9 * radius) << end;
  }
}

TEST(cone, a_specimen_upside_down_has_the_same_cones) {
  const Wanted bottom{30, 5, 30}, top{25, 0, 34};
  Cylinder c;
  cut_cones(c, bottom, top);
  const auto upright = cones_of(c);
  for (Vector3 &x : c.particles.reference_position)
    x = {-x.x, x.y, c.height() - x.z};
  const auto turned = cones_of(c);
  EXPECT_NEAR(turned[top_end].half_angle, upright[bottom_end].half_angle, 1e-3);
  EXPECT_NEAR(turned[bottom_end].half_angle, upright[top_end].half_angle, 1e-3);
  EXPECT_NEAR(turned[top_end].apex_depth, upright[bottom_end].apex_depth, .02 * radius);
}

struct Shapeless {
  const char *what;
  std::function<int(const Vector3 &)> label; // lengths in `radius`
  NoCone bottom, top;
};

TEST(cone, none_is_invented) {
  constexpr double h = Cylinder::length, w = Cylinder::width;
  const auto plane = [](double angle, double thickness) { // through the middle
    return [=](const Vector3 &x) {
      const double d = (x.z - h / 2) * std::sin(angle * degree) - x.x * std::cos(angle * degree);
      return std::abs(d) < thickness / 2 ? Cylinder::crumbs : (d > 0 ? 1 : 2);
    };
  };
  const std::vector<Shapeless> all{
      {"intact", [](const Vector3 &) { return 1; }, NoCone::spans, NoCone::spans},
      {"four columns", [](const Vector3 &x) { return 2 * (x.x > 0) + (x.y > 0); }, NoCone::spans,
       NoCone::spans},
      {"columns with a crushed middle",
       [](const Vector3 &x) {
         return std::abs(x.z - h / 2) < 8 ? Cylinder::crumbs : 1 + (x.x > -7) + (x.x > 7) + 4 * (x.z > h / 2);
       },
       NoCone::does_not_narrow, NoCone::does_not_narrow},
      {"a pillar",
       [](const Vector3 &x) { return x.z < 34 && std::hypot(x.x, x.y) < 9 ? 1 : Cylinder::crumbs; },
       NoCone::does_not_narrow, NoCone::nothing_stands},
      {"crushed ends",
       [](const Vector3 &x) { return std::abs(x.z - h / 2) < h / 2 - 9 ? 1 : Cylinder::crumbs; },
       NoCone::nothing_stands, NoCone::nothing_stands},
      {"one crushed end", [](const Vector3 &x) { return x.z > 22 ? 1 : Cylinder::crumbs; },
       NoCone::nothing_stands, NoCone::blunt},
      {"skins", [](const Vector3 &x) { return std::abs(x.z - h / 2) > h / 2 - 4.5 ? 1 : Cylinder::crumbs; },
       NoCone::thin, NoCone::thin},
      {"a crumb",
       [=](const Vector3 &x) { return x.z < 8 && std::hypot(x.x - w / 2, x.y) < 4 ? 1 : Cylinder::crumbs; },
       NoCone::few_spheres, NoCone::nothing_stands},
      {"a crushed middle", [](const Vector3 &x) { return std::abs(x.z - h / 2) < 9 ? Cylinder::crumbs : 1; },
       NoCone::blunt, NoCone::blunt},
      {"nothing left", [](const Vector3 &) { return Cylinder::crumbs; }, NoCone::nothing_stands,
       NoCone::nothing_stands}};
  for (const Shapeless &s : all) {
    Cylinder c;
    c.cut([&](const Vector3 &x) { return s.label(x / radius); });
    const auto found = cones_of(c);
    EXPECT_EQ(words_of(found[bottom_end].verdict), words_of(s.bottom)) << s.what;
    EXPECT_EQ(words_of(found[top_end].verdict), words_of(s.top)) << s.what;
    EXPECT_EQ(found[top_end].confidence * found[top_end].is_cone(), 0) << s.what;
  }
  for (const double angle : {25., 32., 40.})
    for (const double thickness : {0., 6., 15.}) {
      Cylinder c;
      c.cut([&](const Vector3 &x) { return plane(angle, thickness)(x / radius); });
      for (const ConePiece &wedge : cones_of(c))
        EXPECT_FALSE(wedge.is_cone()) << angle << " " << thickness << " " << wedge.half_angle / degree;
    }
}

// Spheres that have kept less than the share are not of the piece.
TEST(cone, the_share_of_bonds_decides_what_is_sound) {
  Cylinder c;
  c.cut([&](const Vector3 &x) { return x.z < c.height() / 2 ? 1 : 2; });
  const auto volume = [&](double share) {
    const SoundPieces pieces = find_sound_pieces(c.particles, c.bonds, c.shape, {share, .5});
    EXPECT_FALSE(pieces.spans(pieces.at_end[bottom_end]));
    EXPECT_NE(pieces.at_end[bottom_end], pieces.at_end[top_end]);
    return pieces.share(pieces.at_end[bottom_end]) + pieces.share(pieces.at_end[top_end]);
  };
  EXPECT_GT(volume(.05), .99); // all that still hangs together
  EXPECT_GT(volume(.05), volume(.7));
  EXPECT_GT(volume(.7), volume(.99));
  EXPECT_GT(volume(.99), 1 - 6 * 2 / Cylinder::length); // without three radii along the cut
}

TEST(cone, a_disc_has_none) {
  Cylinder c;
  c.shape = disc(Cylinder::width * radius, Cylinder::length * radius);
  for (const ConePiece &piece : cones_of(c))
    EXPECT_EQ(piece.verdict, NoCone::not_measured);
}

} // namespace
} // namespace platen::dem
