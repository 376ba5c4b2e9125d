// What a summary says against its figures is on the page and in the pictures.
#include <gtest/gtest.h>

#include "apps/report/head.h"
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

Json expectation(const char *key, const char *range, const Json &value, const Json &met,
                 const char *reason = nullptr) {
  return {{"entry", std::string("Expect/") + key},
          {"range", range},
          {"value", value},
          {"met", met},
          {"reason", reason == nullptr ? Json() : Json(reason)}};
}

// Spheres 3 times as large as the title says.
Json overridden_run() {
  Json summary = rising;
  summary["status"] = "done";
  summary["particles"] = 55, summary["bonds"] = 130, summary["mean_radius_m"] = 4.2e-3;
  summary["expectations"] = {
      expectation("particles", "1500 ... 1600", 55, false, "case.prm:9: particles = 55"),
      expectation("youngs_modulus_gauge_pa", "20 GPa ... 30 GPa", 24.13e9, true),
      expectation("strength_pa", "40 MPa ... 46.5 MPa", nullptr, false,
                  "strength_pa was not measured (no peak reached)")};
  summary["signs_of_haste"] = {"34 wave crossings to the peak, 60 at least"};
  summary["scene_file"] = "scenes/cylinder.prm";
  summary["overridden"] = {
      {{"entry", "Specimen/Sphere radius"}, {"value", "4.2 mm"}, {"in_scene_file", "1.4 mm"}},
      {{"entry", "Output/Every"}, {"value", "10"}, {"in_scene_file", "20"}}};
  return summary;
}

void write_run(const TestFolder &folder, const Json &summary) {
  folder.write(
      "history.csv",
      "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa\n0,0,0,0\n1,1e-3,30e6,30e6\n");
  folder.write("summary.json", summary.dump());
  folder.write(
      "scene.prm",
      "subsection Scene\n  set Title = Cylinder of 1500 spheres\n  set Seed = 7\nend\n"
      "subsection Platens\n  set Friction static = 57 %\n  set Friction dynamic =\n"
      "  subsection Top\n    set Friction static = 0.1\n    set Friction dynamic = 0.05\n  end\nend\n");
}

std::string page_of(const TestFolder &folder) {
  const std::string command =
      "cd '" + folder.path().string() + "' && '" PLATEN_REPORT_PROGRAM "' . -o pictures >out.txt 2>error.txt";
  EXPECT_EQ(std::system(command.c_str()), 0) << text_of(folder / "error.txt");
  return text_of(folder / "pictures/report.html");
}

TEST(ReportHead, the_verdict_comes_first_with_what_is_not_met) {
  const TestFolder folder;
  write_run(folder, overridden_run());
  const std::string page = page_of(folder);
  const auto verdict = page.find("Not as expected: 2 of 3 figures that the scene expects not met.");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, page.find("<th>figure</th>"));
  const auto unmet = page.find("<td>particles</td><td>1500 ... 1600</td><td>55</td><td>not met</td>"),
             met = page.find(
                 "<td>youngs_modulus_gauge_pa</td><td>20 GPa ... 30 GPa</td><td>24.13 GPa</td><td>met</td>");
  ASSERT_NE(unmet, std::string::npos);
  ASSERT_NE(met, std::string::npos);
  EXPECT_LT(unmet, met);
  EXPECT_NE(page.find("<td>-</td><td>not met: strength_pa was not measured (no peak reached)</td>"),
            std::string::npos);
  EXPECT_NE(page.find("34 wave crossings to the peak, 60 at least"), std::string::npos);
  EXPECT_NE(text_of(folder / "out.txt").find("Not as expected: 2 of 3"), std::string::npos);
}

