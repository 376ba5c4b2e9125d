// A number that is not finite is not passed over: neither where it is measured nor by a figure that rests on
// its column.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "apps/output/summary.h"
#include "apps/programs.h"
#include "apps/run/history.h"
#include "apps/run/problem_setup.h"
#include "apps/run/quasi_static.h"
#include "apps/run/results.h"
#include "apps/run/specimen_setup.h"
#include "apps/run/summary_of_run.h"
#include "apps/scratch_folder.h"
#include "base/largest.h"

namespace platen::apps {
namespace {

using namespace testing;

constexpr double infinite = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();

TEST(Largest, is_no_number_where_one_of_them_is_none) {
  EXPECT_TRUE(std::isnan(Largest().value()));
  const auto of = [](const std::vector<double> &values) {
    Largest largest;
    for (const double value : values)
      largest.add(value);
    return largest.value();
  };
  EXPECT_EQ(of({-3, -2, -5}), -2);
  EXPECT_EQ(of({2, infinite, 1}), infinite);
  for (const std::vector<double> &values :
       {std::vector<double>{nan, 1, 2}, {1, nan, 2}, {1, 2, nan}, {infinite, nan, 1}})
    EXPECT_TRUE(std::isnan(of(values)));
}

// A cylinder in a cell, of few spheres: what samples say of it is made up.
class NotFinite : public ::testing::Test {
protected:
  static Scene read(const std::vector<std::string> &more) {
    std::vector<std::string> overrides{"Specimen/Sphere radius = 2.2 mm", "Loading/Confinement = particles",
                                       "Loading/Confining pressure = 2 MPa"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return read_scene((std::filesystem::path(PLATEN_TEST_SCENES) / "crushed.prm").string(), overrides,
                      program("compress"));
  }
  explicit NotFinite(const std::vector<std::string> &more = {})
      : scene_(read(more)), problem_(make_bonded_specimen(scene_), problem_settings(scene_)) {}

  // Every column of a run to its peak and beyond: a consolidation of three rows, a peak of 30 MPa in row 14.
  std::vector<Sample> curve() {
    std::vector<Sample> samples;
    for (int row = 0; row < 24; ++row) {
      const double on = std::max(0, row - 2), share = on <= 12 ? on / 12 : 1 - 0.08 * (on - 12);
      Sample s;
      for (std::size_t k = 0; k < history_columns().size(); ++k)
        value_of(s, k) = 1e-3 * (row + 1);
      s.time = 1e-4 * row;
      s.cell_pressure = s.confining_pressure = 2e6 * std::min(1.0, 0.5 * row);
      s.stress_top = s.cell_pressure + 30.2e6 * share, s.stress_bottom = s.cell_pressure + 29.8e6 * share;
      s.strain_platen = 1e-4 + 2e-4 * on, s.strain_gauge = 9e-5 + 1.8e-4 * on;
      s.lateral_strain = -1e-5 - 4e-5 * on, s.volumetric_strain = 2e-4 * (row + 1);
      s.lateral_extremal = -1e-5 - 5e-5 * on, s.axial_extremal = 8e-5 + 1.9e-4 * on;
      s.broken_tension = on, s.broken_shear = 0, s.intact_bonds = 400 - on;
      s.kinetic = 1e-6 * (row + 1), s.bond = 1e-2 * (row + 1), s.contact = 2e-3, s.body = 0;
      s.boundary = 2e-2 * (row + 1), s.residual = 1e-5 * (row + 1), s.plastic = 0;
      s.unbalanced = row == 0 ? nan : 1e-3 * (1 + row % 5);
      s.platen_speed = 0.1 + 1e-3 * row, s.time_step = 1e-7;
      s.axial_stage = row > 2, s.cycling = 0, s.stage = 1;
      s.loads = 1, s.setting = 0, s.confined_fraction = 1;
      samples.push_back(s);
    }
    return samples;
  }
  Json summary(const std::vector<Sample> &samples) {
    Results results;
    for (const Sample &s : samples)
      results.add(s, problem_);
    results.finish(problem_, {1e-3, 1e-5});
    const RunCosts costs;
    return summary_of_run("done", {scene_, problem_, results, costs});
  }
  static bool is_there(const HistoryColumn &column, const coupling::PlatenTest &problem) {
    return column.there == nullptr || column.there(problem);
  }
  // Keys of the first summary whose values are others in the second; without what is of the specimen itself,
  // whenever it is looked at, and of the machine.
  static std::set<std::string> changed(const Json &a, const Json &b) {
    std::set<std::string> keys;
    const std::set<std::string> others{"validity",     "peak_memory_bytes",  "acoustic",
                                       "crack_planes", "final_crack_planes", "pattern_reasons",
                                       "crack_widths"};
    for (const auto &[key, value] : a.items())
      if (others.count(key) == 0 && value != b.at(key)) keys.insert(key);
    return keys;
  }

  Scene scene_;
  coupling::PlatenTest problem_;
};

// What rests on a column is found by changing its numbers: all of them, and each by itself.
TEST_F(NotFinite, no_figure_is_valid_that_rests_on_a_column_with_a_number_that_is_not_finite) {
  const std::vector<Sample> whole = curve();
  const Json good = summary(whole);
  for (const char *figure : {"strength_pa", "youngs_modulus_gauge_pa", "poisson_ratio", "bulk_modulus_pa",
                             "energy_residual_relative", "kinetic_to_internal_max", "inertial_number_max",
                             "unbalanced_force_median"})
    ASSERT_FALSE(good.at(figure).is_null()) << figure << ": " << good["validity"];
  const std::vector<std::size_t> rows{0, 1, 2, 4, 8, 14, 15, 23};
  std::set<std::string> resting; // on any column
  std::size_t columns = 0;
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    if (!is_there(column, problem_)) continue;
    ++columns;
    std::set<std::string> rest;
    const auto with = [&](const std::vector<std::size_t> &in, const auto &change) {
      std::vector<Sample> samples = whole;
      for (const std::size_t row : in)
        change(value_of(samples[row], k));
      return summary(samples);
    };
    std::vector<std::size_t> all(whole.size());
    for (std::size_t row = 0; row < all.size(); ++row)
      all[row] = row;
    rest.merge(changed(good, with(all, [](double &v) { v = 1.3 * v + 1e-6; })));
    for (const std::size_t row : rows)
      for (const double factor : {0.7, 1.2, 1.5})
        rest.merge(changed(good, with({row}, [&](double &v) { v = factor * v + 1e-6; })));
    resting.insert(rest.begin(), rest.end());
    for (const std::size_t row : rows)
      for (const double bad : {nan, infinite, -infinite}) {
        if (std::isnan(value_of(const_cast<Sample &>(whole[row]), k))) continue;
        // Forces of bonds count from a tenth of the peak to the peak.
        if (column.missing == HistoryColumn::Missing::without_forces && (row < 4 || row > 14)) continue;
        // The cell's pressure is 0 in row 0 alone.
        if (column.missing == HistoryColumn::Missing::without_pressure && row == 0 && std::isnan(bad))
          continue;
        const Json s = with({row}, [&](double &v) { v = bad; });
        for (const std::string &figure : rest) {
          EXPECT_TRUE(s.at(figure).is_null() ||
                      (s.at(figure).is_number_float() && !std::isfinite(s.at(figure).get<double>())))
              << figure << " = " << s.at(figure) << " with " << column.name << " = " << bad << " in row "
              << row;
          if (!s["validity"].contains(figure)) continue;
          const std::string words = s["validity"][figure].dump();
          EXPECT_TRUE(contains(words, std::string("not finite in ") + column.name)) << figure;
        }
      }
  }
  EXPECT_GT(columns, 25u);
  for (const char *figure :
       {"strength_pa", "strain_at_peak_gauge", "youngs_modulus_platen_pa", "poisson_ratio",
        "poisson_ratio_extremal", "bulk_modulus_pa", "energy_residual_relative", "quasi_static", "peak_is"})
    EXPECT_EQ(resting.count(figure), 1u) << figure;
}

// What a specimen has no spheres for, or a scene no ledger, is not measured, and speaks against nothing else.
TEST_F(NotFinite, what_is_not_measured_speaks_against_no_other_figure) {
  std::vector<Sample> samples = curve();
  for (Sample &s : samples)
    s.lateral_extremal = s.axial_extremal = nan;
  samples[1].unbalanced = nan;
  const Json s = summary(samples);
  EXPECT_TRUE(s["poisson_ratio_extremal"].is_null() ||
              !std::isfinite(s["poisson_ratio_extremal"].get<double>()));
  for (const char *figure : {"strength_pa", "youngs_modulus_gauge_pa", "poisson_ratio"})
    EXPECT_EQ(s["validity"][figure], "valid") << s["validity"];
  EXPECT_FALSE(s["quasi_static"].is_null());
}

class WithoutLedger : public NotFinite {
protected:
  WithoutLedger() : NotFinite({"Effects/Energy ledger = off"}) {}
};
TEST_F(WithoutLedger, energies_are_missing_and_speak_against_no_figure) {
  std::vector<Sample> samples = curve();
  for (Sample &s : samples)
    for (double *energy : {&s.kinetic, &s.bond, &s.contact, &s.body, &s.damping, &s.friction, &s.fracture,
                           &s.boundary, &s.residual, &s.plastic})
      *energy = nan;
  const Json s = summary(samples);
  EXPECT_EQ(s["validity"]["strength_pa"], "valid") << s["validity"];
  samples[9].bond = infinite;
  EXPECT_TRUE(contains(summary(samples)["validity"]["strength_pa"].dump(), "not finite in bond_energy_j"));
}

// Of a run that was cut off before its peak nobody knows how fast it would have come there.
TEST(Slow, is_not_judged_before_a_run_has_come_to_its_end) {
  for (const std::string by : {"signal", "failure", "script"})
    for (const std::string missed : {"", "; not reached: top stress of stage 1"})
      EXPECT_FALSE(knows_slowness(false, by + missed)) << by << missed;
  EXPECT_FALSE(knows_slowness(false, ""));
  for (const char *by : {"target", "target; not reached: top stress of stage 1", "stop at residual"})
    EXPECT_TRUE(knows_slowness(false, by)) << by;
}

// Each bound by itself: as much as is allowed, and a hundredth more.
TEST(Slow, is_what_keeps_each_bound) {
  const auto signs = [](double Slowness::*of, double value, bool bent = false) {
    Slowness s;
    s.*of = value;
    return reasons_not_quasi_static(s, bent).size();
  };
  for (const auto &[of, most] :
       {std::pair{&Slowness::kinetic, 0.005}, {&Slowness::unbalanced, 0.015}, {&Slowness::inertial, 1e-3}}) {
    EXPECT_EQ(signs(of, most), 0u) << most;
    EXPECT_EQ(signs(of, 1.01 * most), 1u) << most;
  }
  EXPECT_EQ(signs(&Slowness::wave_transits, 60), 0u);
  EXPECT_EQ(signs(&Slowness::wave_transits, 59.4), 1u);
  EXPECT_EQ(signs(&Slowness::wave_transits, 1, true), 0u);
}

// Each number of the engine that is none stops the run where it is measured.
TEST_F(NotFinite, a_number_of_the_engine_stops_the_run_by_the_name_of_its_column) {
  const Sampler sampler(problem_);
  problem_.advance(50);
  const auto words = [&] {
    try {
      sampler(problem_);
    } catch (const coupling::NumericsStopped &e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(words(), "");
  auto &layer = const_cast<coupling::ContactLayer &>(problem_.top().layer());
  for (const double bad : {nan, infinite}) {
    const double friction = layer.friction_work;
    layer.friction_work = bad;
    EXPECT_TRUE(contains(words(), "not finite: friction_work_j of history.csv is"));
    EXPECT_TRUE(contains(words(), "at step 50, time "));
    layer.friction_work = friction;
  }
  EXPECT_EQ(words(), "");
  problem_.model.particles.velocity[3].x = nan;
  EXPECT_TRUE(contains(words(), "not finite: kinetic_energy_j"));
}

} // namespace
} // namespace platen::apps
