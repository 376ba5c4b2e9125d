// Folders as users have them: histories of one row or of none, odd summaries, titles that are no title,
// studies whose runs failed. Each gives pictures that are true, or one clear line and no picture.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "apps/report_example.h"
#include "apps/report_folder.h"

namespace platen::apps::report {
namespace {

struct Outcome {
  int status = -1;
  std::string out, error, page;
};

Outcome report_on(const TestFolder &folder) {
  const std::string command = "cd '" + folder.path().string() +
                              "' && rm -rf pictures && '" PLATEN_REPORT_PROGRAM
                              "' . -o pictures >out.txt 2>error.txt";
  const int status = std::system(command.c_str());
  const auto page = folder / "pictures/report.html";
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder / "out.txt"),
          text_of(folder / "error.txt"), std::filesystem::exists(page) ? text_of(page) : ""};
}

const std::string header = "time_s,axial_strain_platen,axial_stress_top_pa,axial_stress_bottom_pa\n";
const std::string crushed = header + "0,0,0,0\n1,1e-3,30e6,30e6\n2,2e-3,20e6,20e6\n";

bool drawn(const TestFolder &folder, const std::string &name) {
  return std::filesystem::exists(folder / "pictures" / name);
}

TEST(ReportAttacks, short_and_silent_histories_are_drawn_as_they_are) {
  const TestFolder folder;
  for (const char *rows :
       {"0,0,0,0\n", "0,1e-3,5e6,5e6\n", "0,0,0,0\n1,1e-3,0,0\n", "0,nan,0,0\n1,nan,1e6,1e6\n",
        "0,0,0,0\n1,1e-3,inf,1e6\n2,2e-3,1e6,1e6\n", "0,0,0,0\n1,-1e-3,-3e6,-3e6\n"}) {
    folder.write("history.csv", header + rows);
    const Outcome outcome = report_on(folder);
    EXPECT_EQ(outcome.status, 0) << rows << outcome.error;
    EXPECT_EQ(outcome.error, "") << rows;
    EXPECT_TRUE(drawn(folder, "stress_strain.png")) << rows;
    const bool gap = std::string(rows).find("inf") != std::string::npos;
    EXPECT_EQ(outcome.page.find("history.csv has 1 of 3 rows without a stress, the first at the time 1 s") !=
                  std::string::npos,
              gap)
        << rows;
  }
}

TEST(ReportAttacks, damaged_tables_and_summaries_end_in_one_line) {
  const TestFolder folder;
  const auto refused = [&](const std::string &says) {
    const Outcome outcome = report_on(folder);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_NE(outcome.error.find(says), std::string::npos) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_FALSE(std::filesystem::exists(folder / "pictures")) << says;
  };
  for (const char *rows : {"", "0,nan,nan,nan\n"}) {
    folder.write("history.csv", header + rows);
    refused("history.csv: no sample with a stress along z");
  }
  folder.write("history.csv", header + "0,0,abc,0\n");
  refused("history.csv:2: axial_stress_top_pa: \"abc\" is not a number");
  folder.write("history.csv", header + "0,0\n1,1,1,1\n");
  refused("history.csv:2: 2 fields, but the header names 4");
  folder.write("history.csv", "a,b\n1,2\n");
  refused("no column axial_stress_top_pa");
  folder.write("history.csv", crushed);
  for (const char *summary : {"[1, 2]", "3", "\"done\""}) {
    folder.write("summary.json", summary);
    refused("summary.json: is damaged: it is no JSON object");
  }
  for (const char *summary : {"", "{\"strength_pa\": 3"}) {
    folder.write("summary.json", summary);
    refused("summary.json: ");
  }
  folder.write("summary.json", R"({"loaded_axis": "x"})");
  refused("no column stress_right_pa");
}

