// Studies of size, packing and rate, packings, bond tests and bars: each has its pictures and its page.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/report/other_results.h"
#include "apps/report/parameter_study.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

int report_on(const TestFolder &folder, const std::string &run) {
  const std::string command = "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' " + run +
                              " -o pictures >out.txt 2>error.txt";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

nlohmann::json spread(double mean, int runs = 3) {
  if (std::isnan(mean)) return {{"mean", nullptr}, {"deviation", nullptr}, {"runs", 0}};
  return {{"mean", mean},
          {"deviation", runs > 1 ? nlohmann::json(0.02 * mean) : nlohmann::json()},
          {"low", runs > 1 ? 0.98 * mean : mean},
          {"high", runs > 1 ? 1.02 * mean : mean},
          {"runs", runs}};
}

nlohmann::json one_case(const std::string &name, nlohmann::json labels, double strength, int runs = 3) {
  labels.update({{"name", name},
                 {"runs", runs},
                 {"failed", 0},
                 {"strength_pa", spread(strength, runs)},
                 {"youngs_modulus_gauge_pa", spread(24e9, runs)},
                 {"strain_at_peak_platen", spread(2.4e-3, runs)}});
  return labels;
}

void write_study(const TestFolder &folder, const std::string &kind, const nlohmann::json &cases) {
  folder.write(
      "study.json",
      nlohmann::json{{"kind", kind}, {"status", "done"}, {"runs", 9}, {"failed_runs", 0}, {"cases", cases}}
          .dump());
}

TEST(ReportOther, rates_are_of_strain_where_the_scene_tells_the_height) {
  const TestFolder folder;
  write_study(folder, "rate",
              {one_case("slow", {{"axial_rate_m_s", 0.03}}, 40e6),
               one_case("fast", {{"axial_rate_m_s", 0.24}}, 42e6)});
  EXPECT_EQ(read_parameter_study(folder.path()).columns.front().title, "Platen speed (mm/s)");
  folder.write("scene.prm", "subsection Specimen\n  set Height = 60 mm\nend\n");
  const ParameterStudy study = read_parameter_study(folder.path());
  ASSERT_EQ(study.columns.size(), 1u);
  EXPECT_EQ(study.columns.front().title, "Axial strain rate (1/s)");
  EXPECT_NEAR(study.cases[0].labels[0], 0.5, 1e-12);
  EXPECT_NEAR(study.cases[1].labels[0], 4, 1e-12);
  EXPECT_EQ(table_of(study).rows[0],
            (std::vector<std::string>{"slow", "0.5", "3", "-", "-", "39.2 ... 40.8, 3 packings",
                                      "23.52 ... 24.48, 3 packings", "-", "2.352 ... 2.448, 3 packings"}));
}

TEST(ReportOther, the_height_is_read_in_any_unit_of_length) {
  const TestFolder folder;
  write_study(folder, "rate",
              {one_case("slow", {{"axial_rate_m_s", 0.03}}, 40e6),
               one_case("fast", {{"axial_rate_m_s", 0.24}}, 42e6)});
  for (const char *height : {"6 cm", "0.06", "60000 um", "0.6 dm"}) {
    folder.write("scene.prm", std::string("subsection Specimen\n  set Height = ") + height + "\nend\n");
    EXPECT_NEAR(read_parameter_study(folder.path()).cases[0].labels[0], 0.5, 1e-12) << height;
  }
}

TEST(ReportOther, of_sizes_what_counts_is_how_many_spheres_lie_across) {
  const TestFolder folder;
  const auto size = [](double sphere, double radius) {
    return nlohmann::json{{"sphere_radius_m", sphere}, {"radius_m", radius}, {"height_m", 4 * radius}};
  };
  write_study(folder, "size",
              {one_case("a", size(0.0025, 0.015), 40e6), one_case("b", size(0.0015, 0.015), 42e6)});
  const ParameterStudy study = read_parameter_study(folder.path());
  EXPECT_EQ(study.columns.front().title, "Diameter of the specimen over that of a sphere");
  EXPECT_NEAR(study.cases[0].labels[0], 6, 1e-12);
  EXPECT_NEAR(study.cases[1].labels[0], 10, 1e-12);
}

// A case without a strength is named with the reasons of its runs, and its picture is drawn all the same.
TEST(ReportOther, a_case_without_a_figure_is_a_gap_with_its_reason) {
  const TestFolder folder;
  const auto gap = [](double value) {
    return nlohmann::json{{"gap_over_radius", value}, {"radius_multiplier", 1.0}};
  };
  write_study(folder, "packing",
              {one_case("gap_0.02", gap(0.02), 40e6), one_case("gap_0.05", gap(0.05), std::nan("")),
               one_case("gap_0.1", gap(0.1), 50e6)});
  for (const int seed : {1, 2}) {
    const std::string run = "runs/gap_0.05_seed_" + std::to_string(seed);
    std::filesystem::create_directories(folder / run);
    folder.write(
        run + "/summary.json",
        R"({"validity": {"strength_pa": ["the stress was still rising"], "poisson_ratio": "valid"}})");
  }
  ASSERT_EQ(report_on(folder, "."), 0) << text_of(folder / "error.txt");
  EXPECT_NE(
      text_of(folder / "out.txt")
          .find("gap_0.05: no strength_pa, 2 of 2 runs: the stress was still rising; a gap in the picture"),
      std::string::npos)
      << text_of(folder / "out.txt");
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/study_packing.png"));
  EXPECT_NE(text_of(folder / "pictures/report.html").find("the stress was still rising"), std::string::npos);
}

TEST(ReportOther, a_study_of_one_case_says_that_there_is_no_curve) {
  const TestFolder folder;
  write_study(folder, "rate", nlohmann::json::array({one_case("only", {{"axial_rate_m_s", 0.03}}, 40e6, 1)}));
  ASSERT_EQ(report_on(folder, "."), 0) << text_of(folder / "error.txt");
  EXPECT_NE(text_of(folder / "out.txt").find("one case: there is no curve to draw"), std::string::npos);
}

TEST(ReportOther, one_packing_has_no_scatter_and_several_have_bars) {
  EXPECT_EQ(words_of_scatter(1), "; one packing: no scatter known");
  EXPECT_EQ(words_of_scatter(5),
            "; bars: standard deviation over the packings, of fewer than five their range");
}

// Two spheres of radius 1 in a box 2 x 2 x 4, one on the other: each half holds one.
dem::Specimen two_spheres() {
  dem::Specimen specimen;
  specimen.shape.kind = dem::ShapeKind::box;
  specimen.shape.width_x = specimen.shape.width_y = 2, specimen.shape.height = 4;
  specimen.centre = {{0, 0, 1}, {0, 0, 3.02}};
  specimen.radius = {1, 1};
  return specimen;
}

TEST(ReportOther, slices_hold_the_volume_of_their_spheres) {
  dem::Specimen specimen = two_spheres();
  specimen.centre[1].z = 3;
  for (const int slices : {1, 2, 7, 40}) {
    const DensityProfile profile = density_profile(specimen, slices);
    double sum = 0;
    for (const double density : profile.density)
      sum += density * 4 * 4.0 / slices;
    EXPECT_NEAR(sum, 2 * 4 * pi / 3, 1e-12) << slices;
  }
  // A cap of height 1/2: pi h^2 (3 r - h) / 3.
  EXPECT_NEAR(density_profile(specimen, 8).density[0], pi * 0.25 * 2.5 / 3 / (4 * 0.5), 1e-12);
}

TEST(ReportOther, neighbours_are_counted_within_the_gap) {
  EXPECT_EQ(neighbours_of(two_spheres(), 0.021), (std::vector<double>{1, 1}));
  EXPECT_EQ(neighbours_of(two_spheres(), 0.019), (std::vector<double>{0, 0}));
}

TEST(ReportOther, shares_of_a_histogram_sum_to_one) {
  const Histogram h = histogram_of({1, 2, 2, 3, 5}, 4);
  EXPECT_EQ(h.middle, (std::vector<double>{1.5, 2.5, 3.5, 4.5}));
  EXPECT_EQ(h.share, (std::vector<double>{0.2, 0.4, 0.2, 0.2}));
  EXPECT_EQ(histogram_of({3, 3}, 4).middle, std::vector<double>{3});
  EXPECT_TRUE(histogram_of({}, 4).middle.empty());
}

TEST(ReportOther, a_packing_has_its_sizes_and_its_density) {
  const TestFolder folder;
  folder.write("specimen.csv",
               "# shape: cylinder radius_m=0.01 height_m=0.03\nx_m,y_m,z_m,radius_m\n0,0,0.005,0.004\n"
               "0,0,0.014,0.005\n0,0,0.024,0.004\n");
  folder.write("summary.json",
               R"({"app": "platen-pack", "scene": "Three <spheres>", "packing_fraction": 0.1})");
  ASSERT_EQ(report_on(folder, "."), 0) << text_of(folder / "error.txt");
  for (const char *name : {"sizes.png", "density.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures" / name)) << name;
  const std::string page = text_of(folder / "pictures/report.html");
  EXPECT_NE(page.find("Three &lt;spheres&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<spheres>"), std::string::npos);
  EXPECT_NE(page.find("<td>packing_fraction</td>"), std::string::npos);
}

TEST(ReportOther, a_bond_test_has_its_loads_and_ways) {
  const TestFolder folder;
  folder.write(
      "bonds.csv",
      "run,modulus_pa,stiffness_ratio,force_n,displacement_m,moment_nm,rotation_rad,strain_ratio,by_hand,"
      "difference\n1,1e11,0.5,500,3e-6,0,0,nan,3e-6,0\n1,1e11,0.5,1000,6e-6,0,0,nan,6e-6,0\n");
  folder.write("summary.json",
               R"({"app": "platen-bonds", "runs": [{"modulus_pa": 1e11, "break_load": null}]})");
  ASSERT_EQ(report_on(folder, "."), 0) << text_of(folder / "error.txt");
  EXPECT_TRUE(std::filesystem::exists(folder / "pictures/bonds.png"));
  folder.write("bonds.csv", "run,force_n\n1,5\n");
  EXPECT_EQ(report_on(folder, "."), 2);
  EXPECT_NE(text_of(folder / "error.txt").find("bonds.csv: no column modulus_pa"), std::string::npos)
      << text_of(folder / "error.txt");
}

TEST(ReportOther, a_bar_stands_beside_strength_of_materials) {
  const TestFolder folder;
  folder.write("history.csv",
               "time_s,load,end_x_m,end_z_m,end_twist_rad\n0,tension,0,1e-5,0\n1e-3,tension,0,-1e-5,0\n"
               "2e-3,impact,0,0,0\n");
  folder.write(
      "summary.json",
      R"({"app": "platen-bar", "tension": {"static_displacement_m": 1.1e-5, "static_by_hand": 1e-5}})");
  ASSERT_EQ(report_on(folder, "."), 0) << text_of(folder / "error.txt");
  for (const char *name : {"bar.png", "swings.png"})
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures" / name)) << name;
  EXPECT_NE(text_of(folder / "pictures/report.html").find("<td>1.1000</td>"), std::string::npos);
}

} // namespace
} // namespace platen::apps::report
