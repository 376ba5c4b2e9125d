// One word for how a specimen has failed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dem/measure/cone_fit.h"
#include "dem/measure/failure_pattern.h"
#include "tests/dem/broken_specimens.h"
#include "tests/dem/examples.h"

namespace platen::dem {
namespace {

using namespace examples;

constexpr double h = Cylinder::length, degree = pi / 180; // lengths in `radius`

struct Case {
  const char *what;
  std::function<int(const Vector3 &)> label;
  FailurePattern pattern;
  DecidedBy by;
};

TEST(failure_pattern, is_told_from_how_a_specimen_was_cut) {
  const Cone cone{{0, 0, 34}, {0, 0, -1}, 30 * degree};
  const auto plane = [](double angle) {
    return [=](const Vector3 &x) {
      return (x.z - h / 2) * std::sin(angle * degree) > x.x * std::cos(angle * degree) ? 1 : 2;
    };
  };
  const std::vector<Case> cases{
      {"intact", [](const Vector3 &) { return 1; }, FailurePattern::none, DecidedBy::few_broken},
      {"cones",
       [&](const Vector3 &x) {
         const Vector3 mirrored{x.x, x.y, h - x.z};
         return cone.distance(x) < 0 || cone.distance(mirrored) < 0 ? 1 : Cylinder::crumbs;
       },
       FailurePattern::cones, DecidedBy::two_cones},
      {"shear plane", plane(30), FailurePattern::shear_plane, DecidedBy::one_plane},
      {"split in two", plane(0), FailurePattern::splitting, DecidedBy::one_plane},
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
    const FailureVerdict verdict = judge_failure(measure_failure(c.particles, c.bonds, c.shape));
    EXPECT_STREQ(word_of(verdict.pattern), word_of(one.pattern)) << one.what;
    EXPECT_EQ(static_cast<int>(verdict.by), static_cast<int>(one.by)) << one.what;
  }
}

// Ragged pieces that no cone fits: damage of ends and middle decides.
TEST(failure_pattern, an_hourglass_is_cones_without_cones) {
  FailureMeasures m;
  m.damage = {.1, .2, .6};
  m.broken_share = .4;
  for (ConePiece &piece : m.cones)
    piece.verdict = NoCone::ragged;
  EXPECT_EQ(judge_failure(m).by, DecidedBy::hourglass);
  m.damage.end_top = .35;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::undecided);
  m.damage.end_top = .5;
  EXPECT_EQ(judge_failure(m).by, DecidedBy::crushed_end);
  m.damage.end_top = .1;
  m.cones[top_end].verdict = NoCone::blunt;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::undecided);
}

// A cube between dry platens: its ends are damaged and stay where they are.
TEST(failure_pattern, an_end_that_did_not_spread_is_not_crushed) {
  FailureMeasures m;
  m.damage = {.45, .4, .55};
  m.broken_share = .5;
  m.end_spread = .18;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::undecided);
  m.end_spread = 1;
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::crushing);
  m.end_spread = std::numeric_limits<double>::quiet_NaN(); // no skin left
  EXPECT_EQ(judge_failure(m).pattern, FailurePattern::crushing);
}

} // namespace
} // namespace platen::dem
