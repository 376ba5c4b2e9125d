// A run is its scene: neither threads nor stops nor crashes of the machine change a byte of what it finds.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <thread>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

class Determinism : public ScratchFolder {
protected:
  // Crushes the specimen whole into the folder `name`.
  void crush(const std::string &name, const std::string &threads,
             const std::vector<std::string> &options = {}) {
    std::vector<std::string> arguments{scene_, "-o", name, "-t", threads, "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run_compress(arguments, folder_);
    ASSERT_EQ(outcome.status, 0) << outcome.error;
  }
  // Starts or goes on with a run, and sends `signal` once history.csv holds `rows` lines; gives how the run
  // ended.
  int stop_at(const std::string &name, long rows, int signal, std::vector<std::string> options) {
    options.insert(options.begin(), {scene_, "-o", name, "--quiet"});
    Program program(compress_command(options), folder_);
    const auto reached = [&] { return lines_in(folder_ / name / "history.csv") >= rows; };
    EXPECT_TRUE(program.wait_until(reached)) << content_of(folder_ / "error.txt");
    program.send(signal);
    return program.wait();
  }
  Outcome resume(const std::string &name, const std::string &threads) {
    return run_compress({scene_, "-o", name, "-t", threads, "--resume", "--quiet"}, folder_);
  }
  nlohmann::json figures(const std::string &name) const {
    nlohmann::json summary = summary_in(folder_ / name);
    for (const char *cost : {"threads", "wall_seconds", "setup_seconds", "particle_steps_per_second",
                             "stage_seconds", "peak_memory_bytes", "bytes_in_columns_and_search"})
      summary.erase(cost);
    return summary;
  }

  const std::string scene_ = test_scene("crushed.prm");
};

TEST_F(Determinism, threads_change_no_byte) {
  // Packed closely: the packing has to repeat too, and more spheres touch.
  const std::vector<std::string> close{"-s", "Specimen/Packing = random close"};
  crush("one", "1", close);
  const auto one = results_in(folder_ / "one");
  // A run that is worth repeating: more than one block of rows in every loop, failure of both kinds, grains
  // that touch again, frames.
  EXPECT_GT(summary_in(folder_ / "one")["particles"], 1024);
  EXPECT_GT(summary_in(folder_ / "one")["broken_tension"], 500);
  EXPECT_GT(summary_in(folder_ / "one")["broken_shear"], 50);
  EXPECT_GT(column_of(folder_ / "one/history.csv", "grain_contacts").back(), 20);
  EXPECT_GT(lines_in(folder_ / "one/specimen.pvd"), 8);
  for (const char *threads : {"2", "4"}) {
    crush(threads, threads, close);
    EXPECT_EQ(difference(one, results_in(folder_ / threads)), "") << threads << " threads";
    EXPECT_EQ(figures("one"), figures(threads));
  }
}

// The C library is told to take the code of an older processor: with Weibull's strengths, Hertz's contacts
// and restitution, friction that falls with speed, a platen that turns and a sleeve (of 20 faces around, of
// whose corners one has another last bit in either code).
TEST_F(Determinism, the_baseline_gives_the_same_bytes_on_an_older_processor) {
  const auto entries = [](std::initializer_list<const char *> all) {
    std::vector<std::string> options{"-s", "Integration/Instruction set = baseline"};
    for (const char *entry : all)
      options.insert(options.end(), {"-s", entry});
    return options;
  };
  const std::pair<const char *, std::vector<std::string>> runs[] = {
      {"scatter", entries({"Bond/Strength scatter = weibull", "Bond/Weibull modulus = 6",
                           "Effects/Contact = hertz", "Material/Young modulus = 40 GPa",
                           "Material/Poisson ratio = 0.2", "Contact/Restitution = 0.6",
                           "Bond/Friction angle = 33.3 degree", "Platens/Friction law = velocity weakening",
                           "Platens/Slip velocity = 0.05 m/s", "Platens/Top/Seat = spherical"})},
      {"sleeve", entries({"Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
                          "Loading/Confining ramp = 0.1 ms", "Loading/Target strain = 0.004",
                          "Sleeve/Thickness = 1 mm", "Sleeve/Elements around = 20"})},
      {"elastic",
       entries({"Platens/Kind = deformable", "Platens/Motion = explicit", "Loading/Target strain = 0.004"})}};
  for (const auto &[name, options] : runs) {
    const std::string here = name, older = here + " older";
    crush(here, "2", options);
    ASSERT_EQ(setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2", 1), 0);
    crush(older, "2", options);
    unsetenv("GLIBC_TUNABLES");
    EXPECT_GT(summary_in(folder_ / here)["broken_tension"], 300) << name;
    EXPECT_EQ(summary_in(folder_ / here)["instruction_set"], "baseline");
    for (const char *file : {"history.csv", "cracks.csv"})
      EXPECT_EQ(content_of(folder_ / here / file), content_of(folder_ / older / file)) << name;
  }
}

TEST_F(Determinism, a_run_stopped_twice_ends_as_if_it_had_not_been) {
  crush("whole", "2");
  EXPECT_EQ(stop_at("stopped", 30, SIGHUP, {"-t", "1"}), 129);
  EXPECT_EQ(summary_in(folder_ / "stopped")["status"], "stopped");
  // What it found after the peak counts from where spheres lay there, which the checkpoint has to know.
  EXPECT_FALSE(summary_in(folder_ / "whole")["dead_zone_top"].is_null());
  EXPECT_FALSE(summary_in(folder_ / "whole")["final_dead_zone_top"].is_null());
  EXPECT_EQ(stop_at("stopped", 110, SIGTERM, {"-t", "2", "--resume"}), 143);
  const Outcome last = resume("stopped", "4");
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
  EXPECT_EQ(figures("whole"), figures("stopped"));
}

// Each is refused with nothing changed, and the run goes on once the file is what it was; rows after the
// checkpoint count for nothing.
TEST_F(Determinism, a_file_that_was_edited_or_lost_since_the_checkpoint_is_refused_by_name) {
  put(folder_ / "aggregate.txt", "1\n2\n3\n");
  const std::vector<std::string> phases{"-s", "Phases/By = file", "-s",
                                        "Phases/File = " + (folder_ / "aggregate.txt").string()};
  crush("whole", "1", phases);
  std::vector<std::string> arguments{"-t", "1"};
  arguments.insert(arguments.end(), phases.begin(), phases.end());
  EXPECT_EQ(stop_at("stopped", 150, SIGTERM, arguments), 143);
  const auto again = [&] {
    std::vector<std::string> all{scene_, "-o", "stopped", "--resume"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_compress(all, folder_);
  };
  const auto refused = [&](const fs::path &file, const std::string &content, const std::string &said) {
    const std::string whole = content_of(file), log = content_of(folder_ / "stopped/run.log");
    content == "gone" ? static_cast<void>(fs::remove(file)) : put(file, content);
    const Outcome outcome = again();
    EXPECT_EQ(outcome.status, 2) << said;
    EXPECT_TRUE(contains(outcome.error, said)) << outcome.error;
    EXPECT_EQ(std::count(outcome.error.begin(), outcome.error.end(), '\n'), 1) << outcome.error;
    EXPECT_EQ(content_of(folder_ / "stopped/run.log"), log); // nothing was written
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
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
}

// What is done to the file of a run at work, and what it says as it ends.
TEST_F(Determinism, a_file_taken_from_a_run_at_work_ends_it_and_it_resumes_with_its_rows) {
  crush("whole", "1");
  const auto meddled = [&](const std::string &name, const std::function<void(const fs::path &)> &meddle,
                           const std::string &said) {
    const fs::path folder = folder_ / "taken";
    fs::remove_all(folder);
    Program program(
        compress_command({scene_, "-o", "taken", "--quiet", "-t", "1", "-s", "Checkpoint/Every = 100"}),
        folder_);
    ASSERT_TRUE(program.wait_until([&] { return lines_in(folder / name) >= 40; }));
    program.send(SIGSTOP);
    meddle(folder / name);
    program.send(SIGCONT);
    EXPECT_EQ(program.wait(), 4) << said;
    const std::string error = content_of(folder_ / "error.txt");
    EXPECT_TRUE(contains(error, "error: taken/" + name + ": has been " + said)) << error;
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
    EXPECT_FALSE(fs::exists(folder / "summary.json"));
  };
  const auto removed = [](const fs::path &file) { fs::remove(file); };
  meddled("history.csv", removed, "removed");
  const Outcome lost =
      run_compress({scene_, "-o", "taken", "--resume", "-t", "1", "-s", "Checkpoint/Every = 100"}, folder_);
  EXPECT_EQ(lost.status, 2);
  EXPECT_TRUE(contains(lost.error, "history.csv: error: is missing")) << lost.error;
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
  const Outcome back = // it has its rows up to the checkpoint
      run_compress({scene_, "-o", "taken", "--resume", "-t", "1", "-s", "Checkpoint/Every = 100"}, folder_);
  EXPECT_EQ(back.status, 0) << back.error;
}

// The first is held still, so that the others meet it.
// Started is a program once it holds SIGUSR1 back; until then the loader reads its libraries.
bool holds_signals_back(pid_t id) {
  std::ifstream status("/proc/" + std::to_string(id) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("SigBlk:", 0) == 0)
      return (std::stoull(line.substr(7), nullptr, 16) >> (SIGUSR1 - 1) & 1) != 0;
  return false;
}

// While libraries initialise, spheres are packed and bonds made nothing is written.
TEST_F(Determinism, a_signal_before_anything_was_written_ends_at_once_and_leaves_nothing) {
  const std::vector<std::string> fine{"-t", "1", "-s", "Specimen/Sphere radius = 0.3 mm"};
  for (const int milliseconds : {0, 60, 300})
    for (const int number : {SIGTERM, SIGINT}) {
      std::vector<std::string> options{scene_, "-o", "early", "--quiet"};
      options.insert(options.end(), fine.begin(), fine.end());
      Program program(compress_command(options), folder_);
      ASSERT_TRUE(program.wait_until([&] { return holds_signals_back(program.id()); }));
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      program.send(number);
      EXPECT_EQ(program.wait(), 128 + number) << milliseconds;
      EXPECT_EQ(content_of(folder_ / "error.txt"), "");
      EXPECT_FALSE(fs::exists(folder_ / "early")) << milliseconds;
    }
}

TEST_F(Determinism, a_checkpoint_asked_for_while_spheres_are_packed_is_written) {
  Program program(
      compress_command({scene_, "-o", "asked", "--quiet", "-t", "1", "-s", "Checkpoint/Every = 1000000"}),
      folder_);
  ASSERT_TRUE(program.wait_until([&] { return holds_signals_back(program.id()); }));
  program.send(SIGUSR1);
  EXPECT_EQ(program.wait(), 0);
  ASSERT_TRUE(fs::exists(folder_ / "asked/checkpoint"));
  const auto first = fs::directory_iterator(folder_ / "asked/checkpoint")->path().filename().string();
  EXPECT_LT(std::stol(first.substr(5)), 100) << first; // step_000000000016.platen: of the first steps
}

TEST_F(Determinism, a_second_run_in_its_folder_is_refused_and_changes_nothing) {
  crush("whole", "2");
  Program first(compress_command({scene_, "-o", "taken", "--quiet", "-t", "2"}), folder_);
  ASSERT_TRUE(first.wait_until([&] { return lines_in(folder_ / "taken/history.csv") >= 30; }));
  first.send(SIGSTOP);
  for (const char *way : {"--overwrite", "--resume"}) {
    const Outcome second = run_compress({scene_, "-o", "taken", "--quiet", way}, folder_);
    EXPECT_EQ(second.status, 2) << way;
    EXPECT_TRUE(contains(second.error, "taken: another run is at work in it")) << second.error;
  }
  first.send(SIGCONT);
  EXPECT_EQ(first.wait(), 0);
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "taken")), "");
}

TEST_F(Determinism, a_reader_that_leaves_ends_no_run) {
  crush("whole", "2");
  const std::string piped = R"({ "$0" "$@"; echo "status $?" >&2; } | head -n 1)";
  std::vector<std::string> command{"/bin/sh", "-c", piped};
  for (const std::string &argument : compress_command({scene_, "-o", "piped", "-t", "2"}))
    command.push_back(argument);
  Program(command, folder_).wait();
  EXPECT_EQ(content_of(folder_ / "out.txt"), "Small cylinder, crushed fast\n");
  EXPECT_TRUE(contains(content_of(folder_ / "error.txt"), "status 0\n")) << content_of(folder_ / "error.txt");
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "piped")), "");
}

