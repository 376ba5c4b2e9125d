// platen-compress over ranks: checkpoints that no rank has gathered, and who goes on from them.
#include <gtest/gtest.h>

#include <set>

#include "apps/output/checkpoint.h"
#include "apps/program.h"
#include "apps/scratch_folder.h"
#include "tests/same_state.h"

namespace platen::apps::testing {
namespace {

class RankCheckpoints : public ScratchFolder {
protected:
  // Into the folder `name`; checkpoints fall between rows and frames. 0 ranks: without mpirun.
  void crush(const std::string &name, int ranks, const std::string &strain, bool resumes = false) const {
    std::vector<std::string> command =
        compress_command({scene_, "-o", name, "-t", "1", "--quiet", "-s", "Loading/Target strain = " + strain,
                          "-s", "Checkpoint/Every = 313"});
    if (ranks > 0) command.insert(command.begin(), {PLATEN_MPIEXEC, "-n", std::to_string(ranks)});
    if (resumes) command.push_back("--resume");
    EXPECT_EQ(Program(command, folder_).wait(), 0) << name << ": " << content_of(folder_ / "error.txt");
  }
  void expect_the_same_checkpoint(const std::string &a, const std::string &b, const std::string &step) const {
    const auto path = [&](const std::string &name) {
      return folder_ / name / "checkpoint" / ("step_000000" + step + ".platen");
    };
    ASSERT_TRUE(fs::exists(path(a))) << path(a);
    ASSERT_TRUE(fs::exists(path(b))) << path(b);
    EXPECT_TRUE(same_state(state_in(path(a)), state_in(path(b)))) << "step " << step;
  }
  void expect_the_same_results(const std::string &a, const std::string &b) const {
    EXPECT_EQ(difference(results_in(folder_ / a), results_in(folder_ / b)), "") << a << " and " << b;
  }
  // But for the time that the run took.
  static State state_in(const fs::path &path) {
    const CheckpointReader file(path);
    State state;
    for (const std::string &name : file.names()) {
      const StoredBlock block = *file.find(name);
      std::vector<char> bytes(block.rows * block.type.bytes_per_row());
      file.read(name, bytes.data());
      state.add(name, block.type, bytes.data(), block.rows);
    }
    return without(state, "files/wall_seconds");
  }
  const std::string scene_ = test_scene("crushed.prm");
};

TEST_F(RankCheckpoints, are_those_of_one_process_and_any_number_of_ranks_goes_on_from_them) {
  crush("one", 0, "0.003"), crush("three", 3, "0.003");
  EXPECT_GT(lines_in(folder_ / "one" / "cracks.csv"), 100);
  expect_the_same_results("one", "three");
  std::set<std::string> steps;
  for (const auto &file : fs::directory_iterator(folder_ / "one" / "checkpoint"))
    steps.insert(file.path().stem().string().substr(11));
  ASSERT_EQ(steps.size(), 2u);
  for (const std::string &step : steps)
    expect_the_same_checkpoint("one", "three", step);
  // The last one has the end of its run, which is gathered; the one before does not.
  for (const char *name : {"three", "onward"}) {
    if (std::string(name) == "onward")
      fs::copy(folder_ / "three", folder_ / name, fs::copy_options::recursive);
    fs::remove(folder_ / name / "checkpoint" / ("step_000000" + *steps.rbegin() + ".platen"));
  }
  crush("three", 2, "0.003", true), crush("onward", 0, "0.003", true);
  expect_the_same_results("one", "three");
  expect_the_same_results("one", "onward");
}

} // namespace
} // namespace platen::apps::testing
