// The file of one checkpoint, written by ranks that hold a part of its rows each: the bytes that one process
// writes, and any number of ranks goes on from it. Every rank has both models.
#include "apps/output/checkpoint.h"
#include "apps/output/checkpoint_folder.h"
#include "apps/output/rank_checkpoint.h"
#include "apps/scene/rank.h"
#include "dist/ranks.h"
#include "tests/dist/cracking_block.h"
#include "tests/dist/on_ranks.h"
#include "tests/same_state.h"

using namespace platen;
using namespace platen::apps;
using namespace platen::dist;
namespace fs = std::filesystem;

namespace {

using namespace platen::dist::testing;

// A block that is cut over these ranks.
std::unique_ptr<dem::Model> cut_block(const dem::ModelSettings &settings, MPI_Comm over) {
  auto model = block_of(settings);
  model->share(std::make_unique<Ranks>(over));
  return model;
}

// A text of another length on each rank, between rows of the specimen: rank 0's counts.
void fill(StateSink &to, const dem::Model &model) {
  const int rank = this_rank().number;
  add_text(to, "begin", std::string(static_cast<std::size_t>(3 + 2 * rank), static_cast<char>('a' + rank)));
  save_part(to, "specimen", model);
  add_rows(to, "end", std::vector<double>{1, 2, 3}, "m");
}

fs::path write_of_ranks(dem::Model &model, const fs::path &folder, std::uint64_t step) {
  const auto &ranks = dynamic_cast<const Ranks &>(*model.exchange());
  model.settle_state();
  return write_rank_checkpoint(ranks.communicator(), SpreadState(ranks, model, "specimen/"), folder, step,
                               [&](StateSink &to) { fill(to, model); });
}

class Checkpoint : public dist::testing::WithFolder {
protected:
  void SetUp() override {
    this_rank() = {rank_of_this(), number_of_ranks()};
    WithFolder::SetUp();
  }
  void TearDown() override {
    WithFolder::TearDown();
    this_rank() = {};
  }
  // By rank 0, read by all.
  std::string bytes_of_one_process(const dem::Model &model, std::uint64_t step) const {
    write_checkpoint(folder_ / "one", step, [&](StateSink &to) { fill(to, model); });
    MPI_Barrier(MPI_COMM_WORLD);
    return bytes_in(checkpoint_path(folder_ / "one", step));
  }
  void expect_the_same_file(const dem::Model &alone, dem::Model &cut, std::uint64_t step) const {
    ASSERT_TRUE(cut.is_cut());
    const std::string one = bytes_of_one_process(alone, step),
                      many = bytes_in(write_of_ranks(cut, folder_ / "many", step));
    MPI_Barrier(MPI_COMM_WORLD);
    ASSERT_GT(one.size(), 100000u);
    EXPECT_EQ(one.size(), many.size()) << "step " << step;
    if (one == many) return;
    const auto difference = first_difference(CheckpointReader(checkpoint_path(folder_ / "one", step)),
                                             CheckpointReader(checkpoint_path(folder_ / "many", step)));
    ADD_FAILURE() << "step " << step << ": one and many: " << difference.value_or("the checksums alone");
  }
  // Three of them: in the middle of it, where bonds have broken in the last step, and later on.
  void expect_the_same_files(const dem::ModelSettings &settings) const {
    const auto alone = block_of(settings), cut = cut_block(settings, MPI_COMM_WORLD);
    const double dt = .5 * alone->stable_step({}, 0).limit;
    run(*alone, 20, dt), run(*cut, 20, dt);
    expect_the_same_file(*alone, *cut, 20);
    int steps = 20;
    do {
      run(*alone, 1, dt), run(*cut, 1, dt); // begins each step anew
      alone->end_step(dt), cut->end_step(dt);
    } while (alone->breaks == 0 && ++steps < 400);
    ASSERT_GT(alone->breaks, 0) << "nothing broke in 400 steps";
    expect_the_same_file(*alone, *cut, 400);
    run(*alone, 20, dt), run(*cut, 20, dt);
    expect_the_same_file(*alone, *cut, 440);
    cut->gather();
    EXPECT_TRUE(same_state(*alone, *cut)) << "after the checkpoints";
    EXPECT_EQ(alone->energy().residual(), cut->energy().residual());
  }
};

TEST_F(Checkpoint, is_the_file_of_one_process) {
  for (const char *name :
       {"all_effects", "hertz_and_rolling", "interfaces", "bonds_alone", "without_rotation"}) {
    SCOPED_TRACE(name);
    expect_the_same_files(set_up(name));
  }
  dem::ModelSettings with_history = set_up("all_effects"), bare = set_up("bonds_alone");
  with_history.bond_dashpot = 0;
  with_history.contact = set_up("hertz_and_rolling").contact;
  with_history.contact->damping = .2;
  bare.rotation = false;
  expect_the_same_files(with_history);
  expect_the_same_files(bare);
  const auto alone = block_of(set_up("grains")), cut = cut_block(set_up("grains"), MPI_COMM_WORLD);
  run(*alone, 20, 1e-7), run(*cut, 20, 1e-7);
  expect_the_same_file(*alone, *cut, 20);
}

// Two groups of ranks, the first smaller, and one process go on from the file of all.
TEST_F(Checkpoint, is_gone_on_from_by_other_numbers_of_ranks) {
  const auto before = cut_block(set_up("all_effects"), MPI_COMM_WORLD);
  const double dt = .5 * before->stable_step({}, 0).limit;
  run(*before, 60, dt);
  const fs::path path = write_of_ranks(*before, folder_, 60);
  run(*before, 20, dt);
  before->gather();
  MPI_Comm group = MPI_COMM_NULL;
  const int first = (number_of_ranks() + 2) / 3;
  MPI_Comm_split(MPI_COMM_WORLD, rank_of_this() < first, rank_of_this(), &group);
  const auto resumed = cut_block(set_up("all_effects"), group), alone = block_of(set_up("all_effects"));
  for (dem::Model *model : {resumed.get(), alone.get()}) {
    read_part(CheckpointReader(path), "specimen", *model);
    run(*model, 20, dt);
  }
  resumed->gather();
  EXPECT_TRUE(same_state(*before, *resumed)) << "on ranks";
  EXPECT_TRUE(same_state(*before, *alone)) << "in one process";
  EXPECT_GT(alone->broken_tension, 0);
  MPI_Comm_free(&group);
}

// The last rank may write no byte beyond the first hundred of a file.
TEST_F(Checkpoint, that_one_rank_cannot_write_leaves_the_former_ones) {
  const auto cut = cut_block(set_up("all_effects"), MPI_COMM_WORLD);
  run(*cut, 10, 1e-8);
  const std::string former = bytes_in(write_of_ranks(*cut, folder_, 10));
  run(*cut, 10, 1e-8);
  // One that has rows to write.
  const int last = dynamic_cast<const Ranks &>(*cut->exchange()).partition().useful_ranks - 1;
  std::string error;
  with_small_files(last, 100, [&] {
    try {
      write_of_ranks(*cut, folder_, 20);
    } catch (const OutputError &e) {
      error = e.what();
    }
  });
  const fs::path path = checkpoint_path(folder_, 20);
  EXPECT_EQ(error, part_path(path).string() + ": cannot be written: File too large (rank " +
                       std::to_string(last) + ")");
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(path));
  EXPECT_FALSE(fs::exists(part_path(path)));
  EXPECT_TRUE(bytes_in(checkpoint_path(folder_, 10)) == former);
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_EQ(CheckpointReader(write_of_ranks(*cut, folder_, 30)).find("specimen/time")->rows,
            1u); // room again
}