// Begun at a strain by a static solve: first row as packed, second where it begins, and no second start.
TEST_F(Determinism, a_run_begun_statically_resumes_as_if_it_had_not_been_stopped) {
  const std::vector<std::string> begun{"-s", "Loading/Start strain = 4e-4"};
  crush("whole", "1", begun);
  const auto rows = [&](const char *name) { return column_of(folder_ / "whole/history.csv", name); };
  EXPECT_EQ(rows("axial_strain_platen")[0], 0);
  EXPECT_EQ(rows("axial_stress_top_pa")[0], 0);
  EXPECT_NEAR(rows("axial_strain_platen")[1], 4e-4, 1e-12);
  EXPECT_EQ(rows("time_s")[1], 0);
  EXPECT_EQ(rows("kinetic_energy_j")[1], 0);
  EXPECT_GT(rows("axial_stress_top_pa")[1], 1e6);
  EXPECT_LT(std::abs(rows("energy_residual_j")[1]), 0.01 * rows("bond_energy_j")[1]);
  std::vector<std::string> stopping{"-t", "2"};
  stopping.insert(stopping.end(), begun.begin(), begun.end());
  EXPECT_EQ(stop_at("stopped", 30, SIGTERM, stopping), 143);
  std::vector<std::string> going_on{scene_, "-o", "stopped", "-t", "1", "--resume", "--quiet"};
  going_on.insert(going_on.end(), begun.begin(), begun.end());
  const Outcome last = run_compress(going_on, folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
  EXPECT_EQ(figures("whole"), figures("stopped"));
}

TEST_F(Determinism, elastic_platens_are_as_repeatable_and_their_energy_balance_closes) {
  for (const std::string motion : {"explicit", "quasi-static"}) {
    const std::vector<std::string> options{"-s", "Platens/Kind = deformable", "-s",
                                           "Platens/Motion = " + motion};
    const std::string whole = motion, stopped = motion + " stopped";
    crush(whole, "1", options);
    const nlohmann::json found = summary_in(folder_ / whole);
    EXPECT_GT(found["broken_tension"], 500);
    EXPECT_LT(found["energy_residual_relative"], 0.01);
    const bool still = motion == "quasi-static";
    EXPECT_EQ(found.contains("platen_unbalanced_work_relative"), still);
    const std::string history = content_of(folder_ / whole / "history.csv");
    EXPECT_EQ(history.find("platen_unbalanced_work_j") != std::string::npos, still);
    if (still) {
      const auto left = column_of(folder_ / whole / "history.csv", "platen_unbalanced_work_j");
      EXPECT_NE(left.back(), 0);
      EXPECT_LT(found["platen_unbalanced_work_relative"], 0.01);
    }
    const auto held = column_of(folder_ / whole / "history.csv", "body_energy_j");
    EXPECT_GT(*std::max_element(held.begin(), held.end()), 0);
    EXPECT_NE(content_of(folder_ / whole / "frames/platens_000002.vtu").find("von_mises"), std::string::npos);
    std::vector<std::string> stopping{"-t", "2"};
    stopping.insert(stopping.end(), options.begin(), options.end());
    EXPECT_EQ(stop_at(stopped, 70, SIGTERM, stopping), 143);
    std::vector<std::string> going_on{scene_, "-o", stopped, "-t", "4", "--resume", "--quiet"};
    going_on.insert(going_on.end(), options.begin(), options.end());
    const Outcome last = run_compress(going_on, folder_);
    EXPECT_EQ(last.status, 0) << last.error;
    EXPECT_EQ(difference(results_in(folder_ / whole), results_in(folder_ / stopped)), "");
    EXPECT_EQ(figures(whole), figures(stopped));
  }
}

TEST_F(Determinism, a_sleeve_goes_on_where_it_stopped) {
  std::vector<std::string> in_cell;
  for (const char *entry :
       {"Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
        "Loading/Confining ramp = 0.1 ms", "Loading/Target strain = 0.02", "Sleeve/Thickness = 1 mm"})
    in_cell.insert(in_cell.end(), {"-s", entry});
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), in_cell.begin(), in_cell.end());
    return options;
  };
  crush("whole", "1", in_cell);
  const nlohmann::json found = summary_in(folder_ / "whole");
  EXPECT_GT(found["broken_tension"], 500);
  EXPECT_LT(found["energy_residual_relative"], 0.01);
  EXPECT_GT(found["sleeve_steps_of_interval"], 1);
  EXPECT_TRUE(fs::exists(folder_ / "whole/sleeve.pvd"));
  // In the hydrostatic stage, and after the peak.
  EXPECT_EQ(stop_at("stopped", 15, SIGTERM, with({"-t", "2"})), 143);
  EXPECT_EQ(stop_at("stopped", 110, SIGTERM, with({"-t", "1", "--resume"})), 143);
  const Outcome last = run_compress(with({scene_, "-o", "stopped", "--resume", "--quiet"}), folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
  EXPECT_EQ(figures("whole"), figures("stopped"));
}

