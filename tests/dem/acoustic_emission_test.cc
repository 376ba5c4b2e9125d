// Cracks become events, and the number of events by size gives b back.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "dem/measure/acoustic_emission.h"

namespace platen::dem::acoustic_emission_test {
namespace {

// Even in (0, 1), the same on every machine.
class Dice {
public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double operator()() { return (static_cast<double>(random_()) + .5) / 4294967296.0; }

private:
  std::mt19937 random_;
};

// N(>= M) falls by 10^-b with each magnitude from `smallest` on.
std::vector<double> catalogue(double b, double smallest, int events, unsigned seed) {
  Dice dice(seed);
  std::vector<double> magnitudes;
  for (int k = 0; k < events; ++k)
    magnitudes.push_back(smallest - std::log10(dice()) / b);
  return magnitudes;
}

// Mean over twenty catalogues within two standard errors of the mean, and single ones scatter by what each
// states.
TEST(acoustic_emission, b_of_gutenberg_and_richter_comes_back) {
  for (const double b : {1., 1.5}) {
    const int catalogues = 20;
    double mean = 0, error = 0, square = 0;
    for (int k = 0; k < catalogues; ++k) {
      const BValue v = b_value(catalogue(b, -6.03, 1500, 100 + static_cast<unsigned>(k)));
      EXPECT_NEAR(v.error, b / std::sqrt(v.events), .2 * v.error); // Aki's
      EXPECT_NEAR(v.b, b, 3 * v.error);
      EXPECT_GT(v.events, 500);
      EXPECT_LT(v.limit, -5.6);
      mean += v.b / catalogues;
      error += v.error / catalogues;
      square += (v.b - b) * (v.b - b) / catalogues;
    }
    EXPECT_NEAR(mean, b, 2 * error / std::sqrt(catalogues)) << b;
    EXPECT_NEAR(std::sqrt(square), error, .3 * error) << b;
  }
}

// Small events that are missing must not flatten b.
TEST(acoustic_emission, what_is_missing_below_the_limit_does_not_count) {
  std::vector<double> magnitudes = catalogue(1, -6, 6000, 3);
  Dice dice(5);
  magnitudes.erase(
      std::remove_if(magnitudes.begin(), magnitudes.end(), [&](double m) { return dice() > (m + 6) / .5; }),
      magnitudes.end());
  const BValue found = b_value(magnitudes);
  EXPECT_NEAR(found.b, 1, 3 * found.error);
  BValueRules all;
  all.limit = -6;
  EXPECT_EQ(b_value(magnitudes, all).law, PowerLaw::not_followed);
}

TEST(acoustic_emission, a_given_limit_is_kept) {
  BValueRules rules;
  rules.limit = -5.5;
  const BValue v = b_value(catalogue(1, -6, 4000, 8), rules);
  EXPECT_EQ(v.limit, -5.5);
  EXPECT_NEAR(v.events, 4000 * std::pow(10, -.5), 3 * std::sqrt(1265));
  EXPECT_NEAR(v.b, 1, 3 * v.error);
}

TEST(acoustic_emission, few_events_give_no_b_and_their_number_as_the_reason) {
  const BValue few = b_value(catalogue(1, -6, 40, 1));
  EXPECT_EQ(few.law, PowerLaw::few_events);
  EXPECT_NE(reason_against(few).find("a b-value needs 50"), std::string::npos);
  EXPECT_NE(reason_against(few).find(std::to_string(static_cast<int>(few.events)) + " events"),
            std::string::npos);
  EXPECT_EQ(reason_against(b_value(catalogue(1, -6, 4000, 1))), "");
  for (const std::vector<double> &magnitudes :
       {std::vector<double>{}, catalogue(1, -6, 40, 1), std::vector<double>(200, -5.0), // all alike: no law
        std::vector<double>(200, std::nan(""))})
    EXPECT_TRUE(std::isnan(b_value(magnitudes).b));
}

// Numbers of events of M and more, counted, and by the law: alike at the ends of its range and near between.
void expect_line_on_curve(std::vector<double> magnitudes, const BValue &v) {
  ASSERT_EQ(v.law, PowerLaw::holds);
  std::sort(magnitudes.begin(), magnitudes.end());
  const auto counted = [&](double m) {
    return static_cast<double>(magnitudes.end() - std::lower_bound(magnitudes.begin(), magnitudes.end(), m));
  };
  EXPECT_NEAR(v.count(v.limit), counted(v.limit), 1e-9 * counted(v.limit));
  if (std::isfinite(v.upper)) {
    EXPECT_NEAR(v.count(v.upper), v.above, 1e-9 * v.events);
  }
  const double end = std::isfinite(v.upper) ? v.upper : v.limit + 1 / v.b; // of a decade
  for (double m = v.limit; m < end; m += .05)
    EXPECT_NEAR(v.count(m), counted(m), .04 * v.events) << m;
}

// A bound of the energy: the curve bends down before it, and b of all events would be too large.
TEST(acoustic_emission, a_catalogue_cut_off_above_gives_its_b) {
  std::vector<double> magnitudes = catalogue(1, -6, 4000, 21);
  magnitudes.erase(std::remove_if(magnitudes.begin(), magnitudes.end(), [](double m) { return m > -4.6; }),
                   magnitudes.end());
  const BValue v = b_value(magnitudes);
  EXPECT_NEAR(v.b, 1, 2 * v.error);
  EXPECT_TRUE(std::isfinite(v.upper));
  EXPECT_LE(v.upper, -4.6);
  expect_line_on_curve(magnitudes, v);
  double mean = 0, n = 0;
  for (const double m : magnitudes)
    if (m >= v.limit) mean += m, ++n;
  EXPECT_GT(std::log10(std::exp(1)) / (mean / n - v.limit), 1 + 3 * v.error); // Aki's alone
}

TEST(acoustic_emission, of_two_slopes_the_range_of_one_is_named) {
  const double bend = -4.8;
  Dice dice(9);
  std::vector<double> magnitudes = catalogue(1, -6, 4000, 31);
  for (double &m : magnitudes)
    if (m > bend) m = bend - std::log10(dice()) / 3;
  const BValue v = b_value(magnitudes);
  EXPECT_NEAR(v.b, 1, 3 * v.error);
  EXPECT_NEAR(v.upper, bend, .25);
  EXPECT_GT(v.above, 0);
  expect_line_on_curve(magnitudes, v);
}

TEST(acoustic_emission, a_law_without_an_end_passes_through_its_curve) {
  const std::vector<double> magnitudes = catalogue(1.2, -6, 1500, 41);
  const BValue v = b_value(magnitudes);
  EXPECT_TRUE(std::isinf(v.upper));
  EXPECT_EQ(v.above, 0);
  expect_line_on_curve(magnitudes, v);
}

// Exponential in the energy or in the amplitude, its root, and evenly spread energies, which are the more
// frequent the larger they are: no power laws.
TEST(acoustic_emission, what_follows_no_power_law_has_no_b) {
  for (const int events : {1000, 8000})
    for (const int form : {0, 1, 2}) {
      Dice dice(50 + static_cast<unsigned>(form));
      std::vector<double> magnitudes;
      for (int k = 0; k < events; ++k) {
        const double even = dice(), exponential = -std::log(even);
        magnitudes.push_back(magnitude_of(1e-6 * (form == 0   ? exponential
                                                  : form == 1 ? exponential * exponential
                                                              : even)));
      }
      const BValue v = b_value(magnitudes);
      EXPECT_EQ(v.law, form == 2 ? PowerLaw::few_events : PowerLaw::not_followed)
          << events << " events, form " << form << ": b = " << v.b << " from " << v.limit << " to "
          << v.upper;
      EXPECT_TRUE(std::isnan(v.b) && std::isnan(v.error));
      EXPECT_NE(reason_against(v).find(form == 2 ? "needs 50" : "power law"), std::string::npos);
    }
}

// Two decades of a count that falls within a third of a decade of energy are no law of energies.
TEST(acoustic_emission, a_law_over_less_than_a_decade_of_energy_is_none) {
  EXPECT_EQ(b_value(catalogue(8, -6, 8000, 6)).law, PowerLaw::not_followed);
  EXPECT_EQ(b_value(catalogue(2, -6, 1000, 6)).law, PowerLaw::holds);
}

TEST(acoustic_emission, magnitude_grows_by_one_for_thirty_times_the_energy) {
  EXPECT_NEAR(magnitude_of(std::pow(10, 4.8)), 0, 1e-12);
  EXPECT_NEAR(magnitude_of(1e-3) - magnitude_of(1e-3 / std::pow(10, 1.5)), 1, 1e-12);
  EXPECT_TRUE(std::isnan(magnitude_of(0)));
}

const EventWindow window{.01, 1e-6}; // m, s

// Twenty cracks within the window of each other, in space and time.
std::vector<CrackPulse> burst(const Vector3 &centre, double time, unsigned seed) {
  Dice dice(seed);
  std::vector<CrackPulse> cracks;
  for (int k = 0; k < 20; ++k)
    cracks.push_back({time + .9 * window.time * dice(),
                      centre + .5 * window.reach * Vector3{dice() - .5, dice() - .5, dice() - .5},
                      1e-4 * dice()});
  return cracks;
}

TEST(acoustic_emission, two_bursts_apart_are_two_events) {
  const auto events_at = [](const Vector3 &place, double time) {
    std::vector<CrackPulse> cracks = burst({}, 1e-3, 1), second = burst(place, time, 2);
    cracks.insert(cracks.end(), second.begin(), second.end());
    return gather_events(cracks, window).size();
  };
  EXPECT_EQ(events_at({.05, 0, 0}, 1e-3), 2u);                // in space
  EXPECT_EQ(events_at({}, 1e-3 + 5 * window.time), 2u);       // in time
  EXPECT_EQ(events_at({.003, 0, 0}, 1e-3 + window.time), 1u); // neither
}

TEST(acoustic_emission, an_event_is_the_sum_of_its_cracks) {
  const std::vector<CrackPulse> cracks{{1, {0, 0, 0}, 3e-4}, {1 + 5e-7, {.006, 0, 0}, 1e-4}};
  const auto events = gather_events(cracks, window);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].cracks, 2);
  EXPECT_DOUBLE_EQ(events[0].time, 1);
  EXPECT_NEAR(events[0].duration, 5e-7, 1e-15);
  EXPECT_DOUBLE_EQ(events[0].energy, 4e-4);
  EXPECT_DOUBLE_EQ(events[0].centre.x, .0015);
  EXPECT_DOUBLE_EQ(events[0].size, .003);
  EXPECT_DOUBLE_EQ(events[0].magnitude, magnitude_of(4e-4));
}

