// Stages in a report: their rows, the zero of strains, the table, the pictures; tests that load another axis.
#include "apps/report/stages.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "apps/report/report.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

// A consolidation to 1 MPa in two rows after the first, loading along z, unloading; x is loaded twice as
// much. The summary says the consolidation of the first stage alone, though the third is marked as one too.
void write_staged(const std::filesystem::path &folder, const std::string &axis = "z", bool sides = true) {
  std::filesystem::create_directories(folder);
  std::ofstream history(folder / "history.csv");
  history << "time_s,axial_strain_platen,axial_strain_gauge,lateral_strain,axial_stress_top_pa,axial_stress_"
             "bottom_pa,stage"
          << (sides ? ",stress_left_pa,stress_right_pa,strain_x" : ",confining_pressure_pa") << '\n';
  const std::vector<double> stress{0, 0.5, 1, 11, 21, 16, 6}, stage{1, 1, 1, 2, 2, 2, 3};
  for (std::size_t k = 0; k < stress.size(); ++k) {
    const double s = stress[k] * 1e6, e = 1e-4 * stress[k];
    history << 1e-3 * static_cast<double>(k) << ',' << e << ',' << e << ',' << -0.2 * e << ',' << 1.1 * s
            << ',' << 0.9 * s << ',' << stage[k];
    if (sides)
      history << ',' << 2.2 * s << ',' << 1.8 * s << ',' << 3 * e << '\n';
    else
      history << ",1e6\n";
  }
  std::ofstream(folder / "summary.json") << R"({"loaded_axis": ")" << axis << R"(", "stages": [
        {"stage": 1, "ended_by": "not settled", "consolidation": true},
        {"stage": 2, "ended_by": "share of peak", "consolidation": false},
        {"stage": 3, "ended_by": null, "consolidation": true}]})";
  std::ofstream(folder / "scene.prm")
      << "subsection Loading\n  subsection Stage 1\n    set Top = stress 1 MPa\n    set Lateral x = hold\n"
         "    set Until = settled\n  end\n  subsection Stage 2\n    set Axial = rate\n    set Until =\n  "
         "end\nend\n";
}

TEST(ReportStages, a_stage_begins_at_the_last_row_of_the_one_before) {
  const TestFolder folder;
  write_staged(folder / "run");
  const report::Run run = read_run(folder / "run");
  const std::vector<StageRows> stages = stages_of(run);
  ASSERT_EQ(stages.size(), 3u);
  const std::vector<StageRows> expected{{1, 0, 2}, {2, 2, 5}, {3, 5, 6}};
  for (std::size_t k = 0; k < stages.size(); ++k) {
    EXPECT_EQ(stages[k].number, expected[k].number);
    EXPECT_EQ(stages[k].first, expected[k].first);
    EXPECT_EQ(stages[k].last, expected[k].last);
  }
  EXPECT_EQ(run.zero, 2u); // no consolidation comes after it
  EXPECT_EQ(stage_words(run, 1), "Lateral x hold, Top stress 1 MPa");
  EXPECT_EQ(stage_words(run, 2), "Axial rate");
  EXPECT_EQ(stage_words(run, 3), "");
}

TEST(ReportStages, the_table_counts_from_the_end_of_the_consolidation) {
  const TestFolder folder;
  write_staged(folder / "run");
  const TableOfFigures table = table_of_stages(read_run(folder / "run"));
  ASSERT_EQ(table.rows.size(), 3u);
  ASSERT_EQ(table.header.size(), 10u);
  // s1 = 6, s2 = 12, s3 = 0 MPa: q = sqrt((36 + 36 + 144) / 2).
  const std::vector<std::vector<std::string>> expected{
      {"1", "Lateral x hold, Top stress 1 MPa", "settled", "not settled", "2.000", "0.000", "0.000", "1.00",
       "1.00", "1.73"},
      {"2", "Axial rate", "-", "share of peak", "5.000", "1.500", "-0.300", "16.00", "21.00", "27.71"},
      {"3", "-", "-", "-", "6.000", "0.500", "-0.100", "6.00", "16.00", "10.39"}};
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_EQ(table.rows[k], expected[k]) << k;
}

// Stresses, strains and the peak follow what the summary says; across are then the platens of the other axes.
TEST(ReportStages, a_test_along_x_is_told_along_x) {
  const TestFolder folder;
  write_staged(folder / "x", "x");
  write_staged(folder / "z", "z");
  const report::Run x = read_run(folder / "x"), z = read_run(folder / "z");
  EXPECT_EQ(x.moments.peak_stress, 42e6);
  EXPECT_EQ(z.moments.peak_stress, 21e6);
  const auto from_third = [](std::vector<double> strain) {
    const double start = strain[2];
    for (double &value : strain)
      value -= start;
    return strain;
  };
  EXPECT_EQ(x.strain(), from_third(x.history.column("strain_x")));
  EXPECT_EQ(z.strain(), from_third(z.history.column("axial_strain_platen")));
  EXPECT_EQ(x.stress_title(), "Stress along x (MPa)");
  EXPECT_EQ(x.strain_title(), "Strain along x between platens from the end of consolidation (mm/m)");
  EXPECT_EQ(z.stress_title(), "Axial stress (MPa)");
  const TableOfFigures table = table_of_stages(x);
  EXPECT_EQ(table.rows[1][5], "4.500");
  EXPECT_EQ(table.rows[1][6], "1.500"); // of the axial platens, which close
  EXPECT_EQ(table.rows[1][7], "32.00");
}

TEST(ReportStages, a_test_that_is_led_by_its_circumference_tells_that_strain) {
  const TestFolder folder;
  write_staged(folder / "run", "z", false);
  report::Run run = read_run(folder / "run");
  run.history.numbers["circumferential_strain"] = {0, 1e-4, 2e-4, 3e-4, 4e-4, 7e-4, 9e-4};
  const TableOfFigures table = table_of_stages(run);
  EXPECT_EQ(table.header[6], "circumferential strain (mm/m)");
  EXPECT_EQ(table.rows[1][6], "-0.500");
  EXPECT_EQ(table.rows[1][9], "15.00"); // less the cell's 1 MPa
}

TEST(ReportStages, the_page_shows_stages_where_the_scene_wrote_some) {
  const TestFolder folder;
  write_staged(folder / "run");
  write_staged(folder / "cell", "z", false);
  const auto report = [&](const std::string &arguments) {
    const std::string command = "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' " +
                                arguments + " >out.txt 2>error.txt";
    EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  };
  for (const char *name : {"run", "cell"}) {
    report(std::string(name) + " -o pictures");
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/stages.png")) << name;
    const std::string page = text_of(folder / "pictures/report.html");
    EXPECT_NE(page.find("<h2 id=\"Stages\">"), std::string::npos);
    EXPECT_NE(page.find("<td>not settled</td>"), std::string::npos);
    std::filesystem::remove_all(folder / "pictures");
  }
  std::string history = text_of(folder / "cell/history.csv");
  history.replace(history.find(",stage,"), 7, ",other,");
  folder.write("cell/history.csv", history);
  report("cell -o pictures");
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures/stages.png"));
}

} // namespace
} // namespace platen::apps::report
