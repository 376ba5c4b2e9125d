// How platen-compress ends: an expected figure that does not come out, a stop before the peak, numerics and
// files that fail under way.
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "apps/crushed.h"
#include "measured.h"

namespace platen::apps::testing {
namespace {

class Endings : public Crushed {
protected:
  Endings() : Crushed("crushed.prm", Frames::as_in_the_scene) {}
};

TEST_F(Endings, an_expected_number_that_does_not_come_out_is_status_one) {
  scene("expect.prm",
        "subsection Loading\n  set Target strain = 0.0005\nend\n"
        "subsection Output\n  set Fields = off\nend\n"
        "subsection Expect\n  set particles = 1100 ... 1200\n  set energy_residual_relative = 1 ... 2\n"
        "  set poisson_ratio = 0.05 ... 0.3\nend\n");
  const Outcome outcome = run_compress({"expect.prm", "-o", "results"}, folder_);
  EXPECT_EQ(outcome.status, 1) << outcome.error;
  const std::string told = outcome.out + outcome.error;
  EXPECT_TRUE(contains(told, "expect.prm:10: energy_residual_relative = "));
  EXPECT_TRUE(contains(told, "is not in 1 ... 2"));
  EXPECT_FALSE(contains(told, "expect.prm:9:"));
  EXPECT_FALSE(contains(told, "expect.prm:11:"));
  const nlohmann::json summary = summary_in(folder_ / "results");
  EXPECT_EQ(summary["status"], "done");
  ASSERT_EQ(summary["expectations"].size(), 3u);
  for (const auto &one : summary["expectations"]) {
    EXPECT_EQ(one["met"], one["entry"] != "Expect/energy_residual_relative") << one;
    EXPECT_TRUE(one["value"].is_number()) << one;
  }
}

// Before the peak nobody knows how slow the way to it is, nor whether the figures come out as expected.
TEST_F(Endings, a_run_that_is_stopped_before_its_peak_is_not_judged) {
  scene("expect.prm", "subsection Expect\n  set strength_pa = 1 Pa ... 2 Pa\nend\n");
  Program program(compress_command({"expect.prm", "-o", "results", "-t", "1"}), folder_);
  ASSERT_TRUE(program.wait_until([&] { return lines_in(folder_ / "results/history.csv") >= 12; }));
  program.send(SIGINT);
  ASSERT_EQ(program.wait(), 130);
  const nlohmann::json s = summary_in(folder_ / "results");
  ASSERT_EQ(s["status"], "stopped");
  ASSERT_EQ(s["peak_reached"], false);
  EXPECT_EQ(s["quasi_static"], nullptr);
  EXPECT_TRUE(s["signs_of_haste"].empty()) << s["signs_of_haste"];
  EXPECT_FALSE(contains(log("results"), "too fast"));
  EXPECT_FALSE(contains(log("results"), "crossings to the peak"));
  ASSERT_EQ(s["expectations"].size(), 1u);
  EXPECT_EQ(s["expectations"][0]["met"], nullptr);
  EXPECT_EQ(s["expectations"][0]["reason"], "the test has not come to its end");
  // The whole run is: it was too fast (45 wave crossings of 60).
  const Outcome rest = run_compress({"expect.prm", "-o", "results", "--resume"}, folder_);
  EXPECT_EQ(rest.status, 1) << rest.error;
  const nlohmann::json whole = summary_in(folder_ / "results");
  EXPECT_EQ(whole["quasi_static"], false);
  EXPECT_TRUE(contains(log("results"), "wave crossings to the peak, 60 at least"));
  EXPECT_EQ(whole["expectations"][0]["met"], false);
}

// Who reads the page is to know what was run: not what the scene file says of it.
TEST_F(Endings, what_was_overridden_is_in_the_summary_with_what_the_scene_file_has) {
  scene("case.prm", "subsection Expect\n  set particles = 1 ...\nend\n");
  ASSERT_EQ(run_compress({"case.prm", "-o", "results", "--quiet", "-s", "Loading/Target strain = 0.0002",
                          "-s", "Contact/Friction = 0.5", "-s", "Output/Fields = off"},
                         folder_)
                .status,
            0);
  const nlohmann::json s = summary_in(folder_ / "results");
  EXPECT_EQ(s["scene_file"], "case.prm");
  const nlohmann::json changed = {
      {{"entry", "Loading/Target strain"}, {"value", "0.0002"}, {"in_scene_file", "0.008"}},
      {{"entry", "Output/Fields"}, {"value", "off"}, {"in_scene_file", "on"}}};
  EXPECT_EQ(s["overridden"], changed); // not the friction, which the file has too
  EXPECT_NEAR(s["mean_radius_m"].get<double>(), 0.85e-3, 0.1e-3);
}

// Narrow faces of a thin sleeve are driven into the gaps between spheres.
TEST_F(Endings, a_sleeve_that_would_turn_inside_out_stops_the_run) {
  const Words thin{"Loading/Confinement = sleeve",    "Loading/Confining pressure = 40 MPa",
                   "Loading/Confining ramp = 0.1 ms", "Sleeve/Thickness = 1 mm",
                   "Sleeve/Elements around = 90",     "Sleeve/Seat depth = 0",
                   "Sleeve/Poisson ratio = 0.45",     "Checkpoint/Every = 100"};
  EXPECT_EQ(crush("turned", thin, {"--quiet"}, 3)["status"], "failed");
  const Outcome outcome = outcome_;
  for (const char *part :
       {"the sleeve would turn inside out", "cell ", "volume ratio", "Sleeve/Elements around"})
    EXPECT_TRUE(contains(outcome.error, part));
  EXPECT_FALSE(fs::is_empty(folder_ / "turned/checkpoint")); // the last one is kept
  // ... and whole: the run goes on from it to the same step and the same end.
  crush("turned", thin, {"--quiet", "--resume"}, 3);
  EXPECT_EQ(outcome_.error, outcome.error);
  measured::note_figure(28, "exit_status", outcome.status, "3");
}

// Contacts by Hertz' law grow stiffer as they close, and a step that is given stays.
TEST_F(Endings, numerics_that_stop_are_status_three) {
  const nlohmann::json s =
      crush("results",
            {"Effects/Contact = hertz", "Material/Young modulus = 100 GPa", "Integration/Time step = 0.1 us",
             "Checkpoint/Every = 0", "Output/Fields = off"},
            {}, 3);
  for (const char *part : {"the time step of 1e-07 s is above the stability limit of ", " at ",
                           "try a smaller Integration/Time step", "no checkpoint had been written"})
    EXPECT_TRUE(contains(outcome_.error, part));
  EXPECT_EQ(s["status"], "failed");
}

TEST_F(Endings, a_disk_that_fills_is_status_four_and_loses_nothing) {
  const auto kept = [&] { return fs::exists(folder_ / "results/checkpoint/step_000000000500.platen"); };
  Program program(command("results", {}), folder_);
  ASSERT_TRUE(program.wait_until(kept));
  // No file may grow beyond what it has: what a full disk does, but to this process alone.
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = 1024;
  ASSERT_EQ(prlimit(program.id(), RLIMIT_FSIZE, &limit, nullptr), 0);
  EXPECT_EQ(program.wait(), 4);
  EXPECT_TRUE(contains(content_of(folder_ / "error.txt"), "results/"));
  crush("results", {}, {"--resume"});
  expect_same(crushed_once(), "results");
}

// On two threads they are written beside the computation: what fails there ends the run all the same.
TEST_F(Endings, frames_that_cannot_be_written_are_status_four_on_one_thread_and_two) {
  for (const char *threads : {"1", "2"}) {
    const fs::path results = folder_ / threads, frames = results / "frames";
    Program program(
        command(threads, {"Output/Fields every = 100", "Checkpoint/Every = 0"}, {"-t", threads, "--quiet"}),
        folder_);
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(results / "contacts.pvd"); }));
    fs::rename(frames, results / "taken away");
    EXPECT_EQ(program.wait(), 4) << threads << " threads";
    const std::string error = content_of(folder_ / "error.txt");
    EXPECT_TRUE(contains(error, "frames/") && contains(error, "cannot be")) << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  }
}

