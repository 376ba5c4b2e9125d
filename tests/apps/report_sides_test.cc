// Stresses of all sides in a report: paths by closed forms, pressure over a face, strengths under two
// stresses, and their pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include "apps/report/biaxial.h"
#include "apps/report/platens.h"
#include "apps/report/report.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

// Stresses in Pa that rise together to a peak in the third of four rows and then fall to half; a column for
// each side that is given.
Run run_with(const std::string &name, double axial, const std::map<std::string, double> &sides,
             double pressure = 0) {
  Run run;
  run.name = run.title = name;
  const std::vector<double> shares{0, 0.5, 1, 0.5};
  const auto column = [&](const std::string &of, double peak) {
    for (const double share : shares)
      run.history.numbers[of].push_back(share * peak);
  };
  column("axial_stress_top_pa", 1.01 * axial), column("axial_stress_bottom_pa", 0.99 * axial);
  column("axial_strain_platen", 0.002), column("confining_pressure_pa", pressure);
  for (const auto &[side, stress] : sides) {
    column("stress_" + side + "_pa", stress);
    column("friction_work_" + side + "_j", 1.5);
  }
  run.history.numbers["time_s"] = {0, 1, 2, 3};
  run.history.rows = shares.size();
  run.moments = moments_of(run.history);
  return run;
}

TEST(ReportSides, platens_are_known_by_their_columns) {
  EXPECT_EQ(sides_of(run_with("two", 10, {})), (std::vector<Side>{Side::bottom, Side::top}));
  const report::Run four = run_with("four", 10, {{"front", 2}, {"back", 2}});
  EXPECT_EQ(sides_of(four), (std::vector<Side>{Side::bottom, Side::top, Side::front, Side::back}));
  EXPECT_TRUE(has_further_sides(four));
  EXPECT_FALSE(has_further_sides(run_with("cell", 10, {}, 3)));
}

TEST(ReportSides, stress_paths_are_those_of_closed_forms) {
  const auto at_peak = [](const report::Run &run) {
    const StressPath path = stress_path_of(run);
    return std::array<double, 2>{path.mean[2], path.deviator[2]};
  };
  const auto expect = [](std::array<double, 2> found, double p, double q) {
    EXPECT_NEAR(found[0], p, 1e-6);
    EXPECT_NEAR(found[1], q, 1e-6);
  };
  const double s = 30e6;
  expect(at_peak(run_with("uniaxial", s, {})), s / 3, s);
  expect(at_peak(run_with("biaxial", s, {{"left", s}, {"right", s}})), 2 * s / 3, s);
  expect(at_peak(run_with("in a cell", s, {}, s / 3)), 5 * s / 9, 2 * s / 3);
  expect(at_peak(run_with("hydrostatic", s, {{"left", s}, {"right", s}, {"front", s}, {"back", s}})), s, 0);
  // Opposite sides by their mean; shear: s, 0 and -s by q = sqrt(3) s about the mean.
  expect(at_peak(run_with("plane", 2 * s, {{"left", 0.8 * s}, {"right", 1.2 * s}})), s, std::sqrt(3.0) * s);
  EXPECT_FALSE(has_stress_path(run_with("uniaxial", s, {})));
  EXPECT_TRUE(has_stress_path(run_with("in a cell", s, {}, 1)));
  EXPECT_TRUE(has_stress_path(run_with("held", s, {{"left", 0}, {"right", 0}})));
}

TEST(ReportSides, the_table_has_a_row_for_each_platen) {
  const TableOfFigures table = table_of_sides(run_with("four", 20e6, {{"left", 3e6}, {"right", 4e6}}));
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"bottom", "19.80", "19.80", "-"}));
  EXPECT_EQ(table.rows[3], (std::vector<std::string>{"right", "4.00", "4.00", "0.75"})); // work at the end
}

