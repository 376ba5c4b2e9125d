// A run is its scene: neither threads nor stops nor crashes of the machine change a byte of what it finds.
#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Determinism : public Crushed {
protected:
  Determinism() : Crushed("crushed.prm", Frames::as_in_the_scene) {}
};

TEST_F(Determinism, threads_change_no_byte) {
  // Packed closely: the packing has to repeat too, and more spheres touch.
  const Words close{"Specimen/Packing = random close"};
  const nlohmann::json one = crush("one", close, {"-t", "1"});
  // A run that is worth repeating: more than one block of rows in every loop, failure of both kinds, grains
  // that touch again, frames.
  EXPECT_GT(one["particles"], 1024);
  EXPECT_GT(one["broken_tension"], 500);
  EXPECT_GT(one["broken_shear"], 50);
  EXPECT_GT(column("one", "grain_contacts").back(), 20);
  EXPECT_GT(lines_in(folder_ / "one/specimen.pvd"), 8);
  for (const char *threads : {"2", "4"}) {
    SCOPED_TRACE(threads);
    crush(threads, close, {"-t", threads});
    expect_same("one", threads);
  }
}

// The C library is told to take the code of an older processor: with Weibull's strengths, Hertz's contacts
// and restitution, friction that falls with speed, a tilted platen that turns, a rough end and a sleeve (of
// 20 faces around, of whose corners one has another last bit in either code).
TEST_F(Determinism, the_baseline_gives_the_same_bytes_on_an_older_processor) {
  const std::pair<const char *, Words> runs[] = {
      {"scatter",
       {"Bond/Strength scatter = weibull", "Bond/Weibull modulus = 6", "Effects/Contact = hertz",
        "Material/Young modulus = 40 GPa", "Material/Poisson ratio = 0.2", "Contact/Restitution = 0.6",
        "Bond/Friction angle = 33.3 degree", "Platens/Friction law = velocity weakening",
        "Platens/Slip velocity = 0.05 m/s", "Platens/Top/Seat = spherical", "Platens/Top/Tilt = 0.03 degree",
        "Specimen/Ends = rough", "Specimen/End height = 0.01 mm"}},
      {"sleeve",
       {"Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
        "Loading/Confining ramp = 0.1 ms", "Loading/Target strain = 0.004", "Sleeve/Thickness = 1 mm",
        "Sleeve/Elements around = 20"}},
      {"tube",
       {"Loading/Confinement = sleeve", "Sleeve/Kind = tube", "Sleeve/Steel = S235",
        "Sleeve/Yield strength = 40 MPa", "Sleeve/Saturation = 20 MPa", "Sleeve/Saturation rate = 50",
        "Loading/Target strain = 0.004", "Sleeve/Thickness = 0.5 mm"}},
      {"wrap",
       {"Loading/Confinement = sleeve", "Sleeve/Kind = wrap", "Sleeve/Modulus = 70 GPa",
        "Sleeve/Rupture strain = 0.0005", "Loading/Target strain = 0.004", "Sleeve/Thickness = 0.1 mm",
        "Sleeve/Overlap = 5 mm"}},
      {"elastic",
       {"Platens/Kind = deformable", "Platens/Motion = explicit", "Loading/Target strain = 0.004"}}};
  for (const auto &[name, entries] : runs) {
    const Words baseline = with({"Integration/Instruction set = baseline"}, entries);
    const std::string here = name, older = here + " older";
    const nlohmann::json found = crush(here, baseline);
    ASSERT_EQ(setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2", 1), 0);
    crush(older, baseline);
    unsetenv("GLIBC_TUNABLES");
    EXPECT_GT(found["broken_tension"], 300) << name;
    EXPECT_EQ(found["instruction_set"], "baseline");
    for (const char *file : {"history.csv", "cracks.csv"})
      EXPECT_EQ(content_of(folder_ / here / file), content_of(folder_ / older / file)) << name;
  }
}

TEST_F(Determinism, elastic_platens_show_their_stress) {
  for (const std::string motion : {"explicit", "quasi-static"}) {
    crush(motion,
          {"Platens/Kind = deformable", "Platens/Motion = " + motion, "Loading/Target strain = 0.003"});
    EXPECT_TRUE(contains(content_of(folder_ / motion / "frames/platens_000002.vtu"), "von_mises"));
  }
}

// First row as packed, second where it begins.
TEST_F(Determinism, a_run_begun_statically_is_at_rest_at_its_strain) {
  crush("begun", {"Loading/Start strain = 4e-4", "Loading/Target strain = 6e-4"});
  const auto rows = [&](const char *name) { return column("begun", name); };
  EXPECT_EQ(rows("axial_strain_platen")[0], 0);
  EXPECT_EQ(rows("axial_stress_top_pa")[0], 0);
  EXPECT_NEAR(rows("axial_strain_platen")[1], 4e-4, 1e-12);
  EXPECT_EQ(rows("time_s")[1], 0);
  EXPECT_EQ(rows("kinetic_energy_j")[1], 0);
  EXPECT_GT(rows("axial_stress_top_pa")[1], 1e6);
  EXPECT_LT(std::abs(rows("energy_residual_j")[1]), 0.01 * rows("bond_energy_j")[1]);
}

// Each is refused with nothing changed, and the run goes on once the file is what it was; rows after the
// checkpoint count for nothing.
TEST_F(Determinism, a_file_that_was_edited_or_lost_since_the_checkpoint_is_refused_by_name) {
  put(folder_ / "aggregate.txt", "1\n2\n3\n");
  const Words phases{"Phases/By = file", "Phases/File = " + (folder_ / "aggregate.txt").string()};
  crush("whole", phases);
  EXPECT_EQ(stop_at("stopped", 150, SIGTERM, phases), 143);
  const auto again = [&] { return run_compress(arguments("stopped", phases, {"--resume"}), folder_); };
  const auto refused = [&](const fs::path &file, const std::string &content, const std::string &said) {
    const std::string whole = content_of(file), before = log("stopped");
    content == "gone" ? static_cast<void>(fs::remove(file)) : put(file, content);
    const Outcome outcome = again();
    EXPECT_EQ(outcome.status, 2) << said;
    EXPECT_TRUE(contains(outcome.error, said));
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(log("stopped"), before); // nothing was written
    if (content != "gone") {
      EXPECT_EQ(content_of(file), content);
    }
    put(file, whole);
  };
  const auto edited = [](std::string text, std::size_t at) {
    text[at] = text[at] == '1' ? '2' : '1';
    return text;
  };
  for (const char *name : {"history.csv", "cracks.csv"}) {
    const fs::path file = folder_ / "stopped" / name;
    const std::string whole = content_of(file);
    ASSERT_GT(whole.size(), 300u) << name;
    const std::string error = std::string(name) + ": error: ";
    refused(file, "gone", error + "is missing or cannot be read; put the file back");
    refused(file, whole.substr(0, whole.size() - 1), error + "has ");
    refused(file, edited(whole, 0), error + "its header line is not that of this run");
    refused(file, whole.substr(0, whole.size() - 1) + "0", error + "no row ends at byte ");
  }
  const fs::path specimen = folder_ / "stopped/specimen.csv";
  refused(specimen, "gone", "specimen.csv: error: is missing or has been changed");
  refused(specimen, edited(content_of(specimen), 200), "specimen.csv: error: is missing or has been changed");
  refused(folder_ / "aggregate.txt", "1\n2\n4\n", "Phases/File = ");
  std::ofstream(folder_ / "stopped/history.csv", std::ios::app) << "0.25,torn";
  std::ofstream(folder_ / "stopped/cracks.csv", std::ios::app) << "0.25,torn\n";
  const Outcome last = again();
  EXPECT_EQ(last.status, 0) << last.error;
  expect_same("whole", "stopped");
}

// What is done to the file of a run at work, and what it says as it ends.
TEST_F(Determinism, a_file_taken_from_a_run_at_work_ends_it_and_it_resumes_with_its_rows) {
  const Words often{"Checkpoint/Every = 100"};
  const auto meddled = [&](const std::string &name, const std::function<void(const fs::path &)> &meddle,
                           const std::string &said) {
    const fs::path folder = folder_ / "taken", file = folder / name;
    fs::remove_all(folder);
    Program program(command("taken", often, {"--quiet"}), folder_);
    ASSERT_TRUE(program.wait_until([&] { return lines_in(file) >= 40; }));
    program.send(SIGSTOP);
    meddle(file);
    program.send(SIGCONT);
    EXPECT_EQ(program.wait(), 4) << said;
    const std::string error = content_of(folder_ / "error.txt");
    EXPECT_TRUE(contains(error, "error: taken/" + name + ": has been " + said));
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_FALSE(fs::exists(folder / "summary.json"));
  };
  const auto resumed = [&] { return run_compress(arguments("taken", often, {"--resume"}), folder_); };
  const auto removed = [](const fs::path &file) { fs::remove(file); };
  meddled("history.csv", removed, "removed");
  const Outcome lost = resumed();
  EXPECT_EQ(lost.status, 2);
  EXPECT_TRUE(contains(lost.error, "history.csv: error: is missing"));
  meddled("cracks.csv", removed, "removed");
  meddled(
      "history.csv", [](const fs::path &file) { fs::resize_file(file, 1000); }, "changed by another program");
  meddled(
      "history.csv",
      [](const fs::path &file) {
        fs::rename(file, file.string() + ".old");
        fs::copy_file(file.string() + ".old", file);
      },
      "replaced by another file");
  const Outcome back = resumed(); // it has its rows up to the checkpoint
  EXPECT_EQ(back.status, 0) << back.error;
}

// The first is held still, so that the others meet it.
TEST_F(Determinism, a_second_run_in_its_folder_is_refused_and_changes_nothing) {
  Program first(command("taken", {}), folder_);
  ASSERT_TRUE(first.wait_until([&] { return lines_in(folder_ / "taken/history.csv") >= 30; }));
  first.send(SIGSTOP);
  for (const char *way : {"--overwrite", "--resume"}) {
    const Outcome second = run_compress(arguments("taken", {}, {way}), folder_);
    EXPECT_EQ(second.status, 2) << way;
    EXPECT_TRUE(contains(second.error, "taken: another run is at work in it"));
  }
  first.send(SIGCONT);
  EXPECT_EQ(first.wait(), 0);
  expect_same(crushed_once(), "taken");
}

// Started is a program once it holds SIGUSR1 back; until then the loader reads its libraries.
bool holds_signals_back(pid_t id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("SigBlk:", 0) == 0) {
      const unsigned long long held = std::stoull(line.substr(7), nullptr, 16);
      const auto holds = [&](int number) { return (held >> (number - 1) & 1) != 0; };
      return holds(SIGUSR1) && !holds(SIGCHLD); // between fork and exec all are held
    }
  return false;
}

