// A test that stopped short of what it was made for is led further from where it ended, as if it had been
// asked so from the start; what would change its physics is refused by name. Checkpoints whose checksums hold
// and whose numbers cannot be are refused before anything is written, with the file, the block, the row, the
// value and what is allowed.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "apps/crushed.h"
#include "apps/output/checkpoint_folder.h"

namespace platen::apps::testing {
namespace {

class LedOn : public Crushed {
protected:
  LedOn() : Crushed("crushed.prm", Frames::as_in_the_scene) {}
};

// Without frames, for each part ends with one.
Words to(const std::string &strain, const Words &more = {}) {
  return with({"Output/Fields = off", "Loading/Target strain = " + strain}, more);
}

// Twice: to the peak, and past it.
TEST_F(LedOn, a_larger_strain_gives_the_straight_test_to_the_last_byte) {
  EXPECT_EQ(crush("straight", to("0.0065"), {"-t", "2"})["peak_reached"], true);
  crush("led", to("0.0012"), {"-t", "1"});
  EXPECT_TRUE(contains(
      outcome_.out, "it goes on from here with: platen-compress " + scene_ +
                        " -o led -s 'Output/Fields = off' --resume -s 'Loading/Target strain = 0.0024'\n"));
  const nlohmann::json first = summary_in(folder_ / "led");
  EXPECT_EQ(first["peak_reached"], false);
  EXPECT_EQ(first["ended_by"], "target");
  crush("led", to("0.004"), {"-t", "2", "--resume"});
  crush("led", to("0.0065"), {"-t", "1", "--resume"});
  expect_same("straight", "led");
  EXPECT_TRUE(contains(log("led"), "led on with another Loading/Target strain: 0.004, it was 0.0012"));
  EXPECT_TRUE(contains(log("led"), "led on with another Loading/Target strain: 0.0065, it was 0.004"));
}

// Whatever the folder and the title are called: nothing of them is for the shell.
TEST_F(LedOn, a_printed_command_can_be_pasted_into_a_shell) {
  for (const std::string results : {"a b", "$(touch x)", "it's"}) {
    crush(results, to("0.0008", {"Scene/Title = it's $HOME"}), {"-t", "1"});
    const std::string before = "it goes on from here with: platen-compress";
    const std::size_t at = outcome_.out.find(before);
    ASSERT_NE(at, std::string::npos) << outcome_.out << outcome_.error;
    const std::size_t first = at + before.size();
    const std::string pasted = outcome_.out.substr(first, outcome_.out.find('\n', first) - first);
    Program shell({"/bin/sh", "-c", compress_command({}).front() + pasted}, folder_);
    EXPECT_EQ(shell.wait(), 0) << pasted;
    const nlohmann::json summary = summary_in(folder_ / results);
    EXPECT_EQ(summary["scene"], "it's $HOME");
    EXPECT_GT(column(results, "axial_strain_platen").back(), 0.0015) << pasted;
    EXPECT_FALSE(fs::exists(folder_ / "x")) << pasted;
  }
}

// Where the stress has fallen to a share of the peak the test is over; from there to a smaller one.
TEST_F(LedOn, another_residual_gives_the_straight_test_to_the_last_byte) {
  const auto fallen_to = [](const std::string &residual) {
    return Words{"Output/Fields = off", "Loading/Stop at residual = " + residual};
  };
  EXPECT_EQ(crush("straight", fallen_to("0.3"))["ended_by"], "stop at residual");
  EXPECT_EQ(crush("led", fallen_to("0.7"))["ended_by"], "stop at residual");
  const long rows = lines_in(folder_ / "led/history.csv");
  crush("led", fallen_to("0.3"), {"--resume"});
  EXPECT_GT(lines_in(folder_ / "led/history.csv"), rows + 5);
  expect_same("straight", "led");
}

// The cell holds its pressure in between, the sleeve its shape, the servo its speed, and turns of the platens
// count once; and so elastic platens, seats and a machine.
TEST_F(LedOn, tests_of_every_kind_are_led_on_as_they_were) {
  const Words cell{"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa",
                   "Sleeve/Thickness = 1 mm", "Loading/Pressure path = 0.1"};
  const Words turns{"Loading/Unload at = 4e-4", "Platens/Machine stiffness = 20 kN/mm",
                    "Platens/Kind = deformable", "Platens/Top/Seat = spherical"};
  const Words pulled{"Loading/Test = tension", "Platens/Attachment = glued"};
  for (const Words &kind : {cell, turns, pulled}) {
    crush("straight", to("0.0012", kind), {"--overwrite"});
    crush("led", to("0.0007", kind), {"--overwrite"});
    crush("led", to("0.0012", kind), {"--resume"});
    SCOPED_TRACE(kind[0]);
    expect_same("straight", "led");
  }
}

// What is written how often changes no state: rows are those of the straight tests, and scene.prm is the
// scene now. A run that was led on and stopped before its next checkpoint goes on to the new end.
TEST_F(LedOn, output_title_and_expectations_may_change) {
  const Words changed{"Loading/Target strain = 0.003", "Scene/Title = Led on",
                      "Scene/Standard = ASTM C39",     "Output/Every = 40",
                      "Output/Fields every = 800",     "Checkpoint/Every = 0",
                      "Expect/particles = 1 ... 2"};
  crush("first", {"Loading/Target strain = 0.002"});
  fs::copy(folder_ / "first", folder_ / "led", fs::copy_options::recursive);
  crush("straight", changed, {}, 1); // there are more than two spheres
  const auto strains = [&](const char *name) { return column(name, "axial_strain_platen"); };
  const std::vector<double> first = strains("first"), straight = strains("straight");
  for (const char *time :
       {"once", "again"}) { // the second time from the same checkpoint: no other is written
    SCOPED_TRACE(time);
    crush("led", changed, {"--resume"}, 1);
    const std::vector<double> led = strains("led");
    ASSERT_GT(led.size(), first.size() + 5);
    EXPECT_TRUE(std::equal(first.begin(), first.end(), led.begin()));
    EXPECT_TRUE(std::equal(led.begin() + static_cast<long>(first.size()), led.end(),
                           straight.end() - static_cast<long>(led.size() - first.size())));
    EXPECT_EQ(summary_in(folder_ / "led")["scene"], "Led on");
    EXPECT_EQ(summary_in(folder_ / "led")["standard"], "ASTM C39");
    EXPECT_EQ(summary_in(folder_ / "led")["steps"], summary_in(folder_ / "straight")["steps"]);
  }
  EXPECT_EQ(content_of(folder_ / "led/scene.prm"), content_of(folder_ / "straight/scene.prm"));
  for (const char *word : {"Scene/Title: Led on, it was Small cylinder", "Output/Every: 40, it was 20",
                           "Expect/particles: 1 ... 2, it was none"})
    EXPECT_TRUE(contains(log("led"), word));
}

TEST_F(LedOn, what_would_change_the_physics_is_refused_by_name) {
  crush("led", {"Loading/Target strain = 0.002", "Loading/Unload at = 0.001"});
  const auto before = results_in(folder_ / "led");
  const std::string said = log("led");
  const auto refused = [&](const std::string &entry, const std::string &says) {
    Words entries{"Loading/Target strain = 0.003", "Loading/Unload at = 0.001"};
    if (entry.find("Target strain") != std::string::npos)
      entries[0] = entry;
    else if (entry.find("Unload") != std::string::npos)
      entries[1] = entry;
    else
      entries.push_back(entry);
    const Outcome outcome = run_compress(arguments("led", entries, {"--resume", "--quiet"}), folder_);
    EXPECT_EQ(outcome.status, 2) << entry;
    EXPECT_TRUE(contains(outcome.error, "error: " + entry + " was " + says));
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(difference(before, results_in(folder_ / "led")), "") << entry;
    EXPECT_EQ(log("led"), said) << entry;
  };
  refused("Loading/Target strain = 0.0015",
          "0.002 when the run began that is to be resumed. Allowed: that or more");
  refused("Bond/Tensile strength = 9 MPa", "9.5 MPa when");
  refused("Loading/Axial rate = 0.2 m/s", "0.3 m/s when");
  refused("Loading/Unload at = 0.0012", "0.001 when");
  refused("Platens/Friction static = 0.2", "0.3 when");
  refused("Output/Sound share = 0.4", "0.7 when");
  refused("Output/Fields = off", "on when");
  refused("Scene/Seed = 4", "3 when");
  // The same strain in other words is no other.
  crush("led", {"Loading/Target strain = 0.2 %", "Loading/Unload at = 0.001"}, {"--resume"});
}

// Where no checkpoints are wanted none is kept, and there is nothing to lead on from.
TEST_F(LedOn, without_checkpoints_none_is_kept_at_the_end) {
  crush("led", {"Loading/Target strain = 0.001", "Checkpoint/Every = 0"});
  EXPECT_FALSE(fs::exists(folder_ / "led/checkpoint"));
  crush("led", {"Loading/Target strain = 0.002", "Checkpoint/Every = 0"}, {"--resume"}, 2);
}

struct Number {
  std::string block;
  std::size_t place; // of the block's numbers
  double value;
  std::string allowed; // as the message has it
};

class WrongState : public Crushed {
protected:
  // What has one checkpoint.
  void SetUp() override {
    crush("run", small_);
    checkpoint_ = newest_whole_checkpoint(folder_ / "run" / "checkpoint").path;
    for (const auto &file : fs::directory_iterator(checkpoint_.parent_path()))
      if (file.path() != checkpoint_) fs::remove(file.path());
    fs::copy(checkpoint_, whole_);
  }
  // The checkpoint with one number in place of another, and checksums that hold.
  void put_number(const Number &number) const {
    const CheckpointReader from(whole_);
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
  Outcome resumed() const { return run_compress(arguments("run", small_, {"--resume", "--quiet"}), folder_); }

  const Words small_{"Specimen/Sphere radius = 1.7 mm", "Checkpoint/Every = 100",
                     "Loading/Target strain = 0.003"};
  fs::path checkpoint_;
  const fs::path whole_ = folder_ / "whole.platen";
};

TEST_F(WrongState, a_number_that_cannot_be_is_status_two_with_its_place_and_nothing_is_written) {
  const auto results = results_in(folder_ / "run");
  const CheckpointReader good(whole_);
  const std::size_t spheres = good.find("test/specimen/particles/mass")->rows,
                    bonds = good.find("test/specimen/bonds/records/state")->rows;
  const std::string row = "0 ... " + std::to_string(spheres - 1);
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
    put_number(number);
    const Outcome outcome = resumed();
    EXPECT_EQ(outcome.status, 2) << number.block << ": " << outcome.error;
    const std::size_t numbers = good.find(number.block)->type.numbers;
    for (const std::string &part :
         {checkpoint_.filename().string(), "\"" + number.block + "\"",
          "row " + std::to_string(number.place / numbers) + ": ", std::string("Allowed: "), number.allowed})
      EXPECT_TRUE(contains(outcome.error, part)) << number.block;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(difference(results, results_in(folder_ / "run")), "") << number.block;
  }
  put_number({}); // written by the same hand, with nothing changed
  const Outcome outcome = resumed();
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  EXPECT_EQ(difference(results, results_in(folder_ / "run")), "");
}

// What the program keeps beside the test: a number that it only tells may be any, and is never a crash.
TEST_F(WrongState, no_number_of_results_or_files_ends_the_program_otherwise_than_by_words) {
  const fs::path kept = folder_ / "kept";
  fs::copy(folder_ / "run", kept, fs::copy_options::recursive);
  const CheckpointReader good(whole_);
  int blocks = 0, tried = 0;
  constexpr int one_of = 8; // a resume takes a second
  for (const std::string &name : good.names()) {
    const StoredBlock block = *good.find(name);
    if (name.rfind("test/", 0) == 0 || block.type.kind == BlockType::Kind::text || block.rows == 0) continue;
    if (++blocks % one_of != 0) continue;
    const double value = ++tried % 2 == 0 ? 1e300 : std::nan("");
    fs::remove_all(folder_ / "run"); // which an earlier one may have led on
    fs::copy(kept, folder_ / "run", fs::copy_options::recursive);
    put_number({name, block.rows / 2 * block.type.numbers, value, ""});
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
