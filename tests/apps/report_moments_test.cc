#include "apps/report/run_folder.h"

#include <gtest/gtest.h>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

// Samples one second apart; both platens alike.
CsvTable history_of(const std::vector<double> &stress) {
  CsvTable table;
  table.rows = stress.size();
  table.numbers["axial_stress_top_pa"] = table.numbers["axial_stress_bottom_pa"] = stress;
  for (std::size_t k = 0; k < stress.size(); ++k)
    table.numbers["time_s"].push_back(static_cast<double>(k));
  return table;
}

TEST(ReportMoments, the_stress_is_the_mean_of_both_platens) {
  CsvTable history = history_of({0, 10, 4});
  history.numbers["axial_stress_bottom_pa"] = {0, 6, 12};
  EXPECT_EQ(platen_stress(history), (std::vector<double>{0, 8, 8}));
}

TEST(ReportMoments, the_fall_to_eight_tenths_is_found_between_samples) {
  const Moments moments = moments_of(history_of({0, 60, 100, 90, 70, 20}));
  EXPECT_EQ(moments.peak_row, 2u);
  EXPECT_EQ(moments.peak_stress, 100);
  ASSERT_TRUE(moments.post_peak_time);
  EXPECT_DOUBLE_EQ(*moments.post_peak_time, 3.5); // halfway from 90 to 70
  EXPECT_EQ(moments.end_time, 5);
}

TEST(ReportMoments, a_dip_before_the_peak_is_no_fall) {
  const Moments moments = moments_of(history_of({0, 90, 40, 100, 85}));
  EXPECT_EQ(moments.peak_row, 3u);
  EXPECT_FALSE(moments.post_peak_time); // 85 is still above 80
}

TEST(ReportMoments, a_tension_test_has_its_peak_at_the_most_negative_stress) {
  const Moments moments = moments_of(history_of({0, -2, -4, -2}));
  EXPECT_EQ(moments.peak_stress, -4);
  ASSERT_TRUE(moments.post_peak_time);
  EXPECT_DOUBLE_EQ(*moments.post_peak_time, 2.4); // -3.2 on the way from -4 to -2
}

TEST(ReportMoments, the_peak_is_of_the_platens_along_the_axis_that_is_loaded) {
  CsvTable history = history_of({50, 50, 50, 50, 50});
  history.numbers["stress_left_pa"] = {0, 5, 11, 10, 2},
  history.numbers["stress_right_pa"] = {0, 5, 9, 12, 2};
  history.numbers["stress_front_pa"] = {0, 30, 10, 0, 0},
  history.numbers["stress_back_pa"] = {0, 32, 10, 0, 0};
  const Moments x = moments_of(history, 0), y = moments_of(history, 1);
  EXPECT_EQ(x.peak_row, 3u);
  EXPECT_EQ(x.peak_stress, 11);
  EXPECT_EQ(y.peak_row, 1u);
  EXPECT_EQ(y.peak_stress, 31);
}

TEST(ReportMoments, a_history_without_samples_is_refused) {
  EXPECT_THROW(moments_of(history_of({})), InputError);
}

} // namespace
} // namespace platen::apps::report
