// Checkpoints whose checksums hold and whose numbers cannot be: refused before anything is written, with the
// file, the block, the row, the value and what is allowed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "apps/output/checkpoint_folder.h"
#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

struct Number {
  std::string block;
  std::size_t place; // of the block's numbers
  double value;
  std::string allowed; // as the message has it
};

class WrongState : public ScratchFolder {
protected:
  std::vector<std::string> arguments_{test_scene("crushed.prm"), "-o", "run", "-t", "1"};
  fs::path checkpoint_;

  void run(const std::vector<std::string> &entries) {
    for (const std::string &entry : entries)
      arguments_.insert(arguments_.end(), {"-s", entry});
    const Outcome outcome = run_compress(arguments_, folder_);
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    checkpoint_ = newest_whole_checkpoint(folder_ / "run" / "checkpoint").path;
    for (const auto &file : fs::directory_iterator(checkpoint_.parent_path()))
      if (file.path() != checkpoint_) fs::remove(file.path());
  }
  // The checkpoint with one number in place of another, and checksums that hold.
  void put_number(const Number &number, const fs::path &whole) const {
    const CheckpointReader from(whole);
    CheckpointWriter to(checkpoint_);
    for (const std::string &name : from.names()) {
      const StoredBlock block = *from.find(name);
      std::vector<char> bytes(block.rows * block.type.bytes_per_row());
      if (!bytes.empty()) from.read(name, bytes.data());
      if (name == number.block) {
        char *at = bytes.data() + number.place * block.type.bytes;
        const int whole_number = std::isnan(number.value) ? 0 : static_cast<int>(number.value);
        if (block.type.kind == BlockType::Kind::floating)
          std::memcpy(at, &number.value, sizeof number.value);
        else
          std::memcpy(at, &whole_number, std::min<std::size_t>(block.type.bytes, sizeof whole_number));
      }
      to.add(name, block.type, bytes.data(), block.rows);
    }
    to.finish();
  }
  Outcome resumed() const {
    std::vector<std::string> arguments = arguments_;
    arguments.push_back("--resume");
    return run_compress(arguments, folder_);
  }
};

const std::vector<std::string> small{"Specimen/Sphere radius = 1.7 mm", "Checkpoint/Every = 100",
                                     "Loading/Target strain = 0.003"};

TEST_F(WrongState, a_number_that_cannot_be_is_status_two_with_its_place_and_nothing_is_written) {
  run(small);
  const fs::path whole = folder_ / "whole.platen";
  fs::copy(checkpoint_, whole);
  const auto results = results_in(folder_ / "run");
  const CheckpointReader good(whole);
  const std::size_t spheres = good.find("test/specimen/particles/mass")->rows,
                    bonds = good.find("test/specimen/bonds/records/state")->rows;
  const std::string row = "0 ... " + std::to_string(spheres - 1), nan = "nan";
  for (const Number &number : std::vector<Number>{
           {"test/specimen/bonds/rows/first", 0, 1000000, row},
           {"test/specimen/bonds/rows/first", 0, -1, row},
           {"test/specimen/bonds/rows/second", 3, -1, row},
           {"test/specimen/bonds/rows/record", 2, 1000000, "0 ... " + std::to_string(bonds - 1)},
           {"test/specimen/bonds/records/state", 1, 7, "0 ... 3"},
           {"test/specimen/bonds/rows/normal_stiffness", 1, -1, ">= 0"},
           {"test/specimen/particles/mass", 5, -1, "> 0 kg"},
           {"test/specimen/particles/mass", 5, std::nan(""), "> 0 kg"},
           {"test/specimen/particles/radius", 0, 0, "> 0 m"},
           {"test/specimen/particles/inertia", 1, -1, "> 0 kg m^2"},
           {"test/specimen/particles/position", 4, std::numeric_limits<double>::infinity(), "finite numbers"},
           {"test/specimen/particles/orientation", 4, 1e6, "a row of length 1"},
           {"test/specimen/particles/id", 1, 1000000, row},
           {"test/bottom/contacts/rows/particle", 0, -1, row},
           {"test/bottom/body/rotation", 0, 2, "a row of length 1"},
           {"test/program/stage", 0, 1000000, "0 ... 0"},
           {"test/time_step", 0, 0, "> 0 s"},
           {"results/samples/intact_bonds", 0, -1, "0 ... "},
           {"files/frames", 0, -1, "0 ... 2147483647"},
       }) {
    put_number(number, whole);
    const Outcome outcome = resumed();
    EXPECT_EQ(outcome.status, 2) << number.block << ": " << outcome.error;
    const std::size_t numbers = good.find(number.block)->type.numbers;
    for (const std::string &part :
         {checkpoint_.filename().string(), "\"" + number.block + "\"",
          "row " + std::to_string(number.place / numbers) + ": ", std::string("Allowed: "), number.allowed})
      EXPECT_TRUE(contains(outcome.error, part)) << number.block << ": " << outcome.error << " not: " << part;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(difference(results, results_in(folder_ / "run")), "") << number.block;
  }
  put_number({}, whole); // written by the same hand, with nothing changed
  const Outcome outcome = resumed();
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(difference(results, results_in(folder_ / "run")), "");
}

// What the program keeps beside the test: a number that it only tells may be any, and is never a crash.
TEST_F(WrongState, no_number_of_results_or_files_ends_the_program_otherwise_than_by_words) {
  run(small);
  const fs::path whole = folder_ / "whole.platen", kept = folder_ / "kept";
  fs::copy(checkpoint_, whole);
  fs::copy(folder_ / "run", kept, fs::copy_options::recursive);
  const CheckpointReader good(whole);
  int blocks = 0, tried = 0;
  constexpr int one_of = 8; // a resume takes a second
  for (const std::string &name : good.names()) {
    const StoredBlock block = *good.find(name);
    if (name.rfind("test/", 0) == 0 || block.type.kind == BlockType::Kind::text || block.rows == 0) continue;
    if (++blocks % one_of != 0) continue;
    const double value = ++tried % 2 == 0 ? 1e300 : std::nan("");
    fs::remove_all(folder_ / "run"); // which an earlier one may have led on
    fs::copy(kept, folder_ / "run", fs::copy_options::recursive);
    put_number({name, block.rows / 2 * block.type.numbers, value, ""}, whole);
    const Outcome outcome = resumed();
    EXPECT_TRUE(outcome.status >= 0 && outcome.status <= 4)
        << name << " = " << value << ": " << outcome.status;
    EXPECT_TRUE(outcome.status != 2 || contains(outcome.error, checkpoint_.filename().string()))
        << name << " = " << value << ": " << outcome.error;
  }
  EXPECT_GT(tried, 15);
}

} // namespace
} // namespace platen::apps::testing