TEST(ReportSides, pressure_over_a_face_is_force_over_area_and_loses_none) {
  PlatenContacts contacts;
  for (int k = 0; k < 100; ++k) // 2 N on each square centimetre of the left half
    for (int j = 0; j < 200; ++j)
      contacts.push_back({-0.1 + (k + 0.5) * 1e-3, (j + 0.5) * 1e-3, 0.02, 0, false});
  contacts.push_back({0.11, 0.05, 7, 0, false}); // beyond the border
  const FacePressure face = pressure_over(contacts, {-0.1, 0}, {0.1, 0.2}, 0.05);
  ASSERT_EQ(face.columns, 4);
  ASSERT_EQ(face.rows, 4);
  double force = 0;
  for (const double pressure : face.pressure)
    force += pressure * 0.05 * 0.05;
  EXPECT_NEAR(force, 100 * 200 * 0.02 + 7, 1e-9);
  for (int row = 0; row < 4; ++row) {
    EXPECT_NEAR(face.pressure[static_cast<std::size_t>(4 * row)], 2e4, 1e-6) << row;
    EXPECT_EQ(face.pressure[static_cast<std::size_t>(4 * row + 2)], 0) << row;
  }
  EXPECT_NEAR(face.pressure[4 + 3], 7 / 0.0025, 1e-6); // the second row from below, at the right
}

// Contacts at the rim of the example press to -x, as those of the right platen do.
TEST(ReportSides, contacts_of_a_side_are_told_by_their_direction_in_its_own_plane) {
  const TestFolder folder;
  write_example(folder / "run", {});
  const report::Run run = read_run(folder / "run");
  const Frame &frame = nearest(run.contacts, example_peak_time);
  const PlatenContacts right = contacts_with(Side::right, frame);
  ASSERT_EQ(right.size(), 5u);
  for (std::size_t k = 0; k < right.size(); ++k) {
    EXPECT_EQ(right[k].x, 0);                                     // y
    EXPECT_NEAR(right[k].y, 0.01 * static_cast<double>(k), 1e-9); // z
  }
  for (const Side side : {Side::left, Side::front, Side::back})
    EXPECT_TRUE(contacts_with(side, frame).empty()) << coupling::name_of(side);
}

Run between(const TestFolder &folder, Run run, const std::string &surface, const std::string &mesh = "") {
  run.folder = folder / run.name;
  std::filesystem::create_directories(run.folder);
  std::ofstream(run.folder / "scene.prm")
      << "subsection Platens\n  set Surface = " << surface
      << " # as used\n  subsection Top\n    set Surface = common\n    set Mesh file = " << mesh
      << "\n  end\nend\n";
  return run;
}

TEST(ReportSides, biaxial_strength_is_over_that_of_free_sides_between_the_same_platens) {
  const TestFolder folder;
  report::Run unbroken = run_with("unbroken", 45e6, {{"left", 9e6}, {"right", 9e6}});
  unbroken.moments.post_peak_time.reset();
  const BiaxialStrengths found = biaxial_strengths(
      {between(folder, run_with("both", 46e6, {{"left", 46e6}, {"right", 46e6}}), "brush"),
       between(folder, run_with("bare", 40e6, {}), "brush"),
       between(folder, run_with("stronger across", 20e6, {{"front", 48e6}, {"back", 48e6}}), "brush"),
       between(folder, run_with("other", 50e6, {{"left", 25e6}, {"right", 25e6}}), "dry steel"),
       between(folder, run_with("all", 80e6, {{"left", 9e6}, {"right", 9e6}, {"front", 8e6}, {"back", 8e6}}),
               "brush"),
       between(folder, unbroken, "brush"), between(folder, run_with("cell", 90e6, {}, 9e6), "brush")});
  ASSERT_EQ(found.points.size(), 3u);
  EXPECT_EQ(found.points[0].surface, "brush");
  EXPECT_NEAR(found.points[0].first, 1.15, 1e-12);
  EXPECT_NEAR(found.points[0].second, 1.15, 1e-12);
  EXPECT_NEAR(found.points[1].first, 1, 1e-12);
  EXPECT_EQ(found.points[1].second, 0);
  EXPECT_NEAR(found.points[2].first, 1.2, 1e-12);
  EXPECT_NEAR(found.points[2].second, 0.5, 1e-12);
  ASSERT_EQ(found.left_out.size(), 3u);
  EXPECT_NE(found.left_out[0].find("other has no run beside it"), std::string::npos);
  EXPECT_NE(found.left_out[1].find("all is pressed along three axes"), std::string::npos);
  EXPECT_NE(found.left_out[2].find("unbroken has not failed"), std::string::npos);
  EXPECT_TRUE(tells_envelope(found));
  // A brush that a mesh makes is no other brush's reference.
  const BiaxialStrengths pins = biaxial_strengths(
      {between(folder, run_with("bare", 40e6, {}), "brush"),
       between(folder, run_with("pins", 46e6, {{"left", 23e6}, {"right", 23e6}}), "brush", "meshes/pins.msh"),
       between(folder, run_with("bare pins", 46e6, {}), "brush", "meshes/pins.msh")});
  ASSERT_EQ(pins.points.size(), 3u);
  EXPECT_EQ(pins.points[0].surface, "brush");
  EXPECT_EQ(pins.points[1].surface, "brush, mesh pins");
  EXPECT_NEAR(pins.points[1].first, 1, 1e-12);
  EXPECT_FALSE(tells_envelope(biaxial_strengths({between(folder, run_with("bare", 40e6, {}), "brush")})));
}

