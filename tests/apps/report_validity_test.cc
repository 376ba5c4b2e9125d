// What a summary says against its figures is on the page and in the pictures.
#include <gtest/gtest.h>

#include "apps/report/report.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

report::Run run_with(const nlohmann::json &summary) {
  report::Run run;
  run.name = "run";
  run.summary = summary;
  return run;
}

const nlohmann::json rising = {
    {"strength_pa", nullptr},
    {"peak_reached", false},
    {"stress_at_end_pa", 31.2e6},
    {"validity",
     {{"strength_pa", {"no peak reached", "loaded too fast"}}, {"youngs_modulus_gauge_pa", "valid"}}}};

std::string cell(const TableOfFigures &table, const std::string &title, std::size_t column = 1) {
  for (const auto &row : table.rows)
    if (row[0] == title) return row[column];
  return "no such row";
}

TEST(ReportValidity, a_strength_without_a_peak_says_so) {
  EXPECT_EQ(cell(table_of_figures({run_with(rising)}), "strength (MPa)"), "no peak reached");
  EXPECT_EQ(cell(table_of_figures({run_with(rising)}), "stress at the end (MPa)"), "31.20");
  EXPECT_EQ(
      cell(table_of_figures({run_with({{"strength_pa", 40e6}, {"peak_reached", false}})}), "strength (MPa)"),
      "40.00, no peak reached");
  for (const nlohmann::json &peaked : {nlohmann::json{{"strength_pa", 40e6}, {"peak_reached", true}},
                                       {{"strength_pa", 40e6}, {"peak_reached", nullptr}},
                                       {{"strength_pa", 40e6}}})
    EXPECT_EQ(cell(table_of_figures({run_with(peaked)}), "strength (MPa)"), "40.00");
}

TEST(ReportValidity, each_figure_has_its_verdict_for_each_run) {
  const TableOfFigures table = table_of_validity({run_with(rising), run_with({{"strength_pa", 4e7}})});
  EXPECT_EQ(cell(table, "strength_pa"), "not valid: no peak reached; loaded too fast");
  EXPECT_EQ(cell(table, "youngs_modulus_gauge_pa"), "valid");
  EXPECT_EQ(cell(table, "strength_pa", 2), "-"); // an older summary
  EXPECT_TRUE(table_of_validity({run_with({{"validity", nullptr}}), run_with(nullptr)}).rows.empty());
}

TEST(ReportValidity, the_page_shows_reasons_and_that_no_peak_was_reached) {
  const TestFolder folder;
  folder.write(
      "history.csv",
      "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa\n0,0,0,0\n1,1e-3,30e6,30e6\n");
  folder.write("summary.json", rising.dump());
  const std::string command =
      "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' . -o pictures >out.txt 2>error.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  const std::string page = text_of(folder / "pictures/report.html");
  for (const char *words :
       {"Which figures count", "not valid: no peak reached; loaded too fast", "<td>valid</td>",
        "<td>no peak reached</td>", "the largest stress is no strength"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

} // namespace
} // namespace platen::apps::report
