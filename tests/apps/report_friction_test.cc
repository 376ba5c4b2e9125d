// Numbers behind the pictures of friction and of strips.
#include "apps/report/friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "apps/report/confinement.h"
#include "apps/report/strips.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

PlatenContact contact(double normal, double shear, double slip, bool sliding) {
  return {0, 0, normal, 0, sliding, shear, slip};
}

TEST(ReportFriction, what_presses_more_counts_more) {
  const FrictionState state = friction_state({contact(30, 3, 1e-3, true), contact(10, 1, 5e-3, false)});
  EXPECT_DOUBLE_EQ(state.sliding_share, 0.5);
  EXPECT_DOUBLE_EQ(state.mobilised, 0.1);
  EXPECT_DOUBLE_EQ(state.slip, 2e-3);
}

TEST(ReportFriction, where_nothing_presses_nothing_is_told) {
  EXPECT_TRUE(std::isnan(friction_state({}).mobilised));
  EXPECT_TRUE(std::isnan(friction_state({contact(0, 0, 0, true)}).sliding_share));
}

// Shear grows with the radius to a share of the pressure at the rim: its mean over a disc is two thirds of
// that.
TEST(ReportFriction, of_a_known_traction_it_is_the_mean) {
  const TestFolder folder;
  write_example(folder / "run", {});
  const report::Run run = read_run(folder / "run");
  for (const Side end : {Side::bottom, Side::top}) {
    const FrictionState state = friction_state(contacts_with(end, nearest(run.contacts, example_peak_time)));
    EXPECT_NEAR(state.mobilised, example_inward_shear * 2 / 3, 1e-3);
    EXPECT_NEAR(state.sliding_share, 1 - example_sticking_share, 1e-3);
    EXPECT_EQ(state.slip, 0); // frames of older versions do not tell
  }
  EXPECT_TRUE(tells_friction(run));
}

Run with_scene(const TestFolder &folder, const std::string &platens) {
  write_example(folder / "run", {});
  std::ofstream(folder / "run" / "scene.prm") << "subsection Platens\n" << platens << "end\n";
  return read_run(folder / "run");
}

TEST(ReportFriction, limits_are_those_of_the_side_else_of_all_platens) {
  const TestFolder folder;
  const report::Run run =
      with_scene(folder,
                 "  set Friction static = 0.57\n  set Friction dynamic = 0.4\n"
                 "  subsection Top\n    set Friction static = 0\n    set Friction dynamic = \n  end\n");
  EXPECT_EQ(friction_limits(run, Side::bottom).at_rest, 0.57);
  EXPECT_EQ(friction_limits(run, Side::bottom).sliding, 0.4);
  EXPECT_EQ(friction_limits(run, Side::top).at_rest, 0);
  EXPECT_EQ(friction_limits(run, Side::top).sliding, 0.4);
}

TEST(ReportFriction, limits_are_read_with_their_units) {
  const TestFolder folder;
  const report::Run run = with_scene(
      folder, "  set Friction static = 57 %\n  subsection Top\n    set Friction static = 5e-1 %\n  end\n");
  EXPECT_DOUBLE_EQ(friction_limits(run, Side::bottom).at_rest, 0.57);
  EXPECT_DOUBLE_EQ(friction_limits(run, Side::top).at_rest, 0.005);
}

TEST(ReportFriction, an_entry_that_is_no_such_number_is_refused_by_name) {
  const TestFolder folder;
  for (const char *text : {"0.5 MPa", "much", "0,57"}) {
    const report::Run run = with_scene(folder, std::string("  set Friction static = ") + text + "\n");
    try {
      friction_limits(run, Side::bottom);
      ADD_FAILURE() << text;
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(std::string("scene.prm: Platens/Friction static = ") + text),
                std::string::npos)
          << error.what();
    }
  }
}

TEST(ReportFriction, sliding_friction_that_is_not_said_is_the_static_one) {
  const TestFolder folder;
  const FrictionLimits limits =
      friction_limits(with_scene(folder, "  set Friction static = 0.3\n"), Side::left);
  EXPECT_EQ(limits.at_rest, 0.3);
  EXPECT_EQ(limits.sliding, 0.3);
}

TEST(ReportFriction, glued_ends_have_none) {
  const TestFolder folder;
  EXPECT_FALSE(tells_friction(with_scene(folder, "  set Attachment = glued\n")));
}

TEST(ReportStrips, the_load_along_a_strip_is_all_that_presses) {
  const PlatenContacts contacts{{0, -0.012, 10, 0, false}, {0, 0.001, 20, 0, false}, {0, 0.1, 30, 0, false}};
  const std::vector<double> load = load_along(contacts, 0.0125, 5);
  EXPECT_DOUBLE_EQ(load[0], 10 / 0.005);
  EXPECT_DOUBLE_EQ(load[2], 20 / 0.005);
  EXPECT_DOUBLE_EQ(load[4], 30 / 0.005); // what lies beyond counts at the end
  EXPECT_DOUBLE_EQ(std::accumulate(load.begin(), load.end(), 0.0) * 0.005, 60);
}

TEST(ReportStrips, scenes_say_whether_strips_press) {
  const TestFolder folder;
  EXPECT_TRUE(has_strips(with_scene(folder, "  set Strip width = 5 mm\n")));
  EXPECT_FALSE(has_strips(with_scene(folder, "  set Strip width = 0\n")));
  EXPECT_THROW(has_strips(with_scene(folder, "  set Strip width = 5 %\n")), InputError);
}

TEST(ReportConfinement, a_bare_test_has_no_cell) {
  const TestFolder folder;
  write_example(folder / "run", {});
  EXPECT_FALSE(has_cell(read_run(folder / "run")));
}

} // namespace
} // namespace platen::apps::report
