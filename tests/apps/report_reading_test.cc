#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "apps/report/csv.h"
#include "apps/report/frames.h"
#include "apps/report/other_results.h"
#include "apps/report/run_folder.h"
#include "apps/report_example.h"
#include "apps/report_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

// The message of the InputError that the call throws; "" where it throws none.
template <class Call>
std::string complaint(const Call &call) {
  try {
    call();
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string &text, const std::string &part) {
  return text.find(part) != std::string::npos;
}

TEST(ReportReading, numbers_come_back_by_column_and_gaps_are_not_numbers) {
  const TestFolder folder;
  const CsvTable table =
      read_csv(folder.write("a.csv", "t,mode, x\n1,shear,-2.5e-3\n2,tension,\n"), {"mode"});
  EXPECT_EQ(table.rows, 2u);
  EXPECT_EQ(table.column("t"), (std::vector<double>{1, 2}));
  EXPECT_EQ(table.column("x")[0], -2.5e-3);
  EXPECT_TRUE(std::isnan(table.column("x")[1]));
  EXPECT_EQ(table.words.at("mode"), (std::vector<std::string>{"shear", "tension"}));
}

TEST(ReportReading, a_table_without_rows_still_has_its_columns) {
  const TestFolder folder;
  const CsvTable table = read_csv(folder.write("a.csv", "t,mode\n"), {"mode"});
  EXPECT_EQ(table.rows, 0u);
  EXPECT_TRUE(table.column("t").empty());
  EXPECT_TRUE(table.words.at("mode").empty());
}

TEST(ReportReading, the_line_that_a_killed_run_left_half_written_is_left_out) {
  const TestFolder folder;
  EXPECT_EQ(read_csv(folder.write("a.csv", "t,x\n1,2\n3,4\n5,")).rows, 2u);
}

TEST(ReportReading, a_bad_field_is_named_by_file_line_and_column) {
  const TestFolder folder;
  const auto file = folder.write("a.csv", "t,x\n1,2\n3,four\n");
  EXPECT_EQ(complaint([&] { read_csv(file); }), file.string() + ":3: x: \"four\" is not a number");
  const auto other = folder.write("b.csv", "t,x\n1,2\n3\n5,6\n");
  EXPECT_TRUE(holds(complaint([&] { read_csv(other); }), "b.csv:3: 1 fields"));
  EXPECT_TRUE(holds(complaint([&] { read_csv(other.string() + "x"); }), "cannot be read"));
  EXPECT_TRUE(holds(complaint([&] { read_csv(file, {"x"}).column("y"); }), "no column y"));
}

TEST(ReportReading, the_nearest_frame_is_taken) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const FrameSeries series = read_pvd(folder / "specimen.pvd");
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(nearest(series, 1.2).time, example_peak_time);
  EXPECT_EQ(nearest(series, 1.3).time, example_fall_time);
  EXPECT_EQ(nearest(series, 99).time, example_end_time);
}

TEST(ReportReading, spheres_come_back_with_their_places_before_the_test) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const FrameSeries series = read_pvd(folder / "specimen.pvd");
  const Spheres before = read_spheres(series.front()), after = read_spheres(series.back());
  ASSERT_EQ(before.size(), after.size());
  ASSERT_GT(before.size(), 1000u);
  double largest_move = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    for (const std::size_t d : {0, 2}) // points are single precision: 1e-7 of 0.1 m
      EXPECT_NEAR(after.initial[k][d], before.position[k][d], 1e-8);
    EXPECT_EQ(after.id[k], before.id[k]);
    largest_move = std::max(largest_move, before.position[k][2] - after.position[k][2]);
  }
  EXPECT_NEAR(largest_move, 0.0025 * 2 * 0.1,
              0.05 * 0.0005); // the uppermost sphere nearly follows the platen
}

TEST(ReportReading, a_cut_off_frame_is_refused_by_name) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const std::string whole = text_of(folder / "specimen_2.vtu");
  for (const double share : {0.0, 0.2, 0.5, 0.99}) {
    const auto kept = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    folder.write("specimen_2.vtu", whole.substr(0, kept));
    const FrameSeries series = read_pvd(folder / "specimen.pvd");
    EXPECT_TRUE(holds(complaint([&] { read_spheres(nearest(series, example_fall_time)); }), "specimen_2.vtu"))
        << share;
  }
  std::filesystem::remove(folder / "specimen_2.vtu");
  const FrameSeries series = read_pvd(folder / "specimen.pvd");
  EXPECT_TRUE(holds(complaint([&] { read_spheres(nearest(series, example_fall_time)); }), "missing"));
}

TEST(ReportReading, a_damaged_list_or_summary_is_refused_by_name) {
  const TestFolder folder;
  write_example(folder.path(), {});
  const std::string list = text_of(folder / "bonds.pvd");
  folder.write("bonds.pvd", list.substr(0, list.size() / 2));
  EXPECT_TRUE(holds(complaint([&] { read_run(folder.path()); }), "bonds.pvd"));
  folder.write("bonds.pvd", list);
  folder.write("summary.json", "{\"strength_pa\": 4");
  EXPECT_TRUE(holds(complaint([&] { read_run(folder.path()); }), "summary.json"));
}

TEST(ReportReading, pipes_and_folders_under_the_names_of_files_are_refused) {
  for (const char *name : {"history.csv", "summary.json", "cracks.csv", "specimen.pvd", "bonds.pvd"}) {
    const TestFolder folder;
    write_example(folder.path(), {});
    std::filesystem::remove(folder / name);
    ASSERT_EQ(mkfifo((folder / name).c_str(), 0600), 0);
    EXPECT_TRUE(holds(complaint([&] { read_run(folder.path()); }), name)) << name;
    EXPECT_EQ(reader_of(folder.path()), nullptr); // it asks summary.json whose results these are
    std::filesystem::remove(folder / name);
    std::filesystem::create_directory(folder / name);
    EXPECT_TRUE(holds(complaint([&] { read_run(folder.path()); }), name)) << name;
  }
}

TEST(ReportReading, what_is_not_there_is_said_and_only_the_history_is_a_must) {
  const TestFolder folder;
  write_example(folder / "run", {});
  EXPECT_TRUE(read_run(folder / "run").remarks.empty());
  for (const char *name :
       {"summary.json", "cracks.csv", "specimen.pvd", "bonds.pvd", "platens.pvd", "contacts.pvd"})
    std::filesystem::remove(folder / "run" / name);
  const auto bare = read_run(folder / "run");
  EXPECT_EQ(bare.remarks.size(), 6u);
  EXPECT_FALSE(bare.cracks.has_value());
  EXPECT_TRUE(bare.summary.is_null());
  std::filesystem::remove(folder / "run" / "history.csv");
  EXPECT_TRUE(holds(complaint([&] { read_run(folder / "run"); }), "history.csv"));
  EXPECT_TRUE(holds(complaint([&] { read_run(folder / "nowhere"); }), "no such folder"));
}

TEST(ReportReading, the_title_is_the_scenes_and_else_the_folders_name) {
  const TestFolder folder;
  write_example(folder / "dry", {});
  EXPECT_EQ(read_run(folder / "dry").title, "Cylinder 50 mm x 100 mm, dry platens");
  folder.write("dry/scene.prm", "subsection Other\n  set Title = not mine\nend\n# set Title = nor this\n");
  EXPECT_EQ(read_run((folder / "dry").string() + "/").title, "dry"); // a path may end with a slash
}

} // namespace
} // namespace platen::apps::report