TEST_F(Checkpoint, whose_folder_cannot_be_made_is_told_on_all_ranks) {
  const auto cut = cut_block(set_up("all_effects"), MPI_COMM_WORLD);
  run(*cut, 10, 1e-8);
  const fs::path file = folder_ / "file";
  if (rank_of_this() == 0) std::ofstream(file) << "no folder";
  MPI_Barrier(MPI_COMM_WORLD);
  try {
    write_of_ranks(*cut, file, 10);
    ADD_FAILURE() << "a file was taken for a folder";
  } catch (const OutputError &e) {
    EXPECT_EQ(std::string(e.what()).rfind(file.string() + ": cannot be created", 0), 0u) << e.what();
  }
}

TEST_F(Checkpoint, of_ranks_keeps_the_two_newest) {
  const auto cut = cut_block(set_up("all_effects"), MPI_COMM_WORLD);
  for (const std::uint64_t step : {10, 20, 30}) {
    run(*cut, 10, 1e-8);
    write_of_ranks(*cut, folder_, step);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_FALSE(fs::exists(checkpoint_path(folder_, 10)));
  EXPECT_TRUE(fs::exists(checkpoint_path(folder_, 20)));
  EXPECT_EQ(newest_whole_checkpoint(folder_).step, 30u);
}

} // namespace
