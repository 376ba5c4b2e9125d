// Curves and page of a calibration, from made-up files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/report/calibration.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

using Json = nlohmann::json;

Json example() {
  const Json strength{{"key", "compressive_strength_pa"},
                      {"wanted", 43e6},
                      {"training", {{"mean", 42e6}, {"deviation", 1e6}, {"seeds", 3}}},
                      {"verification", {{"mean", 41e6}, {"deviation", nullptr}, {"seeds", 1}}},
                      {"met_in_training", true},
                      {"met", false}};
  return {{"app", "platen-calibrate"},
          {"scene", "Made-up bonds"},
          {"targets", {strength}},
          {"missed", {"gain by friction: 1.45 is out of reach"}}};
}

TEST(ReportCalibration, curves_and_targets_are_on_its_page) {
  const TestFolder folder;
  folder.write("summary.json", example().dump());
  const auto run = [&](const std::string &arguments) {
    const std::string command = "env -u DISPLAY '" PLATEN_REPORT_PROGRAM "' '" + folder.path().string() +
                                "' " + arguments + " >'" + (folder / "out.txt").string() + "' 2>&1";
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  EXPECT_TRUE(holds_calibration(folder.path()));
  ASSERT_EQ(run(""), status_done) << text_of(folder / "out.txt"); // without a curve its targets are drawn
  EXPECT_GT(std::filesystem::file_size(folder / "pictures" / "targets.png"), 10000u);
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures" / "curve.png"));
  const char *rows = "0.001,20e6,18e6,17e6\n0.002,30e6,31e6,nan\n0.003,10e6,12e6,13e6\n";
  folder.write("curve.csv", std::string("strain_platen,wanted_pa,calibrated_pa,unseen_pa\n") + rows);
  folder.write("curve_2.csv", std::string("strain_gauge,wanted_pa,calibrated_pa,unseen_pa\n") + rows);
  EXPECT_EQ(run("--compare /tmp"), status_bad_input);
  ASSERT_EQ(run(""), status_done) << text_of(folder / "out.txt");
  for (const char *name : {"curve.png", "curve_2.png"})
    EXPECT_GT(std::filesystem::file_size(folder / "pictures" / name), 10000u) << name;
  const std::string page = text_of(folder / "pictures" / "report.html");
  for (const char *words : {"Made-up bonds", "4.2e+07, 3 packings", "4.1e+07, 1 packing", "out of reach"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

// What decides is how far the mean of the packings is off, not the mean of how far each is.
TEST(ReportCalibration, a_curve_is_shown_by_what_it_is_judged_by) {
  const TestFolder folder;
  Json summary = example();
  const Json curve{{"key", "curve_miss"},
                   {"kind", "curve"},
                   {"wanted", 0},
                   {"tolerance", 0.05},
                   {"training", {{"mean", 0.0576}, {"deviation", 0.01}, {"seeds", 5}}},
                   {"training_miss", 0.0453},
                   {"met_in_training", true}};
  summary["targets"].push_back(curve);
  summary["targets_missed"] = {"compressive strength, MPa: wanted 43, got 41, off by -4.65 %, tolerance 2 %"};
  folder.write("summary.json", summary.dump());
  const std::string command = "env -u DISPLAY '" PLATEN_REPORT_PROGRAM "' '" + folder.path().string() +
                              "' >'" + (folder / "out.txt").string() + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0) << text_of(folder / "out.txt");
  const std::string page = text_of(folder / "pictures" / "report.html");
  EXPECT_NE(page.find("<td>off by 4.53 %</td><td>-</td><td>5 %</td><td>yes</td>"), std::string::npos);
  EXPECT_EQ(page.find("0.0576"), std::string::npos);
  const auto verdict = page.find("Not as wanted: 1 target not met.");
  ASSERT_NE(verdict, std::string::npos);
  EXPECT_LT(verdict, page.find("<th>target (SI)</th>"));
  EXPECT_NE(page.find("not met: compressive strength, MPa: wanted 43"), std::string::npos);
}

} // namespace
} // namespace platen::apps::report