// While libraries initialise, spheres are packed and bonds made nothing is written.
TEST_F(Determinism, a_signal_before_anything_was_written_ends_at_once_and_leaves_nothing) {
  for (const int milliseconds : {0, 60, 300})
    for (const int number : {SIGTERM, SIGINT}) {
      Program program(command("early", {"Specimen/Sphere radius = 0.3 mm"}, {"-t", "1", "--quiet"}), folder_);
      ASSERT_TRUE(program.wait_until([&] { return holds_signals_back(program.id()); }));
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      program.send(number);
      EXPECT_EQ(program.wait(), 128 + number) << milliseconds;
      EXPECT_EQ(content_of(folder_ / "error.txt"), "");
      EXPECT_FALSE(fs::exists(folder_ / "early")) << milliseconds;
    }
}

TEST_F(Determinism, a_checkpoint_asked_for_while_spheres_are_packed_is_written) {
  Program program(command("asked", {"Checkpoint/Every = 1000000"}), folder_);
  ASSERT_TRUE(program.wait_until([&] { return holds_signals_back(program.id()); }));
  program.send(SIGUSR1);
  EXPECT_EQ(program.wait(), 0);
  ASSERT_TRUE(fs::exists(folder_ / "asked/checkpoint"));
  const auto first = fs::directory_iterator(folder_ / "asked/checkpoint")->path().filename().string();
  EXPECT_LT(std::stol(first.substr(5)), 100) << first; // step_000000000016.platen: of the first steps
}

