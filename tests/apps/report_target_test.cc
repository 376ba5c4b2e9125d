// Pictures and page of a study of a target, from a made-up study.json.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/report/target_study.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

using Json = nlohmann::json;

Json look(int runs, double mean, double half) {
  return {{"runs", runs},
          {"mean", mean},
          {"half_interval", half},
          {"parts", {{"packing", 0.8 * half}, {"chaos", 0.6 * half}, {"speed", 0.001}, {"step", 0.002}}}};
}

Json example() {
  Json study{{"kind", "target"}, {"status", "done"}, {"runs", 18}, {"failed_runs", 1}};
  study["target"] = {{"figure", "strength"},
                     {"accuracy", 0.02},
                     {"confidence", 0.9},
                     {"verdict", "reached"},
                     {"looks", {look(10, 41e6, 0.05), look(18, 42e6, 0.019)}},
                     {"one_slow_speed", {{"wave_crossings", 180}, {"packings", 6}}},
                     {"sphere_size", {{"change", -0.011}}}};
  study["costs"] = {{"looks_core_seconds", {60, 150}}, {"one_slow_speed_core_seconds", 400}};
  return study;
}

TEST(ReportTarget, its_table_tells_each_look_and_its_remarks_what_came_of_the_order) {
  const TestFolder folder;
  folder.write("study.json", example().dump());
  const TargetResults study = read_target(folder.path());
  const TableOfFigures table = table_of_target(study);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.header[2], "strength (MPa)");
  EXPECT_EQ(table.rows[1],
            (std::vector<std::string>{"18 runs", "150", "42", "1.9", "1.5", "1.1", "0.1", "0.2"}));
  ASSERT_EQ(study.remarks.size(), 4u);
  EXPECT_EQ(study.remarks[0],
            "strength of slow loading: 42 MPa +- 1.9 % with 90 % confidence; 2 % were ordered: reached");
  EXPECT_EQ(study.remarks[1],
            "150 s of one core; one slow speed would have taken 400 s (180 wave crossings, 6 packings)");
  EXPECT_EQ(study.remarks[3], "1 of 18 runs failed and count in no mean");
}

TEST(ReportTarget, what_is_no_finished_study_is_refused_and_one_without_a_figure_says_so) {
  const TestFolder folder;
  Json broken = example();
  broken.erase("costs");
  folder.write("study.json", broken.dump());
  EXPECT_THROW(read_target(folder.path()), InputError);
  Json nothing = example();
  for (const char *key : {"looks", "one_slow_speed", "sphere_size"})
    nothing["target"].erase(key);
  folder.write("study.json", nothing.dump());
  EXPECT_EQ(read_target(folder.path()).remarks[0], "too few runs gave the figure: there is no interval");
}

TEST(ReportTarget, pictures_and_page_are_written) {
  const TestFolder folder;
  folder.write("study.json", example().dump());
  folder.write("summary.json", Json{{"scene", "Made-up order"}}.dump());
  const std::string command = "env -u DISPLAY '" PLATEN_REPORT_PROGRAM "' '" + folder.path().string() +
                              "' >'" + (folder / "out.txt").string() + "' 2>&1";
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == status_done) << text_of(folder / "out.txt");
  for (const char *name : {"target.png", "target_parts.png"})
    EXPECT_GT(std::filesystem::file_size(folder / "pictures" / name), 10000u) << name;
  EXPECT_NE(text_of(folder / "pictures" / "report.html").find("2 % were ordered: reached"),
            std::string::npos);
}

} // namespace
} // namespace platen::apps::report
