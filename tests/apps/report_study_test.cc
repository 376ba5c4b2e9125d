// Pictures and page of a study of platens, from a made-up study.json.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/report/chart.h"
#include "apps/report/platen_study.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

using Json = nlohmann::json;

Json spread(double mean, double deviation, int runs = 3) {
  return {{"mean", mean},
          {"deviation", deviation},
          {"low", mean - deviation},
          {"high", mean + deviation},
          {"runs", runs}};
}

Json case_of(const std::string &surface, const Json &friction, double slenderness, double strength) {
  return {{"name", surface + "_" + std::to_string(static_cast<int>(slenderness))},
          {"surface", surface},
          {"friction_static", friction},
          {"slenderness", slenderness},
          {"sphere_radius_m", 0.002},
          {"confining_pressure_pa", 0.0},
          {"without_peak", 0},
          {"strength_pa", spread(strength, 2e6)}};
}

// Dry steel, grease and glue at 1 and 2: cubes gain a half by steel.
Json example() {
  Json study{{"kind", "friction"}, {"status", "done"}, {"runs", 18}, {"failed_runs", 1}};
  study["cases"] = {case_of("dry steel", 0.57, 1, 60e6), case_of("grease", 0.0048, 1, 40e6),
                    case_of("glued", nullptr, 1, 70e6),  case_of("dry steel", 0.57, 2, 44e6),
                    case_of("grease", 0.0048, 2, 40e6),  case_of("glued", nullptr, 2, 45e6)};
  const Json laboratory{{"effect", "gain over free ends"},
                        {"platens", "steel"},
                        {"slenderness", 1.0},
                        {"mean", 1.42},
                        {"low", 1.21},
                        {"high", 1.59},
                        {"source", "Hughes"}};
  Json gain = spread(1.5, 0.05);
  gain.update({{"effect", "gain over free ends"},
               {"case", "dry steel_1"},
               {"over", "grease_1"},
               {"laboratory", laboratory}});
  Json relative = spread(1.36, 0.04);
  relative.update({{"effect", "strength over that at slenderness 2"},
                   {"case", "dry steel_1"},
                   {"over", "dry steel_2"},
                   {"laboratory", nullptr}});
  study["comparisons"] = {gain, relative};
  study["laboratory"] = {laboratory,
                         {{"effect", "strength over that at slenderness 2"},
                          {"platens", "free ends"},
                          {"slenderness", 1.0},
                          {"mean", 1.02},
                          {"low", 0.95},
                          {"high", 1.1},
                          {"source", "RILEM"}}};
  return study;
}

TEST(ReportStudy, its_table_has_a_row_for_each_case_with_the_laboratory_beside_it) {
  const TestFolder folder;
  Json file = example();
  file["cases"][2]["without_peak"] = 2;
  folder.write("study.json", file.dump());
  const StudyResults study = read_study(folder.path());
  ASSERT_EQ(study.cases.size(), 6u);
  EXPECT_DOUBLE_EQ(study.cases[0].strength.high, 62);
  EXPECT_EQ(study.cases[0].strength.packings, 3);
  EXPECT_FALSE(study.cases[2].plain);
  ASSERT_EQ(study.remarks.size(), 3u);
  EXPECT_EQ(
      study.remarks[0],
      "glued, height/width 1: 2 of 3 runs bore ever more up to the target strain: no strength is drawn");
  EXPECT_EQ(study.remarks[1], "laboratory, gain over free ends, steel: Hughes");
  EXPECT_EQ(study.remarks[2], "1 of 18 runs failed and count in no mean");
  const TableOfFigures table = table_of_study(study);
  ASSERT_EQ(table.rows.size(), 6u);
  for (const auto &row : table.rows)
    EXPECT_EQ(row.size(), table.header.size());
  EXPECT_EQ(table.rows[0], (std::vector<std::string>{"dry steel", "1", "3", "58.0 ... 62.0, 3 packings",
                                                     "1.450 ... 1.550, 3 packings", "1.42 (1.21 to 1.59)",
                                                     "1.320 ... 1.400, 3 packings", "-", "-", "-"}));
  EXPECT_EQ(table.rows[2][3], "> 68.0 ... 72.0, 3 packings");
  EXPECT_EQ(table.rows[5][4], "-");
}

TEST(ReportStudy, a_deviation_is_of_five_packings_and_more_a_range_of_fewer) {
  const auto of = [](Json statistics) { return words(over_seeds(statistics, 1e6), 1); };
  EXPECT_EQ(of(spread(41.5e6, 1e6, 5)), "41.5 +- 1.0");
  EXPECT_EQ(of(spread(41.5e6, 1e6, 4)), "40.5 ... 42.5, 4 packings");
  EXPECT_EQ(of(spread(41.5e6, 0, 2)), "41.5, 2 packings");
  Json one = spread(41.5e6, 0, 1), old = spread(41.5e6, std::sqrt(2.0) * 1e6, 2), older = spread(41.5e6, 1e6);
  one["deviation"] = nullptr;
  EXPECT_EQ(of(one), "41.5, 1 packing");
  for (Json *without : {&old, &older})
    without->erase("low"), without->erase("high");
  EXPECT_EQ(of(old), "40.5 ... 42.5, 2 packings"); // two lie to both sides of their mean
  EXPECT_EQ(of(older), "41.5, 3 packings");        // of three nobody knows
  const Spread bars = over_seeds(spread(41.5e6, 1e6, 5), 1e6);
  EXPECT_DOUBLE_EQ(bars.low, 40.5);
  EXPECT_DOUBLE_EQ(bars.high, 42.5);
  EXPECT_EQ(words_of_scatter(1), "; one packing: no scatter known");
  EXPECT_EQ(words_of_scatter(4), "; bars: range of the packings");
  EXPECT_EQ(words_of_scatter(5),
            "; bars: standard deviation over the packings, of fewer than five their range");
}

