// A test that stopped short of what it was made for is led further from where it ended, as if it had been
// asked so from the start; what would change its physics is refused by name.
#include <gtest/gtest.h>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

using Words = std::vector<std::string>;

class LedOn : public ScratchFolder {
protected:
  Outcome run(const std::string &name, const Words &entries, const Words &options = {}) {
    Words arguments{scene_, "-o", name, "--quiet"};
    for (const std::string &entry : entries)
      arguments.insert(arguments.end(), {"-s", entry});
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_compress(arguments, folder_);
  }
  void done(const std::string &name, const Words &entries, const Words &options = {}) {
    const Outcome outcome = run(name, entries, options);
    ASSERT_EQ(outcome.status, 0) << name << ": " << outcome.error;
  }
  std::string log(const std::string &name) const { return content_of(folder_ / name / "run.log"); }
  // Files and figures of a run that was led on are those of the straight one.
  void expect_same(const std::string &straight, const std::string &led) const {
    EXPECT_EQ(difference(results_in(folder_ / straight), results_in(folder_ / led)), "");
    const auto figures = [&](const std::string &name) {
      nlohmann::json summary = summary_in(folder_ / name);
      for (const char *cost : {"threads", "wall_seconds", "setup_seconds", "particle_steps_per_second",
                               "stage_seconds", "peak_memory_bytes", "bytes_in_columns_and_search"})
        summary.erase(cost);
      return summary;
    };
    EXPECT_EQ(figures(straight), figures(led));
  }

  const std::string scene_ = test_scene("crushed.prm");
};

Words with(Words entries, const std::string &one) {
  entries.push_back(one);
  return entries;
}

// Twice: to the peak, and past it. Frames apart, for each part ends with
// one.
TEST_F(LedOn, a_larger_strain_gives_the_straight_test_to_the_last_byte) {
  const Words plain{"Output/Fields = off"};
  const auto to = [&](const char *strain) {
    return with(plain, std::string("Loading/Target strain = ") + strain);
  };
  done("straight", to("0.0065"), {"-t", "2"});
  EXPECT_EQ(summary_in(folder_ / "straight")["peak_reached"], true);
  const Outcome ended = run_compress(
      {scene_, "-o", "led", "-t", "1", "-s", "Output/Fields = off", "-s", "Loading/Target strain = 0.0012"},
      folder_);
  EXPECT_EQ(ended.status, 0) << ended.error;
  EXPECT_NE(ended.out.find("it goes on from here with: platen-compress " + scene_ +
                           " -o led -s 'Output/Fields = off' --resume -s 'Loading/Target strain = 0.0024'\n"),
            std::string::npos)
      << ended.out;
  const nlohmann::json first = summary_in(folder_ / "led");
  EXPECT_EQ(first["peak_reached"], false);
  EXPECT_EQ(first["ended_by"], "target");
  done("led", to("0.004"), {"-t", "2", "--resume"});
  done("led", to("0.0065"), {"-t", "1", "--resume"});
  expect_same("straight", "led");
  EXPECT_NE(log("led").find("led on with another Loading/Target strain: 0.004, it was 0.0012"),
            std::string::npos)
      << log("led");
  EXPECT_NE(log("led").find("led on with another Loading/Target strain: 0.0065, it was 0.004"),
            std::string::npos);
}

// Whatever the folder and the title are called: nothing of them is for the shell.
TEST_F(LedOn, a_printed_command_can_be_pasted_into_a_shell) {
  for (const std::string results : {"a b", "$(touch x)", "it's"}) {
    const Outcome ended = run_compress({scene_, "-o", results, "-t", "1", "-s", "Output/Fields = off", "-s",
                                        "Scene/Title = it's $HOME", "-s", "Loading/Target strain = 0.0008"},
                                       folder_);
    const std::string before = "it goes on from here with: platen-compress";
    const std::size_t at = ended.out.find(before);
    ASSERT_NE(at, std::string::npos) << ended.out << ended.error;
    const std::size_t first = at + before.size();
    const std::string pasted = ended.out.substr(first, ended.out.find('\n', first) - first);
    Program shell({"/bin/sh", "-c", compress_command({}).front() + pasted}, folder_);
    EXPECT_EQ(shell.wait(), 0) << pasted;
    const nlohmann::json summary = summary_in(folder_ / results);
    EXPECT_EQ(summary["scene"], "it's $HOME");
    EXPECT_GT(column_of(folder_ / results / "history.csv", "axial_strain_platen").back(), 0.0015) << pasted;
    EXPECT_FALSE(fs::exists(folder_ / "x")) << pasted;
  }
}

