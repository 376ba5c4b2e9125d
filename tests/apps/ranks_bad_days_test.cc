// Ranks on bad days: what is refused, stopped, killed or fails under way, as a user sees it through mpirun.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <sstream>

#include "apps/on_ranks.h"

namespace platen::apps::testing {
namespace {

class BadDays : public OnRanks {
protected:
  // The own message stands first, once, and before what mpirun has to say.
  void expect_told_once(const Outcome &outcome, int status, const std::string &part) const {
    EXPECT_EQ(outcome.status, status) << outcome.error;
    std::istringstream lines(outcome.error);
    std::string first;
    while (std::getline(lines, first) && first.rfind("mpiexec: Forwarding signal", 0) == 0) {
    }
    EXPECT_TRUE(contains(first, part)) << "expected first: " << part << "\ncame: " << outcome.error;
    EXPECT_EQ(count_of(outcome.error, part), 1) << outcome.error;
    EXPECT_EQ(count_of(outcome.out + outcome.error, "rank 1: "), 0) << outcome.error;
  }
  std::vector<std::string> app(const std::string &name) const {
    return {(fs::path(PLATEN_COMPRESS_PROGRAM).parent_path() / name).string(), test_scene("crushed.prm"),
            "-o", "none"};
  }
  // Resumed on so many ranks, it ends as the run that nobody disturbed.
  void expect_resumes(const std::string &name, int ranks) const {
    run_on(ranks, name, {"--resume"});
    EXPECT_EQ(unlike("whole", name), "") << "resumed on " << ranks;
  }
  // Step of the newest checkpoint; -1 without one.
  long newest_step(const std::string &name) const {
    long newest = -1;
    std::error_code none;
    for (const auto &file : fs::directory_iterator(folder_ / name / "checkpoint", none))
      if (const std::string stem = file.path().filename().string(); !contains(stem, ".part."))
        newest = std::max(newest, std::stol(stem.substr(5)));
    return newest;
  }
};

TEST_F(BadDays, what_is_refused_is_told_once_with_status_2) {
  expect_told_once(run(on(3, crush("none", {"-s", "Specimen/Radius = -10 mm"}))), 2,
                   "Specimen/Radius = -10 mm");
  put(folder_ / "taken/history.csv", "an earlier run\n");
  expect_told_once(run(on(3, crush("taken"))), 2, "output folder taken: ");
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  for (const char *name :
       {"platen-pack", "platen-study", "platen-report", "platen-calibrate", "platen-bonds", "platen-bar"}) {
    std::vector<std::string> command = app(name);
    if (contains(name, "study")) command.insert(command.begin() + 1, "size");
    const Outcome outcome = run(on(2, command));
    expect_told_once(outcome, 2, "mpirun has started 2 processes of " + std::string(name));
    EXPECT_TRUE(contains(outcome.error, "platen-compress and platen-brazilian run on several ranks"));
    EXPECT_FALSE(fs::exists(folder_ / "none")) << name;
  }
}

// Each of these waited for ever, or mixed two tests.
TEST_F(BadDays, ranks_started_with_different_lines_are_refused) {
  const auto beside = [&](const std::vector<std::string> &second) {
    std::vector<std::string> command = on(1, crush("none"));
    command.insert(command.end(), {":", "-n", "1"});
    command.insert(command.end(), second.begin(), second.end());
    expect_told_once(run(command), 2, "ranks were started with different scenes or entries");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
  };
  beside(crush("none", {"-s", "Loading/Target strain = 0.003"}));
  beside(crush("none", {"--dry-run"}));
  beside(crush("none", {"--help"}));
  std::vector<std::string> another = crush("none");
  another[0] = app("platen-brazilian")[0];
  beside(another);
}

// On two machines one name may stand for two files.
TEST_F(BadDays, scenes_of_one_name_with_different_content_are_refused) {
  std::string scene = content_of(test_scene("crushed.prm"));
  put(folder_ / "0/scene.prm", scene);
  const std::string seed = "Seed = 3";
  ASSERT_EQ(count_of(scene, seed), 1);
  put(folder_ / "1/scene.prm", scene.replace(scene.find(seed), seed.size(), "Seed = 4"));
  const std::string go = R"(cd "$OMPI_COMM_WORLD_RANK" && exec "$@")";
  const Outcome outcome = run(
      on(2, {"/bin/sh", "-c", go, "sh", PLATEN_COMPRESS_PROGRAM, "scene.prm", "-o", "results", "--quiet"}));
  expect_told_once(outcome, 2, "ranks were started with different scenes or entries");
  EXPECT_FALSE(fs::exists(folder_ / "0/results"));
}

TEST_F(BadDays, more_ranks_than_blocks_are_warned_of_and_change_no_byte) {
  const std::vector<std::string> entries{"-s", "Loading/Target strain = 0.002"};
  run_whole("whole", entries);
  run_on(5, "many", entries);
  EXPECT_TRUE(contains(content_of(folder_ / "many/run.log"),
                       "warning: 2 of 5 ranks have nothing to do: the specimen has 3 blocks of 512 spheres. "
                       "Useful: 3 ranks"));
  EXPECT_EQ(unlike("whole", "many"), "");
}

TEST_F(BadDays, a_stop_asked_of_mpirun_leaves_a_checkpoint) {
  run_whole("whole");
  const int status =
      disturb(on(2, crush("stopped")), "stopped", 8, [](Program &program) { program.send(SIGTERM); });
  EXPECT_NE(status, 0); // mpirun's own
  ASSERT_GE(newest_step("stopped"), 0) << said();
  expect_resumes("stopped", 3);
}

TEST_F(BadDays, a_checkpoint_asked_of_any_rank_is_written) {
  for (const int rank : {0, 1}) {
    const std::string name = "asked_" + std::to_string(rank);
    bool written = false;
    const int status =
        disturb(on(2, crush(name, {"-s", "Checkpoint/Every = 1000000"})), name, 4, [&](Program &program) {
          kill(process_of_rank(program.id(), rank), SIGUSR1);
          written = program.wait_until([&] { return newest_step(name) > 0; });
        });
    EXPECT_EQ(status, 0) << said();
    EXPECT_TRUE(written) << rank;
  }
}

TEST_F(BadDays, a_file_that_is_removed_or_cannot_grow_ends_all_once_with_status_4) {
  run_whole("whole");
  const auto failing = [&](const std::string &name, const std::string &part, const auto &act) {
    Outcome outcome;
    outcome.status = disturb(on(2, crush(name)), name, 18, act);
    outcome.error = said();
    expect_told_once(outcome, 4, part);
  };
  failing("removed", "error: removed/history.csv: has been removed",
          [&](Program &) { fs::remove(folder_ / "removed/history.csv"); });
  const Outcome lost = run(crush("removed", {"--resume"}));
  EXPECT_EQ(lost.status, 2);
  EXPECT_TRUE(contains(lost.error, "history.csv: error: is missing")) << lost.error;
  failing("full", ": cannot be written: File too large", [&](Program &program) {
    const rlimit few{1000, 1000};
    ASSERT_EQ(prlimit(process_of_rank(program.id(), 0), RLIMIT_FSIZE, &few, nullptr), 0);
  });
  expect_resumes("full", 1);
}

TEST_F(BadDays, a_rank_that_is_killed_ends_all_and_the_run_resumes_on_any_number_of_ranks) {
  run_whole("whole");
  for (const int rank : {0, 2}) {
    const std::string name = "killed_" + std::to_string(rank);
    std::chrono::steady_clock::time_point killed;
    const int status = disturb(on(3, crush(name)), name, 30, [&](Program &program) {
      kill(process_of_rank(program.id(), rank), SIGKILL);
      killed = std::chrono::steady_clock::now();
    });
    EXPECT_EQ(status, 128 + SIGKILL);
    EXPECT_LT(std::chrono::steady_clock::now() - killed, std::chrono::seconds(20));
    EXPECT_FALSE(fs::exists(folder_ / name / "summary.json"));
    ASSERT_GE(newest_step(name), 200);
    expect_resumes(name, rank == 0 ? 1 : 2);
  }
}

} // namespace
} // namespace platen::apps::testing