TEST(ReportStudy, says_first_what_is_outside_the_laboratory_and_what_the_bonds_are_not_calibrated_for) {
  const TestFolder folder;
  Json file = example();
  file["comparisons"][0]["verdict"] = "outside";
  file["comparisons"][0].update({{"mean", 1.94}, {"low", 1.89}, {"high", 1.99}});
  file["comparisons"][1].update({{"mean", nullptr}, {"deviation", nullptr}, {"reason", "not calibrated"}});
  folder.write("study.json", file.dump());
  const StudyResults study = read_study(folder.path());
  ASSERT_GE(study.remarks.size(), 2u);
  EXPECT_EQ(
      study.remarks[0],
      "outside the laboratory's range: gain over free ends, dry steel, height/width 1: 1.890 ... 1.990, 3 "
      "packings, laboratory 1.42 (1.21 to 1.59), Hughes");
  EXPECT_EQ(study.remarks[1],
            "strength over that at slenderness 2, dry steel, height/width 1: none: not calibrated");
  const TableOfFigures table = table_of_study(study);
  EXPECT_EQ(table.rows[0][5], "1.42 (1.21 to 1.59): outside");
  EXPECT_EQ(table.rows[0][6], "-");
}

TEST(ReportStudy, what_is_no_finished_study_of_platens_is_refused) {
  const TestFolder folder;
  const auto refused = [&](const Json &study, const std::string &says) {
    folder.write("study.json", study.dump());
    try {
      read_study(folder.path());
      ADD_FAILURE() << says;
    } catch (const InputError &error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  };
  refused({{"kind", "friction"}, {"status", "running"}},
          "has not ended; go on with it by platen-study friction");
  refused({{"kind", "colour"}, {"status", "done"}}, "is of a study of colour");
  refused(3, "cannot be read as JSON");
  refused({{"kind", "friction"}, {"status", "done"}}, "key 'cases' not found");
  Json lost = example();
  lost["comparisons"][0]["over"] = "teflon_1";
  refused(lost, "no case teflon_1");
}

TEST(ReportStudy, bars_of_scatter_have_caps_and_a_single_number_has_none) {
  Chart chart;
  add_bar(chart, 2, 3, 5, 0.1, colours::blue);
  ASSERT_EQ(chart.curves.size(), 3u);
  EXPECT_EQ(chart.curves[0].y, (std::vector<double>{3, 5}));
  EXPECT_EQ(chart.curves[2].y, (std::vector<double>{5, 5}));
  EXPECT_NEAR(chart.curves[1].x[0], 1.9, 1e-15);
  add_bar(chart, 2, 3, 3, 0.1, colours::blue);
  add_bar(chart, 2, std::nan(""), std::nan(""), 0.1, colours::blue);
  EXPECT_EQ(chart.curves.size(), 3u);
}

TEST(ReportStudy, pictures_and_page_are_written_for_what_was_varied) {
  const TestFolder folder;
  folder.write("study.json", example().dump());
  folder.write("summary.json", Json{{"scene", "Made-up platens"}}.dump());
  const auto run = [&](const std::string &arguments) {
    const std::string command = "env -u DISPLAY '" PLATEN_REPORT_PROGRAM "' '" + folder.path().string() +
                                "' " + arguments + " >'" + (folder / "out.txt").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  ASSERT_EQ(run(""), status_done) << text_of(folder / "out.txt");
  for (const char *name : {"strength_friction.png", "strength_slenderness.png"})
    EXPECT_GT(std::filesystem::file_size(folder / "pictures" / name), 10000u) << name;
  const std::string page = text_of(folder / "pictures" / "report.html");
  EXPECT_NE(page.find("Made-up platens"), std::string::npos);
  EXPECT_NE(page.find("1.42 (1.21 to 1.59)"), std::string::npos);
  EXPECT_NE(text_of(folder / "out.txt").find("dry steel"), std::string::npos);
  EXPECT_EQ(run("--compare /tmp"), status_bad_input);

  Json steel = example(); // one kind of platens: no curve over friction
  steel["cases"] = {steel["cases"][0], steel["cases"][3]};
  steel["comparisons"] = Json::array({steel["comparisons"][1]}); // in braces alone, Clang copies it
  folder.write("study.json", steel.dump());
  ASSERT_EQ(run("-o '" + (folder / "other").string() + "'"), status_done) << text_of(folder / "out.txt");
  EXPECT_FALSE(std::filesystem::exists(folder / "other" / "strength_friction.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "other" / "strength_slenderness.png"));
}

} // namespace
} // namespace platen::apps::report