// Where the stress has fallen to a share of the peak the test is over; from there to a smaller one.
TEST_F(LedOn, another_residual_gives_the_straight_test_to_the_last_byte) {
  const Words plain{"Output/Fields = off"};
  done("straight", with(plain, "Loading/Stop at residual = 0.3"));
  EXPECT_EQ(summary_in(folder_ / "straight")["ended_by"], "stop at residual");
  done("led", with(plain, "Loading/Stop at residual = 0.7"));
  const long rows = lines_in(folder_ / "led/history.csv");
  EXPECT_EQ(summary_in(folder_ / "led")["ended_by"], "stop at residual");
  done("led", with(plain, "Loading/Stop at residual = 0.3"), {"--resume"});
  EXPECT_GT(lines_in(folder_ / "led/history.csv"), rows + 5);
  expect_same("straight", "led");
}

// The cell holds its pressure in between, the sleeve its shape, the servo its speed, and turns of the platens
// count once; and so elastic platens, seats and a machine.
TEST_F(LedOn, tests_of_every_kind_are_led_on_as_they_were) {
  const Words cell{"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa",
                   "Sleeve/Thickness = 1 mm", "Loading/Pressure path = 0.1"};
  const Words turns{"Loading/Unload at = 4e-4", "Platens/Machine stiffness = 20 kN/mm"};
  const Words elastic{"Platens/Kind = deformable", "Platens/Top/Seat = spherical"};
  const Words pulled{"Loading/Test = tension", "Platens/Attachment = glued"};
  for (const Words &kind : {cell, turns, elastic, pulled}) {
    const auto to = [&](const char *strain) {
      return with(with(kind, "Output/Fields = off"), std::string("Loading/Target strain = ") + strain);
    };
    done("straight", to("0.0012"), {"--overwrite"});
    done("led", to("0.0007"), {"--overwrite"});
    done("led", to("0.0012"), {"--resume"});
    SCOPED_TRACE(kind[0]);
    expect_same("straight", "led");
  }
}

// What is written how often changes no state: rows are those of the straight tests, and scene.prm is the
// scene now. A run that was led on and stopped before its next checkpoint goes on to the new end.
TEST_F(LedOn, output_title_and_expectations_may_change) {
  const Words changed{"Loading/Target strain = 0.003", "Scene/Title = Led on", "Output/Every = 40",
                      "Output/Fields every = 800",     "Checkpoint/Every = 0", "Expect/particles = 1 ... 2"};
  done("first", {"Loading/Target strain = 0.002"});
  fs::copy(folder_ / "first", folder_ / "led", fs::copy_options::recursive);
  EXPECT_EQ(run("straight", changed).status, 1) << "there are more";
  const auto strains = [&](const char *name) {
    return column_of(folder_ / name / "history.csv", "axial_strain_platen");
  };
  const std::vector<double> first = strains("first"), straight = strains("straight");
  for (const char *time :
       {"once", "again"}) { // the second time from the same checkpoint: no other is written
    EXPECT_EQ(run("led", changed, {"--resume"}).status, 1) << time;
    const std::vector<double> led = strains("led");
    ASSERT_GT(led.size(), first.size() + 5) << time;
    EXPECT_TRUE(std::equal(first.begin(), first.end(), led.begin())) << time;
    EXPECT_TRUE(std::equal(led.begin() + static_cast<long>(first.size()), led.end(),
                           straight.end() - static_cast<long>(led.size() - first.size())))
        << time;
    EXPECT_EQ(summary_in(folder_ / "led")["scene"], "Led on");
    EXPECT_EQ(summary_in(folder_ / "led")["steps"], summary_in(folder_ / "straight")["steps"]);
  }
  EXPECT_EQ(content_of(folder_ / "led/scene.prm"), content_of(folder_ / "straight/scene.prm"));
  for (const char *word : {"Scene/Title: Led on, it was Small cylinder", "Output/Every: 40, it was 20",
                           "Expect/particles: 1 ... 2, it was none"})
    EXPECT_NE(log("led").find(word), std::string::npos) << word;
}

TEST_F(LedOn, what_would_change_the_physics_is_refused_by_name) {
  done("led", {"Loading/Target strain = 0.002", "Loading/Unload at = 0.001"});
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
    const Outcome outcome = run("led", entries, {"--resume"});
    EXPECT_EQ(outcome.status, 2) << entry;
    EXPECT_NE(outcome.error.find("error: " + entry + " was " + says), std::string::npos) << outcome.error;
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
  const Outcome same =
      run("led", {"Loading/Target strain = 0.2 %", "Loading/Unload at = 0.001"}, {"--resume"});
  EXPECT_EQ(same.status, 0) << same.error;
}

// Where no checkpoints are wanted none is kept, and there is nothing to lead on from.
TEST_F(LedOn, without_checkpoints_none_is_kept_at_the_end) {
  done("led", {"Loading/Target strain = 0.001", "Checkpoint/Every = 0"});
  EXPECT_FALSE(fs::exists(folder_ / "led/checkpoint"));
  EXPECT_EQ(run("led", {"Loading/Target strain = 0.002", "Checkpoint/Every = 0"}, {"--resume"}).status, 2);
}

} // namespace
} // namespace platen::apps::testing