TEST(ReportHead, what_was_tested_stands_on_the_page_and_a_title_that_was_overridden_is_none) {
  const TestFolder folder;
  write_run(folder, overridden_run());
  const std::string page = page_of(folder);
  for (const char *row :
       {"<td>spheres</td><td>55</td>", "<td>bonds</td><td>130</td>", "<td>mean radius (mm)</td><td>4.2</td>",
        "<td>seed</td><td>7</td>", "<td>title of the scene file</td><td>Cylinder of 1500 spheres</td>",
        "<td>scene file</td><td>scenes/cylinder.prm</td>",
        "<td>overridden: Specimen/Sphere radius</td><td>4.2 mm, in the scene file 1.4 mm</td>",
        "<td>overridden: Output/Every</td><td>10, in the scene file 20</td>"})
    EXPECT_NE(page.find(row), std::string::npos) << row;
  EXPECT_EQ(page.find("<h1>Cylinder of 1500 spheres"), std::string::npos);
  EXPECT_NE(page.find(": 1 entry of its scene changed</h1>"), std::string::npos);
  // Without overrides, or with those that change no test, the title is true.
  Json plain = overridden_run();
  plain["overridden"].erase(plain["overridden"].begin());
  write_run(folder, plain);
  EXPECT_EQ(read_run(folder.path()).title, "Cylinder of 1500 spheres");
  plain = overridden_run();
  plain["overridden"].push_back(
      {{"entry", "Scene/Title"}, {"value", "Cylinder of 55 spheres"}, {"in_scene_file", "of 1500 spheres"}});
  write_run(folder, plain);
  EXPECT_EQ(read_run(folder.path()).title, "Cylinder of 1500 spheres"); // of scene.prm: the user's own
  EXPECT_EQ(cell(table_of_facts({results_of(read_run(folder.path()))}), "title of the scene file"),
            "of 1500 spheres");
}

TEST(ReportHead, friction_of_each_platen_is_told) {
  const TestFolder folder;
  write_run(folder, overridden_run());
  EXPECT_EQ(cell(table_of_facts({results_of(read_run(folder.path()))}), "friction of the platens"),
            "bottom 0.57; top 0.1, sliding 0.05");
}

TEST(ReportHead, a_run_that_was_stopped_is_not_judged_and_says_so) {
  Json summary = overridden_run();
  summary["status"] = "stopped";
  summary["signs_of_haste"] = Json::array();
  for (Json &one : summary["expectations"])
    one["met"] = nullptr, one["value"] = nullptr, one["reason"] = "the test has not come to its end";
  Results results;
  results.name = "run", results.summary = summary;
  EXPECT_EQ(verdict_in_words({results}), "0 of 3 figures that the scene expects met, 3 not checked.");
  const TableOfFigures table = table_of_verdict({results});
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.rows[0][2], "stopped");
  EXPECT_EQ(table.rows[1][3], "not checked: the test has not come to its end");
}

TEST(ReportHead, where_nothing_is_expected_nothing_is_said) {
  Results old;
  old.summary = {{"status", "done"}};
  EXPECT_EQ(verdict_in_words({old}), "");
  EXPECT_TRUE(table_of_verdict({old}).rows.empty());
  Results none;
  EXPECT_EQ(verdict_in_words({none, old}), "");
  EXPECT_TRUE(table_of_verdict({none, old}).rows.empty());
  Results met;
  met.summary = {{"expectations", {expectation("bonds", "1 ...", 2, true)}}};
  EXPECT_EQ(verdict_in_words({met}), "As expected: 1 figure that the scene expects, all met.");
}

TEST(ReportHead, found_figures_are_in_the_unit_of_their_range) {
  const auto found = [](const char *key, const char *range, double value) {
    Results results;
    results.summary = {{"expectations", {expectation(key, range, value, true)}}};
    return table_of_verdict({results}).rows.at(0)[2];
  };
  EXPECT_EQ(found("strength_pa", "... 46.5 MPa", 38552960.02), "38.55 MPa");
  EXPECT_EQ(found("strength_pa", "0.04 GPa ...", 38552960.02), "0.03855 GPa");
  EXPECT_EQ(found("strength_pa", "4e7 ... 5e7", 38552960.02), "3.855e+07 Pa");
  EXPECT_EQ(found("energy_residual_relative", "... 1 %", 0.0123), "1.23 %");
  EXPECT_EQ(found("cone_top/half_angle_deg", "16 ... 60", 30.25), "30.25 degree");
  EXPECT_EQ(found("side_stress_at_peak_pa/left", "1 MPa ... 2 MPa", 1.5e6), "1.5 MPa");
  EXPECT_EQ(found("density_kg_m3", "2 g/cm3 ... 3 g/cm3", 2400), "2.4 g/cm3");
}

} // namespace
} // namespace platen::apps::report