// The example with columns of side platens after its own.
void add_sides(const std::filesystem::path &folder, double share) {
  std::istringstream before(text_of(folder / "history.csv"));
  std::ofstream after(folder / "history.csv");
  std::string line;
  std::getline(before, line);
  after << line << ",stress_left_pa,stress_right_pa,friction_work_left_j,friction_work_right_j\n";
  while (std::getline(before, line)) {
    std::istringstream fields(line);
    std::string field;
    for (int k = 0; k < 6; ++k)
      std::getline(fields, field, ',');
    const double axial = std::stod(field);
    after << line << ',' << share * axial << ',' << share * axial << ",0.1,0.2\n";
  }
}

TEST(ReportSides, every_picture_of_the_sides_is_drawn_where_there_are_any) {
  const TestFolder folder;
  write_example(folder / "held", {});
  write_example(folder / "bare", {});
  add_sides(folder / "held", 0.5);
  const auto run = [&](const std::string &arguments) {
    const std::string command = "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' " +
                                arguments + " >out.txt 2>error.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  };
  const auto drawn = [&](const std::string &where, const std::string &name) {
    return std::filesystem::exists(folder / where / name);
  };
  // Titles of their scenes differ by nothing: platens are alike.
  run("held --compare bare -o both");
  for (const char *name : {"side_stresses.png", "stress_path.png", "side_pressure.png", "stick_slip.png",
                           "comparison_stress_path.png", "comparison_biaxial.png"})
    EXPECT_TRUE(drawn("both", name)) << name;
  EXPECT_NE(text_of(folder / "out.txt").find("largest stress (MPa)"), std::string::npos);
  EXPECT_NE(text_of(folder / "both/report.html").find("<th>work of friction (J)</th>"), std::string::npos);
  run("bare -o one");
  for (const char *name : {"side_stresses.png", "stress_path.png", "side_pressure.png"})
    EXPECT_FALSE(drawn("one", name)) << name;
  EXPECT_EQ(text_of(folder / "one/report.html").find("work of friction (J)"), std::string::npos);
}

TEST(ReportSides, a_box_between_two_platens_has_its_pressure_and_its_sliding) {
  const TestFolder folder;
  ExampleRun box;
  box.square = true, box.spacing = 0.01;
  write_example(folder / "box", box);
  const std::string command = "cd '" + folder.path().string() +
                              "' && '" PLATEN_REPORT_PROGRAM "' box -o pictures >out.txt 2>error.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  for (const char *name : {"side_pressure.png", "stick_slip.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures" / name)) << name;
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/platen_pressure.png")); // rings are for round ends
}

} // namespace
} // namespace platen::apps::report