TEST(ReportAttacks, a_damaged_or_missing_frame_leaves_no_picture) {
  const TestFolder folder;
  folder.write("history.csv", crushed);
  folder.write("specimen.pvd",
               "<?xml version=\"1.0\"?><VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" "
               "file=\"s.vtu\"/></Collection></VTKFile>");
  Outcome outcome = report_on(folder);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("s.vtu: missing"), std::string::npos) << outcome.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures"));
  folder.write("s.vtu", "<VTKFile type=\"UnstructuredGrid\"><Unstru");
  outcome = report_on(folder);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("s.vtu: damaged or empty"), std::string::npos) << outcome.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "pictures"));
}

// White at its left and right edges: nothing is cut off.
void expect_white_edges(const std::filesystem::path &png) {
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(png.c_str());
  reader->Update();
  vtkImageData *image = reader->GetOutput();
  const int *size = image->GetDimensions();
  for (const int x : {0, 1, size[0] - 2, size[0] - 1})
    for (int y = 0; y < size[1]; ++y)
      ASSERT_EQ(image->GetScalarComponentAsDouble(x, y, 0, 0), 255) << x << ' ' << y;
  for (int x = 0; x < size[0]; ++x)
    ASSERT_EQ(image->GetScalarComponentAsDouble(x, size[1] - 1, 0, 0), 255) << x;
}

TEST(ReportAttacks, titles_of_any_kind_stay_within_picture_and_page) {
  const TestFolder folder;
  folder.write("history.csv", crushed);
  std::string words, letters(900, 'x');
  for (int k = 0; k < 400; ++k)
    words += "word ";
  for (const std::string &title :
       {words, letters,
        std::string("\xCF\x83\xE2\x82\x81, \xD0\x91\xD0\xB5\xD1\x82\xD0\xBE\xD0\xBD \xE4\xB8\x89"),
        std::string("caf\xE9"), std::string("<script>alert(1)</script> & \"quotes\"")}) {
    folder.write("scene.prm", "subsection Scene\n  set Title = " + title + "\nend\n");
    const Outcome outcome = report_on(folder);
    EXPECT_EQ(outcome.status, 0) << title << outcome.error;
    EXPECT_EQ(outcome.error, "") << title; // VTK has nothing to complain of
    EXPECT_EQ(outcome.page.find("<script>"), std::string::npos);
    expect_white_edges(folder / "pictures/stress_strain.png");
    const std::string svg = text_of(folder / "pictures/stress_strain.svg");
    EXPECT_EQ(svg.find("<script>"), std::string::npos);
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
  }
}

TEST(ReportAttacks, figures_of_other_kinds_than_numbers_are_passed_over) {
  const TestFolder folder;
  folder.write("history.csv", crushed);
  folder.write(
      "summary.json",
      R"({"strength_pa": "40", "validity": "all", "stages": 5, "stage_seconds": 3, "crack_rose": ["a"],
               "acoustic": 7, "version": 3, "loaded_axis": 4, "pattern": 3, "peak_reached": "maybe"})");
  EXPECT_EQ(report_on(folder).status, 0);
  folder.write("summary.json",
               R"({"validity": {"strength_pa": ["<b>why</b>", 3], "poisson_ratio": null, "x": {}}})");
  const Outcome odd = report_on(folder);
  EXPECT_EQ(odd.status, 0) << odd.error;
  EXPECT_NE(odd.page.find("not valid: &lt;b&gt;why&lt;/b&gt;"), std::string::npos);
}

TEST(ReportAttacks, events_are_drawn_where_one_has_a_magnitude) {
  const TestFolder folder;
  folder.write("history.csv", crushed);
  folder.write("summary.json", R"({"acoustic": {"b_before": 1.3}})");
  for (const char *none : {"time_s,energy_j\n1,2\n", "time_s,magnitude\n1,nan\n2,\n", "time_s,magnitude\n"}) {
    folder.write("events.csv", none);
    EXPECT_EQ(report_on(folder).status, 0) << none;
    EXPECT_FALSE(drawn(folder, "acoustic.png")) << none;
  }
  std::string alike = "time_s,magnitude\n";
  for (int k = 0; k < 90; ++k)
    alike += "1,-5\n";
  for (const std::string &some : {std::string("time_s,magnitude\n1,-5\n"), alike}) {
    folder.write("events.csv", some);
    const Outcome outcome = report_on(folder);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_TRUE(drawn(folder, "acoustic.png"));
    EXPECT_NE(outcome.page.find("No b-value before the peak"), std::string::npos);
    EXPECT_EQ(outcome.out.find("1.30"), std::string::npos) << outcome.out; // the older summary's
  }
}