TEST_F(Determinism, a_platen_on_its_seat_goes_on_where_it_stopped_and_turns_the_rim_of_a_sleeve) {
  std::vector<std::string> seated;
  for (const char *entry :
       {"Platens/Top/Seat = spherical", "Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
        "Loading/Confining ramp = 0.1 ms", "Loading/Target strain = 0.02", "Sleeve/Thickness = 1 mm"})
    seated.insert(seated.end(), {"-s", entry});
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), seated.begin(), seated.end());
    return options;
  };
  crush("whole", "1", seated);
  EXPECT_GT(summary_in(folder_ / "whole")["broken_tension"], 500);
  EXPECT_LT(summary_in(folder_ / "whole")["energy_residual_relative"], 0.01);
  EXPECT_EQ(stop_at("stopped", 110, SIGTERM, with({"-t", "2"})), 143);
  const Outcome last = run_compress(with({scene_, "-o", "stopped", "--resume", "--quiet"}), folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
  EXPECT_EQ(figures("whole"), figures("stopped"));
}

TEST_F(Determinism, a_run_that_was_killed_goes_on_from_its_last_checkpoint) {
  crush("whole", "1");
  // Row 132 is step 2600: after the checkpoint of step 2500, so that rows, cracks and a frame have to go.
  EXPECT_EQ(stop_at("killed", 132, SIGKILL, {"-t", "2"}), -SIGKILL);
  EXPECT_FALSE(fs::exists(folder_ / "killed/summary.json"));
  const Outcome last = resume("killed", "1");
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "killed")), "");
  EXPECT_EQ(figures("whole"), figures("killed"));
}

