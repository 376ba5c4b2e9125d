// Checkpoints of real runs with one bit turned over, or cut off: each is passed over and named, none is read.
#include <gtest/gtest.h>

#include <random>

#include "apps/output/checkpoint_folder.h"
#include "apps/program.h"
#include "apps/scratch_folder.h"
#include "measured.h"

namespace platen::apps::testing {
namespace {

constexpr int flips = 1000, cuts = 50; // of each kind of run
constexpr int resumed = 4;             // of them, by the program itself: a second each

// What platens, and what holds the specimen from the side: each has a state of its own in the checkpoint.
struct Kind {
  const char *name;
  std::vector<std::string> entries;
};
const Kind kinds[] = {
    {"rigid", {}},
    {"elastic", {"Platens/Kind = deformable"}},
    {"sleeve",
     {"Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
      "Loading/Confining ramp = 0.1 ms", "Sleeve/Thickness = 1 mm"}},
};

class CheckpointDamage : public ScratchFolder {
protected:
  // Arguments of a run of 129 spheres into the folder `name`.
  std::vector<std::string> run(const Kind &kind, const std::string &name) const {
    std::vector<std::string> arguments{test_scene("crushed.prm"), "-o", name, "-t", "1"};
    std::vector<std::string> entries{"Specimen/Sphere radius = 1.7 mm", "Checkpoint/Every = 100",
                                     "Loading/Target strain = 0.003"};
    entries.insert(entries.end(), kind.entries.begin(), kind.entries.end());
    for (const std::string &entry : entries)
      arguments.insert(arguments.end(), {"-s", entry});
    return arguments;
  }
  fs::path checkpoints(const Kind &kind) const { return folder_ / kind.name / "checkpoint"; }
  // The two checkpoints that a whole run leaves, older first.
  std::vector<fs::path> run_whole(const Kind &kind) const {
    const Outcome outcome = run_compress(run(kind, kind.name), folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    std::vector<fs::path> files;
    for (const auto &file : fs::directory_iterator(checkpoints(kind)))
      files.push_back(file.path());
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files.size(), 2u);
    return files;
  }
  // Whether the damaged newer one is passed over with its name, and refused where it stands alone.
  static bool is_told(const fs::path &older, const fs::path &newer) {
    const FoundCheckpoint found = newest_whole_checkpoint(older.parent_path());
    if (found.path != older || found.remarks.size() != 1 || !contains(found.remarks[0], newer.string()))
      return false;
    try {
      CheckpointReader read(newer);
    } catch (const CheckpointError &) {
      return true;
    }
    return false;
  }
  // The program goes on from the older one, says so, and ends with the same bytes.
  void expect_resumed(const Kind &kind, const fs::path &newer,
                      const std::map<std::string, std::string> &whole) const {
    const fs::path copy = folder_ / "copy";
    fs::remove_all(copy);
    fs::copy(folder_ / kind.name, copy, fs::copy_options::recursive);
    std::vector<std::string> arguments = run(kind, "copy");
    arguments.push_back("--resume");
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    EXPECT_TRUE(contains(outcome.error, "warning: checkpoint not used")) << outcome.error;
    EXPECT_TRUE(contains(outcome.error, newer.filename().string())) << outcome.error;
    EXPECT_EQ(difference(whole, results_in(copy)), "") << kind.name;
  }
};

void flip(const fs::path &path, std::uint64_t bit) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(bit / 8));
  const int turned = file.get() ^ (1 << bit % 8);
  file.seekp(static_cast<std::streamoff>(bit / 8));
  file.put(static_cast<char>(turned));
}

TEST_F(CheckpointDamage, long_every_flipped_bit_is_told) {
  std::mt19937_64 random(36);
  int told = 0;
  for (const Kind &kind : kinds) {
    const std::vector<fs::path> files = run_whole(kind);
    const auto whole = results_in(folder_ / kind.name);
    std::uniform_int_distribution<std::uint64_t> bits(0, 8 * fs::file_size(files[1]) - 1);
    for (int k = 0; k < flips; ++k) {
      const std::uint64_t bit = bits(random);
      flip(files[1], bit);
      const bool passed_over = is_told(files[0], files[1]);
      told += passed_over;
      EXPECT_TRUE(passed_over) << kind.name << ", bit " << bit;
      if (k < resumed) expect_resumed(kind, files[1], whole);
      flip(files[1], bit);
    }
    EXPECT_EQ(newest_whole_checkpoint(checkpoints(kind)).path, files[1]); // nothing else was wrong with it
  }
  measured::note_figure(36, "flipped_bits_told", told, "of 3000");
}

TEST_F(CheckpointDamage, long_every_cut_is_told) {
  std::mt19937_64 random(37);
  int told = 0;
  for (const Kind &kind : kinds) {
    const std::vector<fs::path> files = run_whole(kind);
    const auto whole = results_in(folder_ / kind.name);
    const std::string bytes = content_of(files[1]);
    std::uniform_int_distribution<std::uint64_t> lengths(0, bytes.size() - 1);
    for (int k = 0; k < cuts; ++k) {
      const std::uint64_t length = k == 0 ? 0 : k == 1 ? bytes.size() - 1 : lengths(random);
      fs::resize_file(files[1], length);
      const bool passed_over = is_told(files[0], files[1]);
      told += passed_over;
      EXPECT_TRUE(passed_over) << kind.name << ", cut to " << length;
      if (k < resumed) expect_resumed(kind, files[1], whole);
      put(files[1], bytes);
    }
  }
  measured::note_figure(36, "cuts_told", told, "of 150");
}

TEST_F(CheckpointDamage, long_a_run_without_a_whole_one_is_refused) {
  for (const Kind &kind : kinds) {
    const std::vector<fs::path> files = run_whole(kind);
    const auto before = results_in(folder_ / kind.name);
    for (const fs::path &file : files)
      flip(file, 4 * fs::file_size(file));
    std::vector<std::string> arguments = run(kind, kind.name);
    arguments.push_back("--resume");
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 2) << outcome.error;
    for (const fs::path &file : files)
      EXPECT_TRUE(contains(outcome.error, file.filename().string())) << outcome.error;
    EXPECT_EQ(difference(before, results_in(folder_ / kind.name)), "") << kind.name;
  }
}

} // namespace
} // namespace platen::apps::testing
