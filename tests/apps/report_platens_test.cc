#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "apps/report/platens.h"
#include "apps/report/run_folder.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

TEST(ReportPlatens, profiles_are_those_of_a_known_traction_and_leave_out_the_sleeve) {
  const TestFolder folder;
  const ExampleRun example;
  write_example(folder / "run", example);
  const report::Run run = read_run(folder / "run");
  EXPECT_EQ(run.moments.peak_time, example_peak_time);
  for (const Side end : {Side::bottom, Side::top}) {
    const PlatenContacts contacts = contacts_with(end, nearest(run.contacts, example_peak_time));
    ASSERT_EQ(contacts.size(), 2000u);
    const auto sliding =
        std::count_if(contacts.begin(), contacts.end(), [](const PlatenContact &one) { return one.sliding; });
    EXPECT_NEAR(static_cast<double>(sliding) / 2000, 1 - example_sticking_share, 1e-3);
    const RingProfile profile = profile_of(contacts, example.radius, 5);
    ASSERT_EQ(profile.middle.size(), 5u);
    for (std::size_t ring = 0; ring < 5; ++ring) {
      EXPECT_NEAR(profile.pressure[ring] / example.peak_stress, 1, 1e-9);
      // Of a shear that grows with the radius the mean over a ring is that at its mean radius.
      const double inner = std::sqrt(0.2 * static_cast<double>(ring)),
                   outer = std::sqrt(0.2 * static_cast<double>(ring + 1));
      const double mean_radius = 2.0 / 3 * (outer * outer * outer - inner * inner * inner) / 0.2;
      EXPECT_NEAR(profile.inward_shear[ring] / example.peak_stress, example_inward_shear * mean_radius, 1e-4);
    }
  }
}

TEST(ReportPlatens, without_contacts_nothing_presses) {
  EXPECT_EQ(profile_of({}, 0.025, 3).pressure, std::vector<double>(3, 0.0));
}

} // namespace
} // namespace platen::apps::report