TEST_F(Determinism, a_reader_that_leaves_ends_no_run) {
  const std::string piped = R"({ "$0" "$@"; echo "status $?" >&2; } | head -n 1)";
  Program(with({"/bin/sh", "-c", piped}, command("piped", {})), folder_).wait();
  EXPECT_EQ(content_of(folder_ / "out.txt"), "Small cylinder, crushed fast\n");
  EXPECT_TRUE(contains(content_of(folder_ / "error.txt"), "status 0\n"));
  expect_same(crushed_once(), "piped");
}

TEST_F(Determinism, a_run_that_was_killed_goes_on_from_its_last_checkpoint) {
  // Row 132 is step 2600: after the checkpoint of step 2500, so that rows, cracks and a frame have to go.
  EXPECT_EQ(stop_at("killed", 132, SIGKILL, {}, {"-t", "2"}), -SIGKILL);
  EXPECT_FALSE(fs::exists(folder_ / "killed/summary.json"));
  crush("killed", {}, {"-t", "1", "--resume"});
  expect_same(crushed_once(), "killed");
}

// Nothing is left to do then but to write the ends of all files, and no step makes contacts known anew.
TEST_F(Determinism, a_run_killed_after_a_checkpoint_of_its_last_step_ends_as_if_it_had_not_been) {
  Words entries{"Specimen/Sphere radius = 1.7 mm"};
  const long steps = crush("whole", entries)["steps"];
  entries.push_back("Checkpoint/Every = " + std::to_string(steps));
  crush("last", entries);
  const auto last = results_in(folder_ / "last");
  crush("last", entries, {"--resume"});
  EXPECT_EQ(difference(last, results_in(folder_ / "last")), "");
}

// The set is not in the scene but where a user pins it: another machine's best is another.
TEST_F(Determinism, a_resumed_run_keeps_the_instruction_set_that_it_began_with) {
  const Words plain{"Integration/Instruction set = baseline"};
  crush("whole", plain);
  EXPECT_EQ(stop_at("stopped", 30, SIGTERM, plain), 143);
  std::string scene = content_of(folder_ / "stopped/scene.prm");
  const std::size_t at = scene.find("Instruction set");
  ASSERT_NE(at, std::string::npos);
  scene.replace(scene.find("baseline", at), 8, "best");
  put(folder_ / "stopped/scene.prm", scene);
  EXPECT_EQ(crush("stopped", {}, {"--resume"})["instruction_set"], "baseline");
  auto whole = results_in(folder_ / "whole"), stopped = results_in(folder_ / "stopped");
  whole.erase("scene.prm"), stopped.erase("scene.prm");
  EXPECT_EQ(difference(whole, stopped), "");
}

} // namespace
} // namespace platen::apps::testing