nlohmann::json rate(const std::string &name, double speed, const nlohmann::json &strength, int failed = 0) {
  return {
      {"name", name},
      {"axial_rate_m_s", speed},
      {"runs", 3},
      {"failed", failed},
      {"strength_pa", {{"mean", strength}, {"deviation", nullptr}, {"runs", strength.is_null() ? 0 : 3}}}};
}

TEST(ReportAttacks, studies_with_failed_runs_no_case_or_an_unknown_kind) {
  const TestFolder folder;
  const auto study = [&](const std::string &kind, const nlohmann::json &cases,
                         const std::string &status = "done") {
    folder.write(
        "study.json",
        nlohmann::json{{"kind", kind}, {"status", status}, {"runs", 6}, {"failed_runs", 3}, {"cases", cases}}
            .dump());
    return report_on(folder);
  };
  Outcome outcome = study("rate", {rate("a", 0.1, 40e6), rate("<b>", 0.2, nullptr, 3), rate("c", 0.4, 42e6)});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("<b>: no strength_pa, 3 of 3 runs failed; a gap in the picture"),
            std::string::npos);
  EXPECT_NE(outcome.out.find("3 of 6 runs failed and count in no mean"), std::string::npos);
  EXPECT_EQ(outcome.page.find("<b>"), std::string::npos);
  EXPECT_TRUE(drawn(folder, "study_rate.png"));
  outcome = study("rate", {rate("a", 0.1, nullptr, 3), rate("b", 0.2, nullptr, 3)});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("no case has a figure: there is no curve to draw"), std::string::npos);
  EXPECT_FALSE(drawn(folder, "study_rate.png"));
  EXPECT_NE(study("rate", nlohmann::json::array()).out.find("no case: there is no curve to draw"),
            std::string::npos);
  outcome = study("magic", nlohmann::json::array());
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.error.find("is of a study of magic"), std::string::npos) << outcome.error;
  EXPECT_EQ(study("rate", nlohmann::json::array(), "running").status, 2);
  folder.write("study.json", "{\"kind\": ");
  EXPECT_NE(report_on(folder).error.find("study.json: cannot be read as JSON"), std::string::npos);
}

TEST(ReportAttacks, empty_folders_of_other_apps_say_what_is_missing) {
  const TestFolder folder;
  const auto of = [&](const std::string &summary) {
    folder.write("summary.json", summary);
    return report_on(folder);
  };
  EXPECT_NE(of(R"({"app": "platen-pack"})").error.find("specimen.csv"), std::string::npos);
  EXPECT_NE(of(R"({"app": "platen-bonds"})").error.find("bonds.csv: cannot be read"), std::string::npos);
  EXPECT_NE(of(R"({"app": "platen-bar"})").out.find("nothing to draw"), std::string::npos);
  EXPECT_NE(
      of(R"({"app": "platen-calibrate", "targets": [], "missed": []})").out.find("no target that was found"),
      std::string::npos);
  folder.write("specimen.csv", "x_m,y_m,z_m,radius_m\n");
  EXPECT_NE(of(R"({"app": "platen-pack"})").error.find("holds no sphere"), std::string::npos);
  folder.write("specimen.csv", "x_m,y_m,z_m,radius_m\n0,0,0.01,0.004\n");
  EXPECT_EQ(of(R"({"app": "platen-pack"})").status, 0); // one sphere, of no known shape
  EXPECT_TRUE(drawn(folder, "sizes.png"));
  EXPECT_FALSE(drawn(folder, "density.png"));
}

} // namespace
} // namespace platen::apps::report