// Single linkage: neighbours in a chain are one event, however long it is.
TEST(acoustic_emission, a_chain_of_neighbours_is_one_event) {
  std::vector<CrackPulse> chain;
  for (int k = 0; k < 30; ++k)
    chain.push_back({.9 * window.time * k, {.9 * window.reach * k, 0, 0}, 1e-4});
  EXPECT_EQ(gather_events(chain, window).size(), 1u);
  chain.erase(chain.begin() + 15);
  EXPECT_EQ(gather_events(chain, window).size(), 2u);
}

TEST(acoustic_emission, the_order_of_cracks_does_not_matter) {
  std::vector<CrackPulse> cracks;
  for (unsigned k = 0; k < 12; ++k) {
    const auto more = burst({.004 * k, 0, 0}, 1e-3 + 2.5 * window.time * k, k);
    cracks.insert(cracks.end(), more.begin(), more.end());
  }
  for (std::size_t k = 0; k < cracks.size(); k += 3)
    cracks[k].time = 1e-3; // of one step
  const auto first = gather_events(cracks, window);
  EXPECT_GT(first.size(), 1u);
  std::mt19937 random(4);
  std::shuffle(cracks.begin(), cracks.end(), random);
  const auto again = gather_events(cracks, window);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t k = 0; k < first.size(); ++k) {
    EXPECT_EQ(first[k].energy, again[k].energy);
    EXPECT_EQ(first[k].centre.x, again[k].centre.x);
    EXPECT_EQ(first[k].size, again[k].size);
  }
}

TEST(acoustic_emission, the_window_is_what_a_wave_crosses) {
  const EventWindow w = event_window(1.5e-3, 3000, 5, 2);
  EXPECT_DOUBLE_EQ(w.reach, 7.5e-3);
  EXPECT_DOUBLE_EQ(w.time, 2 * 7.5e-3 / 3000);
}

} // namespace
} // namespace platen::dem::acoustic_emission_test
