// platen-study as a user runs it, on specimens of a hundred spheres; and what it plans.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <thread>

#include "apps/output/seed_statistics.h"
#include "apps/study_runs.h"

namespace platen::apps::testing {
namespace {

const Words one_size = set({"Study/Sphere radius list = 2 mm"});

TEST_F(Study, rows_are_the_runs_and_means_are_of_the_rows) {
  const Outcome outcome = run("a", {});
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const fs::path csv = folder_ / "a/study.csv";
  const std::vector<double> strength = column_of(csv, "strength_pa"), seed = column_of(csv, "seed"),
                            radius = column_of(csv, "sphere_radius_m"), spheres = column_of(csv, "particles");
  ASSERT_EQ(strength.size(), 4u);
  EXPECT_EQ(radius, (std::vector<double>{0.002, 0.002, 0.0014, 0.0014}));
  EXPECT_EQ(seed, (std::vector<double>{3, 4, 3, 4})); // crushed.prm has seed 3
  const auto cases = json("a")["cases"];
  ASSERT_EQ(cases.size(), 2u);
  for (std::size_t c = 0; c < 2; ++c) {
    const double a = strength[2 * c], b = strength[2 * c + 1], mean = (a + b) / 2;
    EXPECT_NE(a, b); // seeds differ
    EXPECT_NEAR(cases[c]["strength_pa"]["mean"].get<double>(), mean, 1e-12 * mean);
    // Of two numbers the sample deviation is their distance over the root of two.
    EXPECT_NEAR(cases[c]["strength_pa"]["deviation"].get<double>(), std::abs(a - b) / std::sqrt(2.0),
                1e-12 * mean);
    EXPECT_EQ(cases[c]["strength_pa"]["runs"], 2);
    for (std::size_t s = 0; s < 2; ++s) {
      const auto summary = summary_in(
          folder_ / "a/runs" / (cases[c]["name"].get<std::string>() + "_seed_" + std::to_string(3 + s)));
      EXPECT_EQ(summary["strength_pa"].get<double>(), strength[2 * c + s]);
      EXPECT_EQ(summary["threads"], 1);
    }
  }
  // Spheres fill the same cylinder: their number goes as the cube of the radius, less what walls take (a
  // tenth).
  EXPECT_NEAR(spheres[2] / spheres[0], std::pow(2 / 1.4, 3), 0.25 * std::pow(2 / 1.4, 3));
  EXPECT_EQ(lines_in(folder_ / "a/costs.csv"), 5);
  for (const double seconds : column_of(folder_ / "a/costs.csv", "wall_seconds"))
    EXPECT_GT(seconds, 0);
  EXPECT_TRUE(contains(outcome.out, " ... ")) << outcome.out; // two seeds: their range
  EXPECT_EQ(summary_in(folder_ / "a")["failed_runs"], 0);
}

TEST_F(Study, the_number_of_runs_at_a_time_changes_no_byte) {
  make_once("one", {});
  ASSERT_EQ(run("three", {"--quiet", "-t", "3"}).status, 0);
  expect_same_tables("one", "three");
}

TEST_F(Study, several_at_a_time_start_the_longest_first) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "one core runs them one after the other";
  const Outcome outcome = run("a", {"--verbose", "-t", "2"});
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const std::string log = content_of(folder_ / "a/run.log") + outcome.out + outcome.error;
  const std::size_t fine = log.find("sphere_radius_1.4_mm_seed_3: starts"),
                    coarse = log.find("sphere_radius_2_mm_seed_3: starts");
  ASSERT_NE(fine, std::string::npos) << log;
  ASSERT_NE(coarse, std::string::npos) << log;
  EXPECT_LT(fine, coarse);
}

TEST_F(Study, one_stopped_by_a_signal_goes_on_to_the_same_table) {
  make_once("whole", slow);
  for (const int signal : {SIGTERM, SIGINT}) {
    const std::string name = "stopped_" + std::to_string(signal);
    Program program(command(name, slow), folder_);
    const fs::path inner = folder_ / name / "runs" / met_at_work;
    ASSERT_TRUE(program.wait_until([&] { return lines_in(inner / "history.csv") >= 20; }))
        << content_of(folder_ / "error.txt");
    program.send(signal);
    EXPECT_EQ(program.wait(), 128 + signal);
    EXPECT_EQ(summary_in(inner)["status"], "stopped");
    EXPECT_FALSE(fs::exists(folder_ / name / "summary.json"));
    EXPECT_EQ(lines_in(folder_ / name / "study.csv"), 3); // both runs of the first case
    expect(0, "", name, with(slow, {"--resume"}));
    EXPECT_TRUE(contains(content_of(inner / "run.log"), "resumed at step"));
    expect_same_tables(name, "whole");
    EXPECT_TRUE(contains(content_of(folder_ / name / "run.log"), "kept"));
  }
}

TEST_F(Study, a_killed_one_leaves_no_run_behind_and_goes_on) {
  make_once("whole", slow);
  Program program(command("killed", slow), folder_);
  const fs::path inner = folder_ / "killed/runs" / met_at_work;
  ASSERT_TRUE(program.wait_until([&] { return lines_in(inner / "history.csv") >= 20; }));
  program.send(SIGKILL);
  EXPECT_EQ(program.wait(), -SIGKILL);
  // The run that was under way stops on its own, and says so.
  for (int tenths = 0; tenths < 100 && !fs::exists(inner / "summary.json"); ++tenths)
    usleep(100000);
  ASSERT_EQ(summary_in(inner)["status"], "stopped");
  expect(0, "", "killed", with(slow, {"--resume"}));
  EXPECT_EQ(table("killed"), table("whole"));
}

TEST_F(Study, one_killed_at_random_comes_to_the_same_table) {
  expect_the_same_however_often_killed({}, "size");
}

TEST_F(Study, a_damaged_checkpoint_and_a_lost_summary_cost_only_that_run) {
  ASSERT_EQ(run("a", {"--quiet"}).status, 0);
  const std::string before = table("a");
  const fs::path one = folder_ / "a/runs/sphere_radius_2_mm_seed_4";
  fs::remove(one / "summary.json");
  for (const auto &file : fs::directory_iterator(one / "checkpoint"))
    put(file.path(), "no checkpoint");
  expect(0, "starts anew", "a", {"--resume"});
  EXPECT_EQ(table("a"), before);
}

// What the summary of one run has become, and what --resume has to say of it.
TEST_F(Study, a_summary_that_is_not_that_of_its_run_is_made_again_and_says_why) {
  ASSERT_EQ(run("a", one_size).status, 0);
  const std::string before = table("a");
  const std::string name = "sphere_radius_2_mm_seed_4";
  const fs::path one = folder_ / "a/runs" / name, summary = one / "summary.json";
  const std::string whole = content_of(summary);
  const auto made_again = [&](const std::string &reason) {
    const Outcome rest = run("a", with(one_size, {"--resume"}));
    EXPECT_EQ(rest.status, 0) << rest.error;
    EXPECT_EQ(table("a"), before);
    const std::string said = reason.empty() ? "" : name + ": is made again: " + reason;
    EXPECT_TRUE(contains(rest.error, said)) << rest.error;
    EXPECT_EQ(contains(rest.error, "again"), !reason.empty()) << rest.error;
  };
  made_again(""); // all as it was
  put(summary, "{\"status\": \"done\"}");
  made_again("scene.prm is not the scene that summary.json was made with");
  put(summary, content_of(summary).substr(0, 700));
  made_again("summary.json is damaged");
  fs::remove(summary);
  fs::create_directory(summary);
  EXPECT_EQ(run("a", with(one_size, {"--resume"})).status, 4); // in the way: no run can write there
  fs::remove(summary);
  made_again("");
  // Whole, but that of its neighbour; then with its scene, and with all that it left.
  const fs::path other = folder_ / "a/runs/sphere_radius_2_mm_seed_3";
  fs::copy_file(other / "summary.json", summary, fs::copy_options::overwrite_existing);
  made_again("scene.prm is not the scene that summary.json was made with");
  fs::copy_file(other / "summary.json", summary, fs::copy_options::overwrite_existing);
  fs::copy_file(other / "scene.prm", one / "scene.prm", fs::copy_options::overwrite_existing);
  made_again("it is of another scene: Scene/Seed was \"3\", now \"4\"");
  EXPECT_EQ(summary_in(one)["strength_pa"], nlohmann::json::parse(whole)["strength_pa"]);
}

TEST_F(Study, a_file_that_the_scene_names_has_to_be_the_one_that_was_run) {
  put(folder_ / "aggregate.txt", "1\n2\n3\n");
  const Words phases =
      with(one_size, set({"Phases/By = file", "Phases/File = " + (folder_ / "aggregate.txt").string()}));
  const Outcome first = run("a", phases);
  ASSERT_EQ(first.status, 0) << first.error;
  EXPECT_FALSE(contains(run("a", with(phases, {"--resume"})).error, "again"));
  put(folder_ / "aggregate.txt", "1\n2\n4\n");
  const Outcome rest = run("a", with(phases, {"--resume"}));
  EXPECT_EQ(rest.status, 0) << rest.error;
  for (const char *seed : {"seed_3", "seed_4"})
    EXPECT_TRUE(contains(
        rest.error, std::string(seed) + ": is made again: the file that Phases/File names has changed\n"))
        << rest.error;
}

TEST_F(Study, a_run_that_is_killed_is_told_by_its_signal_and_made_again) {
  const Words two = set({"Study/Sphere radius list = 2 mm, 1 mm", "Study/Seeds = 1"});
  const std::string finer = "sphere_radius_1_mm_seed_3";
  ASSERT_EQ(run("whole", two).status, 0);
  Program program(command("killed", two), folder_);
  const fs::path inner = folder_ / "killed/runs" / finer;
  ASSERT_TRUE(program.wait_until([&] { return lines_in(inner / "history.csv") >= 20; }));
  const pid_t child = child_of(program.id());
  ASSERT_GT(child, 0);
  kill(child, SIGKILL);
  EXPECT_EQ(program.wait(), 0);
  const std::string error = content_of(folder_ / "error.txt");
  EXPECT_TRUE(contains(error, finer + ": failed, ended by signal 9")) << error;
  EXPECT_EQ(words_in(folder_ / "killed/study.csv", "status"), (Words{"done", "failed"}));
  EXPECT_EQ(run("killed", with(two, {"--resume"})).status, 0);
  EXPECT_EQ(table("killed"), table("whole"));
}

// One that is gone is made again, one under another name is nobody's and stays.
TEST_F(Study, a_run_whose_folder_is_gone_or_renamed_is_made_again) {
  ASSERT_EQ(run("a", one_size).status, 0);
  const std::string before = table("a");
  fs::remove_all(folder_ / "a/runs/sphere_radius_2_mm_seed_3");
  fs::rename(folder_ / "a/runs/sphere_radius_2_mm_seed_4", folder_ / "a/runs/mine");
  EXPECT_EQ(run("a", with(one_size, {"--resume"})).status, 0);
  EXPECT_EQ(table("a"), before);
  EXPECT_TRUE(fs::exists(folder_ / "a/runs/mine/summary.json"));
}

TEST_F(Study, pipes_under_the_names_of_its_files_keep_nothing_waiting) {
  ASSERT_EQ(run("a", one_size).status, 0);
  const std::string before = table("a");
  const fs::path summary = folder_ / "a/runs/sphere_radius_2_mm_seed_3/summary.json";
  fs::remove(summary);
  ASSERT_EQ(mkfifo(summary.c_str(), 0600), 0);
  expect(0, "seed_3: is made again: summary.json is no file", "a", with(one_size, {"--resume"}));
  EXPECT_EQ(table("a"), before);
  fs::remove(folder_ / "a/study.json");
  ASSERT_EQ(mkfifo((folder_ / "a/study.json").c_str(), 0600), 0);
  EXPECT_EQ(run("a", with(one_size, {"--resume"})).status, 2);
}

TEST_F(Study, a_case_that_fails_is_told_and_survived) {
  // One step for all: above the limit of the smaller spheres, found when their run is set up.
  const Outcome outcome = run("a", {"-s", "Integration/Time step = 2.4e-7 s"});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_TRUE(contains(outcome.error, "2 of 4 runs failed")) << outcome.error;
  EXPECT_TRUE(contains(outcome.error, "Integration/Time step")) << outcome.error;
  EXPECT_EQ(words_in(folder_ / "a/study.csv", "status"), (Words{"done", "done", "failed", "failed"}));
  const std::vector<double> strength = column_of(folder_ / "a/study.csv", "strength_pa");
  EXPECT_GT(strength[1], 0);
  EXPECT_TRUE(std::isnan(strength[2]));
  EXPECT_EQ(json("a")["cases"][1]["failed"], 2);
  EXPECT_EQ(json("a")["cases"][1]["strength_pa"]["runs"], 0);
  EXPECT_TRUE(json("a")["cases"][1]["strength_pa"]["mean"].is_null());
  // Nothing left at all is no success.
  EXPECT_EQ(
      run("b", {"-s", "Integration/Time step = 2.4e-7 s", "-s", "Study/Sphere radius list = 1.4 mm"}).status,
      3);
}

// It is the machine that fails, not the case: no further run would fare better.
TEST_F(Study, a_disk_that_fills_in_a_run_ends_it_and_it_goes_on_later) {
  make_once("whole", {});
  // No file may grow beyond what tables of studies have, and less than the history of a run: what a full disk
  // does, but to these processes alone.
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{50000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const Outcome full = run("a", {"--quiet"});
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(full.status, 4);
  EXPECT_TRUE(contains(full.error, "error: sphere_radius_2_mm_seed_")) << full.error;
  EXPECT_TRUE(contains(full.error, ": cannot be written: File too large")) << full.error;
  EXPECT_FALSE(fs::exists(folder_ / "a/summary.json"));
  const Outcome rest = run("a", {"--quiet", "--resume"});
  EXPECT_EQ(rest.status, 0) << rest.error;
  EXPECT_EQ(table("a"), table("whole"));
}

TEST_F(Study, what_the_scene_expects_is_asked_of_every_run) {
  const Outcome outcome = run("a", {"-s", "Expect/particles = ... 150"});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_TRUE(contains(outcome.error, "sphere_radius_1.4_mm_seed_3")) << outcome.error;
  EXPECT_FALSE(contains(outcome.error, "sphere_radius_2_mm_seed")) << outcome.error;
  EXPECT_EQ(summary_in(folder_ / "a")["missed"].size(), 2u);
  const nlohmann::json expectations = summary_in(folder_ / "a")["expectations"];
  ASSERT_EQ(expectations.size(), 4u); // one of each run
  int missed = 0;
  for (const auto &one : expectations) {
    EXPECT_EQ(one["entry"], "Expect/particles");
    EXPECT_EQ(one["met"], one["value"] <= 150);
    missed += one["met"] == false && contains(one["run"], "sphere_radius_1.4_mm_seed_");
  }
  EXPECT_EQ(missed, 2);
}

// In the mean of three packings: of 75 spheres, what a crack sets free is as much as the motion of slow
// platens.
TEST_F(Study, a_faster_test_is_less_quasi_static) {
  const Outcome outcome =
      run("a", {"--quiet", "-s", "Study/Axial rate list = 0.2 m/s, 10 m/s", "-s", "Study/Seeds = 3"}, "rate");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const fs::path csv = folder_ / "a/study.csv";
  EXPECT_EQ(column_of(csv, "axial_rate_m_s"), (std::vector<double>{0.2, 0.2, 0.2, 10, 10, 10}));
  const std::vector<double> kinetic = column_of(csv, "kinetic_to_internal_max"),
                            crossings = column_of(csv, "wave_crossings_to_peak");
  EXPECT_GT(kinetic[3] + kinetic[4] + kinetic[5], 1.5 * (kinetic[0] + kinetic[1] + kinetic[2]));
  for (int seed = 0; seed < 3; ++seed)
    EXPECT_GT(crossings[seed], 4 * crossings[3 + seed]);
}

TEST_F(Study, thicker_bonds_and_more_of_them_are_stiffer) {
  const Outcome outcome = run("a",
                              {"--quiet", "-s", "Study/Gap list = 0.02 R_min, 0.15 R_min", "-s",
                               "Study/Radius multiplier list = 0.7, 1", "-s", "Study/Seeds = 1"},
                              "packing");
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const fs::path csv = folder_ / "a/study.csv";
  EXPECT_EQ(column_of(csv, "gap_over_radius"), (std::vector<double>{0.02, 0.15, 0.02, 0.15}));
  EXPECT_EQ(column_of(csv, "radius_multiplier"), (std::vector<double>{0.7, 0.7, 1, 1}));
  const std::vector<double> bonds = column_of(csv, "bonds"),
                            young = column_of(csv, "youngs_modulus_gauge_pa");
  EXPECT_GT(bonds[1], bonds[0]);
  EXPECT_EQ(bonds[0], bonds[2]); // the same packing
  EXPECT_GT(young[1], young[0]);
  EXPECT_GT(young[2], young[0]);
}

TEST_F(Study, another_scene_or_kind_is_not_resumed_nor_overwritten_unasked) {
  const Words quick = with(one_size, set({"Study/Axial rate list = 1 m/s", "Study/Seeds = 1"}));
  ASSERT_EQ(run("a", quick).status, 0);
  const std::string before = table("a");
  expect(2, "is of a study of size", "a", with(quick, {"--resume"}), "rate");
  expect(2, "Study/Seeds = 2 was 1 when the run began", "a", {"--resume"});
  EXPECT_EQ(run("a", quick).status, 2);
  EXPECT_EQ(table("a"), before);
  fs::remove_all(folder_ / "b");
  fs::create_directory(folder_ / "b");
  fs::rename(folder_ / "a/runs", folder_ / "b/runs");
  EXPECT_EQ(run("b", quick).status, 2); // runs of who knows what
  put(folder_ / "b/runs/notes/of_the_user.txt", "kept");
  ASSERT_EQ(run("b", with(quick, {"--overwrite"}), "rate").status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "b/runs/sphere_radius_2_mm_seed_3"));
  EXPECT_TRUE(fs::exists(folder_ / "b/runs/rate_1_seed_3/summary.json"));
  EXPECT_TRUE(fs::exists(folder_ / "b/runs/notes/of_the_user.txt"));
}

TEST_F(Study, a_dry_run_tells_of_each_case_and_writes_nothing) {
  const Outcome outcome = run("a", {"--dry-run"});
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_TRUE(contains(outcome.out, "2 cases on seeds 3 to 4, 4 runs")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "sphere_radius_1.4_mm_seed_3\n")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "time step")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "all 4 runs: ") && contains(outcome.out, " of one core, "))
      << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "a"));
  const Outcome staged = run(
      "a", {"--dry-run", "-s", "Loading/Stage 1/Axial = rate", "-s", "Loading/Stage 1/Until = strain 0.5 %"});
  EXPECT_TRUE(contains(staged.out, "all 4 runs: time not counted")) << staged.out << staged.error;
}

TEST(SeedStatistics, a_number_that_was_not_measured_does_not_count) {
  SeedStatistics s;
  for (const double value : {2.0, std::nan(""), 4.0, 9.0})
    s.add(value);
  EXPECT_EQ(s.count(), 3u);
  EXPECT_DOUBLE_EQ(s.mean(), 5);
  EXPECT_DOUBLE_EQ(s.deviation(), std::sqrt(13.0)); // (9 + 1 + 16) / 2
  SeedStatistics one;
  one.add(7);
  EXPECT_TRUE(std::isnan(one.deviation()));
  EXPECT_TRUE(std::isnan(SeedStatistics().mean()));
}

} // namespace
} // namespace platen::apps::testing