// Nothing is left to do then but to write the ends of all files, and no step makes contacts known anew.
TEST_F(Determinism, a_run_killed_after_a_checkpoint_of_its_last_step_ends_as_if_it_had_not_been) {
  std::vector<std::string> entries{"-s", "Specimen/Sphere radius = 1.7 mm"};
  crush("whole", "1", entries);
  const long steps = summary_in(folder_ / "whole")["steps"];
  entries.insert(entries.end(), {"-s", "Checkpoint/Every = " + std::to_string(steps)});
  crush("last", "1", entries);
  const auto last = results_in(folder_ / "last");
  entries.push_back("--resume");
  crush("last", "1", entries);
  EXPECT_EQ(difference(last, results_in(folder_ / "last")), "");
}

TEST_F(Determinism, all_that_has_a_memory_goes_on_where_it_stopped) {
  // What crushed.prm leaves out: a servo, Hertz contacts with rolling, seats, gravity, scaled masses, a
  // dissipative scheme, bonds of unlike strength, phases.
  std::vector<std::string> effects;
  for (const char *entry : {"Platens/Top/Control = stress", "Platens/Top/Stress = 60 MPa",
                            "Loading/Ramp = 0.2 ms", "Loading/Hold = 0.2 ms", "Effects/Contact = hertz",
                            "Effects/Tangential = coulomb with rolling resistance",
                            "Contact/Rolling friction = 0.1", "Effects/Gravity = on", "Specimen/Seat = on",
                            "Integration/Mass scaling = 2", "Integration/Scheme = tchamwa wielgosz",
                            "Integration/Dissipation = 1.2", "Bond/Strength scatter = weibull",
                            "Bond/Weibull modulus = 6", "Phases/By = radius", "Phases/Radius above = 0.9 mm",
                            "Phases/Interface modulus factor = 0.7", "Phases/Aggregate strength factor = 2"})
    effects.insert(effects.end(), {"-s", entry});
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), effects.begin(), effects.end());
    return options;
  };
  crush("whole", "1", effects);
  for (const char *effect : {"hertz contact", "rolling resistance", "gravity", "seats", "mass scaling",
                             "dissipative scheme", "scattered strengths", "phases"})
    EXPECT_TRUE(contains(summary_in(folder_ / "whole")["effects"].dump(), effect)) << effect;
  EXPECT_GT(summary_in(folder_ / "whole")["broken_tension"], 500);
  EXPECT_EQ(stop_at("stopped", 90, SIGTERM, with({"-t", "2"})), 143);
  const Outcome last = run_compress(with({scene_, "-o", "stopped", "--resume", "--quiet"}), folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
  EXPECT_EQ(figures("whole"), figures("stopped"));
}

