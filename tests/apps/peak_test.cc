// A peak is reached where the stress has fallen to 98 % of it, or no longer gains.
#include "apps/run/peak.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

using Curve = std::vector<CurvePoint>;

// Readings of a stress (Pa) up to a strain.
Curve curve_of(const std::function<double(double)> &stress, double end = 0.01, int readings = 100) {
  Curve curve;
  for (int k = 0; k <= readings; ++k)
    curve.push_back({end * k / readings, stress(end * k / readings)});
  return curve;
}

PeakKind kind_of(const Curve &curve) {
  return judge_peak(curve).kind;
}

Curve by(coupling::Loads loads, Curve curve) {
  for (CurvePoint &point : curve)
    point.by = loads;
  return curve;
}

TEST(Peak, a_stress_that_rises_to_the_end_has_none) {
  const PeakOfCurve peak = judge_peak(curve_of([](double e) { return 20e9 * e; }));
  EXPECT_FALSE(peak.reached());
  EXPECT_DOUBLE_EQ(peak.largest, 2e8);
  EXPECT_DOUBLE_EQ(peak.strain_at_end, 0.01);
  EXPECT_NEAR(peak.gained, 0.25, 1e-12); // five fifths over four
  EXPECT_TRUE(contains(words_against(peak), "up to the strain of 0.01 "));
  EXPECT_TRUE(contains(words_against(peak), "gained 25 %"));
}

TEST(Peak, a_fall_by_two_percent_is_one_and_by_less_is_none) {
  const auto falls_to = [](double share) {
    Curve curve = curve_of([](double e) { return 20e9 * e; });
    curve.push_back({0.0101, share * 2e8});
    return curve;
  };
  EXPECT_EQ(kind_of(falls_to(0.979)), PeakKind::fallen);
  EXPECT_EQ(kind_of(falls_to(0.981)), PeakKind::none);
  EXPECT_EQ(words_against(judge_peak(falls_to(0.979))), "");
  EXPECT_DOUBLE_EQ(judge_peak(falls_to(0.979)).strain_of_largest, 0.01);
}

TEST(Peak, what_came_before_the_largest_stress_is_no_fall) {
  EXPECT_EQ(kind_of(curve_of([](double e) { return e < 0.003 ? 5e10 * e : 2e10 * e; })), PeakKind::none);
}

TEST(Peak, a_strain_that_goes_back_is_no_fall_but_while_it_is_led_by_how_it_widens) {
  Curve curve = curve_of([](double e) { return 20e9 * e; });
  curve.push_back({0.0099, 1e8});
  EXPECT_EQ(kind_of(curve), PeakKind::none);
  EXPECT_EQ(kind_of(by(coupling::Loads::by_stress, curve)), PeakKind::none);
  EXPECT_EQ(kind_of(by(coupling::Loads::by_widening, curve)), PeakKind::fallen);
}

TEST(Peak, neither_fall_nor_plateau_counts_before_damage) {
  Curve fallen = curve_of([](double e) { return 20e9 * e; });
  fallen.push_back({0.0101, 1e8});
  Curve flat = curve_of([](double e) { return std::min(1e8, 20e9 * e); });
  EXPECT_EQ(kind_of(flat), PeakKind::plateau);
  for (Curve *curve : {&fallen, &flat}) {
    for (CurvePoint &p : *curve)
      p.damaged = false;
    EXPECT_EQ(kind_of(*curve), PeakKind::none);
  }
}

// sigma = s (1 + a (e - 0.8 E) / (0.2 E)) in the last fifth gains a.
TEST(Peak, a_plateau_gains_less_than_a_percent_in_the_last_fifth_of_the_strain) {
  const auto gains = [](double share) {
    return curve_of([share](double e) {
      return e <= 0.008 ? std::min(1e8, 50e9 * e) : 1e8 * (1 + share * (e - 0.008) / 0.002);
    });
  };
  EXPECT_EQ(kind_of(gains(0.009)), PeakKind::plateau);
  EXPECT_EQ(kind_of(gains(0.011)), PeakKind::none);
  EXPECT_NEAR(judge_peak(gains(0.009)).gained, 0.009, 1e-9);
}

TEST(Peak, a_plateau_needs_three_readings_in_the_last_fifth) {
  const auto flat = [](double e) { return std::min(1e8, 100e9 * e); };
  EXPECT_EQ(kind_of(curve_of(flat, 0.01, 10)), PeakKind::none); // two
  EXPECT_EQ(kind_of(curve_of(flat, 0.01, 15)), PeakKind::plateau);
}

// What holds a stress that is asked has not reached its peak; what falls below it has.
TEST(Peak, a_stress_that_stays_as_it_is_asked_is_no_plateau) {
  const Curve flat = curve_of([](double e) { return std::min(1e8, 50e9 * e); });
  EXPECT_EQ(kind_of(flat), PeakKind::plateau);
  EXPECT_EQ(kind_of(by(coupling::Loads::by_widening, flat)), PeakKind::plateau);
  Curve asked = by(coupling::Loads::by_stress, flat);
  EXPECT_EQ(kind_of(asked), PeakKind::none);
  const std::string words = words_against(judge_peak(asked));
  EXPECT_TRUE(contains(words, "stayed at what was asked"));
  asked.push_back({0.0101, 0.97e8, true, coupling::Loads::by_stress});
  EXPECT_EQ(kind_of(asked), PeakKind::fallen);
  Curve rises = by(coupling::Loads::by_stress, curve_of([](double e) { return 20e9 * e; }));
  EXPECT_TRUE(contains(words_against(judge_peak(rises)), "gained 25 %"));
}

TEST(Peak, without_stress_there_is_none) {
  EXPECT_FALSE(judge_peak({}).reached());
  const PeakOfCurve pulled = judge_peak(curve_of([](double e) { return -1e9 * e; }));
  EXPECT_FALSE(pulled.reached());
  EXPECT_TRUE(contains(words_against(pulled), "bore nothing"));
}

} // namespace
} // namespace platen::apps