// A frame that is still being written when a checkpoint is due, for the file under its name is a pipe that
// nobody reads: a run resumed from there would miss it.
TEST_F(Endings, a_checkpoint_waits_for_the_frames_before_it) {
  const Words run =
      command("results", {"Output/Fields every = 2000", "Checkpoint/Every = 2100"}, {"-t", "2"});
  const fs::path results = folder_ / "results", checkpoint = results / "checkpoint/step_000000002100.platen";
  {
    Program program(run, folder_);
    ASSERT_TRUE(program.wait_until([&] { return fs::exists(checkpoint); })) << "without a pipe";
    program.wait();
  }
  fs::remove_all(results);
  Program program(run, folder_);
  ASSERT_TRUE(program.wait_until([&] { return fs::exists(results / "frames"); }));
  ASSERT_EQ(mkfifo((results / "frames/specimen_000001.part.vtu").c_str(), 0600), 0);
  const auto rows = [&] { return content_of(results / "history.csv").size(); };
  // Until it stands still.
  for (std::size_t before = 0, now = rows(); now != before; now = rows()) {
    before = now;
    std::this_thread::sleep_for(std::chrono::seconds(1));
  }
  EXPECT_FALSE(fs::exists(checkpoint));
  EXPECT_FALSE(fs::exists(results / "frames/specimen_000001.vtu"));
}

} // namespace
} // namespace platen::apps::testing