TEST_F(Determinism, a_run_in_a_hurry_goes_on_where_it_stopped) {
  const std::vector<std::string> hurry{"-s", "Loading/Hurry = 4", "-s", "Loading/Axial rate = 0.1"};
  const auto with = [&](std::vector<std::string> options) {
    options.insert(options.end(), hurry.begin(), hurry.end());
    return options;
  };
  crush("whole", "1", hurry);
  for (const int lines : {15, 60}) { // in a hurry, and failing
    const std::string to = "stopped_" + std::to_string(lines);
    EXPECT_EQ(stop_at(to, lines, SIGTERM, with({"-t", "2"})), 143);
    const Outcome last = run_compress(with({scene_, "-o", to, "--resume", "--quiet"}), folder_);
    EXPECT_EQ(last.status, 0) << last.error;
    EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / to)), "");
  }
}

// The set is not in the scene but where a user pins it: another machine's best is another.
TEST_F(Determinism, a_resumed_run_keeps_the_instruction_set_that_it_began_with) {
  const std::vector<std::string> plain{"-s", "Integration/Instruction set = baseline"};
  crush("whole", "2", plain);
  EXPECT_EQ(stop_at("stopped", 30, SIGTERM, plain), 143);
  std::string scene = content_of(folder_ / "stopped/scene.prm");
  const std::size_t at = scene.find("Instruction set");
  ASSERT_NE(at, std::string::npos);
  scene.replace(scene.find("baseline", at), 8, "best");
  put(folder_ / "stopped/scene.prm", scene);
  const Outcome last = resume("stopped", "2");
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(summary_in(folder_ / "stopped")["instruction_set"], "baseline");
  auto whole = results_in(folder_ / "whole"), stopped = results_in(folder_ / "stopped");
  whole.erase("scene.prm"), stopped.erase("scene.prm");
  EXPECT_EQ(difference(whole, stopped), "");
}

} // namespace
} // namespace platen::apps::testing
