// platen-calibrate on some hundred spheres.
#include "apps/calibrate/run_calibrate.h"

#include <gtest/gtest.h>

#include <unistd.h>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <nlohmann/json.hpp>

#include "apps/output/sha256.h"
#include "apps/output/stop_signal.h"
#include "apps/program.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

const char *const calibration_text = R"(subsection Scene
  set Seed = 4
end
subsection Specimen
  set Radius = 8 mm
  set Height = 20 mm
  set Sphere radius = 1.2 mm
  set Radius spread = 0.25
  set Ends = ground
  set End layer = 0.5
end
subsection Bond
  set Modulus = 36 GPa
  set Stiffness ratio = 0.4
  set Tensile strength = 9.5 MPa
  set Shear strength = 38 MPa
  set Friction angle = 45 degree
  set Moment contribution = 0.3
  set Gap = 0.05 R_min
end
subsection Platens
  set Friction static = 0.57
end
subsection Loading
  set Axial rate = 0.05 m/s
  set Target strain = 0.02
end
subsection Calibrate
  set Seeds = 2
  set Verification seeds = 1
end
)";

std::string text_of(const fs::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class CalibrateApp : public ::testing::Test {
protected:
  CalibrateApp() : folder(fs::temp_directory_path() / ("platen_calibrate_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
    std::ofstream(folder / "case.prm") << calibration_text;
    setenv("PLATEN_CACHE", "none", 1); // what is tested is made here, not found
  }
  ~CalibrateApp() override {
    setenv("PLATEN_CACHE", "none", 1);
    fs::remove_all(folder);
  }

  Scene read(const std::vector<std::string> &overrides) const {
    return read_scene((folder / "case.prm").string(), overrides, program("calibrate"));
  }
  // A calibration that does not meet its targets ends with status 1 and says by how much, any other with 0.
  nlohmann::json run(const std::vector<std::string> &overrides, const std::string &to, bool resume = false,
                     int threads = 1) const {
    CommandLine command;
    command.scene = (folder / "case.prm").string();
    command.output = (folder / to).string();
    command.overrides = overrides;
    command.quiet = true;
    command.resume = resume;
    command.threads = threads;
    const int status = run_calibrate(command, read(overrides));
    const auto summary = nlohmann::json::parse(text_of(folder / to / "summary.json"));
    bool met = true;
    if (summary.contains("targets"))
      for (const auto &target : summary["targets"])
        met = met && target.value("met", target.value("met_in_training", false));
    EXPECT_EQ(status, met ? status_done : status_check_failed);
    EXPECT_EQ(summary.contains("targets_missed") && !summary["targets_missed"].empty(), !met);
    return summary;
  }
  std::string fault(const std::vector<std::string> &overrides) const {
    try {
      read(overrides);
    } catch (const InputError &e) {
      return e.what();
    }
    return "";
  }

  fs::path folder;
};

// Exact properties of linear networks, and bounds that hold for every one of them.
TEST_F(CalibrateApp, an_abacus_is_linear_in_the_modulus_and_falls_with_the_ratio) {
  const auto s = run({"Calibrate/Mode = abacus", "Calibrate/Modulus list = 18 GPa, 36 GPa",
                      "Calibrate/Stiffness ratio list = 0.2, 0.5, 1"},
                     "a");
  const auto &rows = s["abacus"];
  ASSERT_EQ(rows.size(), 6u);
  const auto young = [&](std::size_t k) { return rows[k]["youngs_modulus_gauge_pa"].get<double>(); };
  const auto poisson = [&](std::size_t k) { return rows[k]["poisson_ratio"].get<double>(); };
  for (const std::size_t k : {0u, 2u, 4u}) {
    EXPECT_NEAR(young(k + 1), 2 * young(k), 1e-9 * young(k));
    EXPECT_EQ(poisson(k + 1), poisson(k));
  }
  EXPECT_LT(young(0), young(2));
  EXPECT_LT(young(2), young(4));
  EXPECT_GT(poisson(0), poisson(2));
  EXPECT_GT(poisson(2), poisson(4));
  // Of the scene's own ratio, 0.4, between the first two at 36 GPa.
  EXPECT_GT(s["bounds"]["young_voigt_pa"].get<double>(), young(1));
  EXPECT_NEAR(s["bounds"]["young_reuss_pa"].get<double>() / s["bounds"]["young_voigt_pa"].get<double>(),
              5 * .4 / (2 + 3 * .4) / ((2 + 3 * .4) / 4.4), 1e-9);
  EXPECT_EQ(s["trials"], 6); // three ratios on two seeds: the moduli need no solve
  EXPECT_EQ(s["failed_trials"], 0);
}

// The line that the abacus does not use: two moduli solved for are as two lengths.
TEST_F(CalibrateApp, moduli_that_are_solved_for_are_proportional_too) {
  const auto one = run({"Calibrate/Mode = abacus", "Bond/Modulus = 10 GPa"}, "a"),
             other = run({"Calibrate/Mode = abacus", "Bond/Modulus = 70 GPa"}, "b");
  EXPECT_NEAR(other["abacus"][0]["youngs_modulus_gauge_pa"].get<double>(),
              7 * one["abacus"][0]["youngs_modulus_gauge_pa"].get<double>(), 1e4);
  EXPECT_NEAR(other["abacus"][0]["poisson_ratio"].get<double>(),
              one["abacus"][0]["poisson_ratio"].get<double>(), 1e-6);
}

std::vector<std::string> wanted(const nlohmann::json &known) {
  std::ostringstream young, poisson;
  young.precision(12), poisson.precision(12);
  young << "Calibrate/Young modulus = " << known["abacus"][0]["youngs_modulus_gauge_pa"].get<double>()
        << " Pa";
  poisson << "Calibrate/Poisson ratio = " << known["abacus"][0]["poisson_ratio"].get<double>();
  return {"Bond/Modulus = 20 GPa", "Bond/Stiffness ratio = 0.9", young.str(), poisson.str()};
}

TEST_F(CalibrateApp, packings_are_found_in_the_cache_by_another_calibration) {
  setenv("PLATEN_CACHE", (folder / "kept").c_str(), 1);
  const auto packing_in = [&](const fs::path &at) {
    for (const auto &entry : fs::directory_iterator(at))
      if (entry.path().extension() == ".csv") return entry.path();
    return fs::path();
  };
  const auto modulus = [&](const std::vector<std::string> &more, const char *to) {
    std::vector<std::string> asked{"Calibrate/Mode = abacus", "Calibrate/Seeds = 1"};
    asked.insert(asked.end(), more.begin(), more.end());
    return run(asked, to)["abacus"][0]["youngs_modulus_gauge_pa"].get<double>();
  };
  const double first = modulus({}, "a"), second = modulus({"Scene/Seed = 5", "Specimen/Cache = none"}, "b");
  ASSERT_NE(first, second);
  const fs::path kept = packing_in(folder / "kept"), other = packing_in(folder / "b/packings");
  ASSERT_FALSE(kept.empty() || other.empty());
  // The spheres of the second, planted under the recipe of the first: a line of it, spheres, a checksum.
  const std::string text = text_of(kept), spheres = text_of(other);
  std::string planted = text.substr(0, text.find('\n') + 1) + spheres.substr(spheres.find('\n') + 1);
  planted.resize(planted.rfind("# sha256"));
  std::ofstream(kept, std::ios::binary) << planted << "# sha256 of all above: " << sha256_of(planted) << "\n";
  EXPECT_EQ(modulus({}, "c"), second);
}

TEST_F(CalibrateApp, the_search_recovers_the_bonds_of_a_known_specimen) {
  const auto known = run({"Calibrate/Mode = abacus"}, "known");
  const auto found = run(wanted(known), "found");
  // Poisson's ratio is met within 1e-4, which is 4e-4 of the stiffness ratio.
  EXPECT_NEAR(found["found"]["stiffness_ratio"].get<double>(), .4, 1e-3);
  EXPECT_NEAR(found["found"]["bond_modulus_pa"].get<double>(), 36e9, 36e6);
  EXPECT_EQ(found["verification"]["poisson_ratio"]["seeds"], 1);
  EXPECT_TRUE(found["missed"].empty());
  const Scene scene = read_scene((folder / "found/found.prm").string(), {}, program("compress"));
  EXPECT_EQ(scene.model.bond_layout.modulus, found["found"]["bond_modulus_pa"].get<double>());
  EXPECT_EQ(scene.bond.number("stiffness_ratio"), found["found"]["stiffness_ratio"].get<double>());
}

// Bonds of a ready material to begin with: what they were calibrated on is not what is calibrated now.
TEST_F(CalibrateApp, what_the_first_bonds_were_calibrated_on_judges_no_trial) {
  const auto s = run(
      {"Calibrate/Compressive strength = 40 MPa", "Calibrate/Seeds = 1", "Calibrate/Verification seeds = 0",
       "Calibrate/Most trials = 1", "Bond/Calibrated figures = tension"},
      "a");
  EXPECT_EQ(s["failed_trials"], 0);
  EXPECT_GT(s["strength_pa"].get<double>(), 20e6);
  const Scene found = read_scene((folder / "a/found.prm").string(), {}, program("compress"));
  EXPECT_TRUE(found.bond.calibrated.figures.empty());
}

TEST_F(CalibrateApp, a_search_that_was_cut_off_goes_on_to_the_same_answer) {
  std::vector<std::string> asked{"Calibrate/Poisson ratio = 0.12", "Calibrate/Tensile strength = 3 MPa",
                                 "Calibrate/Tolerance = 0.05"};
  run(asked, "a", false, 2);
  const std::string found = text_of(folder / "a/found.prm"), trials = text_of(folder / "a/trials.csv");
  const fs::path one = folder / "a/runs/trial_2_tensile_strength_pa_seed_5";
  ASSERT_TRUE(fs::exists(one / "summary.json"));
  fs::remove(one / "summary.json");
  for (const char *file : {"found.prm", "trials.csv", "summary.json"})
    fs::remove(folder / "a" / file);
  const auto again = run(asked, "a", true);
  EXPECT_TRUE(fs::exists(one / "summary.json"));
  EXPECT_EQ(text_of(folder / "a/found.prm"), found);
  EXPECT_EQ(text_of(folder / "a/trials.csv"), trials);
  const auto refused = [&](const std::string &to) -> std::string {
    try {
      run(asked, to, true);
    } catch (const InputError &e) {
      return e.what();
    }
    return "";
  };
  asked.front() = "Calibrate/Poisson ratio = 0.13";
  const std::string another_scene = refused("a");
  EXPECT_NE(another_scene.find("Calibrate/Poisson ratio = 0.13 was 0.12 when the run began"),
            std::string::npos)
      << another_scene;
  EXPECT_NE(refused("b").find("b/scene.prm: error: is missing: the folder holds nothing to resume"),
            std::string::npos)
      << refused("b");
}

// A test of minutes is given up, not waited for; what was written before is there to go on with.
TEST_F(CalibrateApp, a_signal_ends_it_within_a_trial) {
  const fs::path table = folder / "a/trials.csv";
  testing::Program program(
      {PLATEN_CALIBRATE_PROGRAM, "case.prm", "-o", "a", "-t", "1", "--quiet", "-s",
       "Calibrate/Young modulus = 17 GPa", "-s", "Calibrate/Compressive strength = 40 MPa", "-s",
       "Loading/Axial rate = 1e-4 m/s", "-s", "Loading/Target strain = 0.2"},
      folder);
  ASSERT_TRUE(program.wait_until([&] { return text_of(table).find("elastic,") != std::string::npos; }))
      << text_of(folder / "error");
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // after the static solves the trial begins
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), exit_status_of_signal(SIGTERM)) << text_of(folder / "error");
  const std::string rows = text_of(table);
  EXPECT_NE(rows.find("elastic,"), std::string::npos);
  EXPECT_EQ(rows.find("compressive_strength_pa,"), std::string::npos) << rows;
  EXPECT_FALSE(fs::exists(folder / "a/summary.json"));
}

TEST_F(CalibrateApp, strengths_are_found) {
  const auto s = run({"Calibrate/Compressive strength = 40 MPa", "Calibrate/Seeds = 1",
                      "Calibrate/Verification seeds = 0", "Calibrate/Most trials = 4"},
                     "a");
  // One packing scatters by round-off alone; proportionality has brought it there from 9.5 MPa.
  EXPECT_NEAR(s["strength_pa"].get<double>(), 40e6, 4e6);
}

// One trial on one packing; Mohr's circles rise with pressure by more than the pressure itself wherever there
// is friction, and the found scene gives the measured strength again.
TEST_F(CalibrateApp, a_triaxial_strength_is_measured_under_its_pressure) {
  const std::vector<std::string> asked{"Calibrate/Compressive strength = 40 MPa",
                                       "Calibrate/Triaxial strength = 52 MPa",
                                       "Calibrate/Confining pressure = 4 MPa",
                                       "Calibrate/Seeds = 1",
                                       "Scene/Seed = 7",
                                       "Calibrate/Verification seeds = 0",
                                       "Calibrate/Most trials = 1"};
  const auto s = run(asked, "a");
  EXPECT_EQ(s["failed_trials"], 0);
  EXPECT_EQ(s["trials"], 3); // compression, triaxial and a static solve
  EXPECT_GT(s["triaxial_strength_pa"].get<double>(), s["strength_pa"].get<double>() + 1.5 * 4e6);
  EXPECT_LT(s["triaxial_strength_pa"].get<double>(), s["strength_pa"].get<double>() + 15 * 4e6);
}

TEST_F(CalibrateApp, runs_without_a_peak_are_counted_and_not_fatal) {
  const auto s = run({"Calibrate/Compressive strength = 20 MPa", "Bond/Tensile strength = 30 MPa",
                      "Bond/Shear strength = 120 MPa", "Loading/Target strain = 0.006", "Calibrate/Seeds = 1",
                      "Calibrate/Verification seeds = 0", "Loading/Axial rate = 0.04 m/s"},
                     "a");
  EXPECT_GT(s["failed_trials"].get<int>(), 0);
  EXPECT_EQ(s["status"], "done");
  EXPECT_NEAR(s["strength_pa"].get<double>(), 20e6, 2e6);
  EXPECT_NE(text_of(folder / "a/trials.csv").find("no peak"), std::string::npos);
}

// What a fast test bears is not the specimen's strength: no bonds are found by it.
TEST_F(CalibrateApp, trials_that_are_too_fast_do_not_count) {
  const std::vector<std::string> asked{"Calibrate/Compressive strength = 40 MPa",
                                       "Calibrate/Young modulus = 24 GPa", "Calibrate/Seeds = 1",
                                       "Calibrate/Verification seeds = 0", "Loading/Axial rate = 0.8 m/s"};
  CommandLine command;
  command.scene = (folder / "case.prm").string();
  command.output = (folder / "fast").string();
  command.overrides = asked;
  command.quiet = true;
  try {
    run_calibrate(command, read(asked));
    ADD_FAILURE() << "bonds were found by trials that were too fast";
  } catch (const NumericsError &error) {
    const std::string says = error.what();
    for (const char *part : {"no trial counts, too fast to be quasi-static", "wave crossings to the peak",
                             "A lower Loading/Axial rate helps"})
      EXPECT_NE(says.find(part), std::string::npos) << says;
  }
  const std::string rows = text_of(folder / "fast/trials.csv");
  const auto compression = rows.find("\ncompressive_strength_pa");
  ASSERT_NE(compression, std::string::npos) << rows;
  EXPECT_NE(rows.find("too fast to be quasi-static", compression), std::string::npos) << rows;
  EXPECT_EQ(rows.find("\ncompressive_strength_pa", compression + 1), std::string::npos)
      << rows; // one is enough
  // Before anything is packed the dry run says so, and of a slow one nothing.
  const auto told = [&](const char *rate) {
    std::vector<std::string> entries = asked;
    entries.back() = std::string("Loading/Axial rate = ") + rate;
    command.overrides = entries, command.dry_run = true;
    ::testing::internal::CaptureStdout();
    EXPECT_EQ(run_calibrate(command, read(entries)), status_done);
    return ::testing::internal::GetCapturedStdout();
  };
  EXPECT_NE(told("0.8 m/s").find("too fast to be quasi-static: such trials do not count"), std::string::npos);
  EXPECT_NE(told("0.8 m/s").find("A lower Loading/Axial rate helps: 0."), std::string::npos)
      << told("0.8 m/s");
  EXPECT_EQ(told("0.05 m/s").find("too fast"), std::string::npos) << told("0.05 m/s");
}

// Screen, summary and page tell one number of a curve: that which decides whether it is met.
TEST_F(CalibrateApp, a_curve_is_told_by_what_it_is_judged_by) {
  std::ofstream(folder / "curve.csv") << "strain_platen,stress_mpa\n0.001,15\n0.002,28\n0.003,30\n";
  const auto s = run({"Calibrate/Seeds = 2", "Calibrate/Verification seeds = 0", "Calibrate/Most trials = 1",
                      "Calibrate/Free = modulus, tensile strength", "Calibrate/Target 1 = curve 1: +- 1 %",
                      "Calibrate/Curve 1 = " + (folder / "curve.csv").string()},
                     "a");
  const double miss = s["targets"][0]["training_miss"];
  ASSERT_GT(std::abs(s["training"]["curve_miss"]["mean"].get<double>() - miss), 1e-3 * miss)
      << "the packings agree: nothing is tested";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", miss);
  const std::string log = text_of(folder / "a/run.log");
  EXPECT_NE(log.find(std::string("miss of the curve ") + text), std::string::npos) << log;
  EXPECT_NE(log.find(std::string("miss of the curve"), log.find("calibrated on")), std::string::npos) << log;
  const auto row = log.find("miss of the curve", log.find("calibrated on"));
  EXPECT_NE(log.substr(row, log.find('\n', row) - row).find(text), std::string::npos) << log.substr(row, 120);
}

TEST_F(CalibrateApp, what_is_out_of_reach_is_told_with_the_nearest) {
  const auto s =
      run({"Calibrate/Poisson ratio = 0.45", "Calibrate/Seeds = 1", "Calibrate/Verification seeds = 0"}, "a");
  ASSERT_EQ(s["missed"].size(), 1u);
  EXPECT_NE(s["missed"][0].get<std::string>().find("out of reach"), std::string::npos);
  EXPECT_NEAR(s["found"]["stiffness_ratio"].get<double>(), 0.02, 1e-9);
  ASSERT_EQ(s["at_bounds"].size(), 1u);
  ASSERT_EQ(s["targets_missed"].size(), 1u);
  const std::string gap = s["targets_missed"][0].get<std::string>();
  EXPECT_EQ(gap.rfind("Poisson's ratio: target 0.45, calibrated 0.", 0), 0u) << gap;
  EXPECT_NE(gap.find(", off by -"), std::string::npos) << gap;
}

// One bond strength that is not free, and a target that is four times what it gives.
TEST_F(CalibrateApp, a_target_missed_by_a_factor_is_told_as_one) {
  const std::vector<std::string> asked{"Calibrate/Seeds = 1", "Calibrate/Verification seeds = 1",
                                       "Calibrate/Free = modulus", "Calibrate/Most trials = 1"};
  const auto with = [&](const std::string &entry) {
    std::vector<std::string> all = asked;
    all.push_back(entry);
    return all;
  };
  const auto first = run(with("Calibrate/Compressive strength = 1 GPa"), "a");
  const double bears = first["verification"]["compressive_strength_pa"]["mean"].get<double>();
  const auto s = run(with("Calibrate/Compressive strength = " + std::to_string(4 * bears)), "b");
  ASSERT_EQ(s["targets_missed"].size(), 1u);
  const std::string gap = s["targets_missed"][0].get<std::string>();
  EXPECT_NE(gap.find("off by -75 % (a factor of 4), tolerance 2 %"), std::string::npos) << gap;
}

// A run that is believed on --resume is one that was written so.
TEST_F(CalibrateApp, a_resumed_one_makes_again_what_was_edited) {
  const std::vector<std::string> asked{"Calibrate/Seeds = 2", "Calibrate/Verification seeds = 0",
                                       "Calibrate/Most trials = 1",
                                       "Calibrate/Compressive strength = 40 MPa"};
  const auto whole = run(asked, "a");
  EXPECT_EQ(whole["trials"], 4); // a run and a static solve on each packing
  EXPECT_EQ(run(asked, "a", true)["trials"], 2);
  std::ofstream(folder / "a/runs/trial_1_compressive_strength_pa_seed_5/scene.prm", std::ios::app)
      << "# more\n";
  const auto again = run(asked, "a", true);
  EXPECT_EQ(again["trials"], 3);
  EXPECT_EQ(again["training"], whole["training"]);
  EXPECT_NE(text_of(folder / "a/run.log").find("trial_1_compressive_strength_pa_seed_5: is made again"),
            std::string::npos);
}

// Every kind of target on one packing, and one more that judges; what they are is measured, not met.
TEST_F(CalibrateApp, every_kind_of_target_is_measured) {
  std::ofstream(folder / "curve.csv") << "strain_platen,stress_mpa\n0.001,15\n0.002,28\n0.003,30\n";
  std::vector<std::string> asked{"Calibrate/Seeds = 1",
                                 "Calibrate/Verification seeds = 1",
                                 "Calibrate/Most trials = 1",
                                 "Calibrate/Free = modulus, tensile strength",
                                 "Scene/Seed = 7",
                                 "Calibrate/Curve 2 = " + (folder / "curve.csv").string()};
  const std::string box =
      "Specimen/Shape = box, Specimen/Radius =, Specimen/Width x = 16 mm, Specimen/Width y "
      "= 16 mm, Specimen/Height = 16 mm, Loading/Axial rate = 0.03 m/s, Loading/Target strain = 0.05";
  // Between dry platens the pieces of so small a cylinder are locked and bear most after they have come
  // loose, when the pressure no longer acts on the side: no strength.
  const std::string cell =
      "Loading/Confinement = particles, Loading/Confining pressure = 4 MPa, Platens/Friction static = 0";
  const std::vector<std::string> targets{"young modulus: 20 GPa",
                                         "poisson ratio: 0.2",
                                         "strength_pa at Platens/Surface = grease: 40 MPa",
                                         "strain_at_peak_platen: 2.4 mm/m +- 10 %",
                                         "tension: 4 MPa",
                                         "splitting at Platens/Friction static = 0.3: 4 MPa",
                                         "strength_pa at " + cell + ": 60 MPa",
                                         "strength_pa at " + box + " over Platens/Friction static = 0: 1.4",
                                         "poisson_ratio: 0.2",
                                         "curve 2: +- 10 %"};
  for (std::size_t k = 0; k < targets.size(); ++k)
    asked.push_back("Calibrate/Target " + std::to_string(k + 1) + " = " + targets[k]);
  const auto s = run(asked, "a");
  ASSERT_EQ(s["targets"].size(), targets.size());
  EXPECT_EQ(s["failed_trials"], 0) << text_of(folder / "a/trials.csv");
  const auto number = [&](const char *key) { return s["training"][key]["mean"].get<double>(); };
  EXPECT_NEAR(number("youngs_modulus_gauge_pa"), 20e9, 0.001 * 20e9); // solves have met it before
  EXPECT_GT(number("compressive_strength_pa"), 5 * number("tensile_strength_pa"));
  EXPECT_GT(number("splitting_strength_pa"), 0.5 * number("tensile_strength_pa"));
  // So small a disc is seated over half its width and bears more.
  EXPECT_LT(number("splitting_strength_pa"), 6 * number("tensile_strength_pa"));
  EXPECT_GT(number("triaxial_strength_pa"), number("compressive_strength_pa") + 1.5 * 4e6);
  EXPECT_GT(number("strength_pa_ratio"), 1.1);
  EXPECT_GT(number("secant_poisson_ratio"), number("poisson_ratio")); // bonds have broken on the way
  EXPECT_LT(number("secant_poisson_ratio"), 1);
  EXPECT_GT(number("strain_at_peak_platen"), 5e-4);
  EXPECT_GT(number("curve_miss"), 0);
  EXPECT_LT(number("curve_miss"), 1);
  EXPECT_EQ(s["verification"]["strength_pa_ratio"]["seeds"], 1);
  EXPECT_EQ(s["sensitivities"].size(), 2u);
  EXPECT_EQ(s["sensitivities"][0]["parameter"], "bond_modulus_pa");
  EXPECT_NEAR(s["sensitivities"][0]["youngs_modulus_gauge_pa"].get<double>(), 1, 1e-6);
  EXPECT_EQ(s["correlations"][1]["bond_tensile_strength_pa"], 1);
  EXPECT_FALSE(s["missed"].empty());
  const std::string found = text_of(folder / "a/found.prm"), curve = text_of(folder / "a/curve.csv");
  EXPECT_EQ(curve.rfind("strain_platen,wanted_pa,calibrated_pa,unseen_pa\n", 0), 0u);
  // The figures of a run are those of the run itself: platen-compress between greased platens.
  const auto grease =
      nlohmann::json::parse(text_of(folder / "a/runs/trial_1_compressive_strength_pa_seed_7/summary.json"));
  EXPECT_EQ(grease["strength_pa"], number("compressive_strength_pa"));
  // And the same again.
  run(asked, "a", true);
  EXPECT_EQ(text_of(folder / "a/found.prm"), found);
  EXPECT_EQ(text_of(folder / "a/curve.csv"), curve);
}

// What nobody has foreseen: any number of the scene, by any number of summary.json.
TEST_F(CalibrateApp, any_entry_is_tried_for_any_figure) {
  const auto s = run({"Calibrate/Seeds = 1", "Calibrate/Verification seeds = 0", "Calibrate/Most trials = 2",
                      "Calibrate/Target 1 = middle_damage at Loading/Target strain = 0.01: 0.5",
                      "Calibrate/Parameter 1 = Contact/Damping: 0 ... 0.5", "Contact/Damping = 0.1"},
                     "a");
  const auto tried = [&](int trial) {
    const fs::path run = folder / "a/runs" / ("trial_" + std::to_string(trial) + "_middle_damage_seed_4");
    const Scene scene = read_scene((run / "scene.prm").string(), {}, program("compress"));
    EXPECT_EQ(scene.loading.target_strain, 0.01);
    return std::pair<double, double>(scene.contact.damping,
                                     nlohmann::json::parse(text_of(run / "summary.json"))["middle_damage"]);
  };
  EXPECT_EQ(tried(1).first, 0.1);
  EXPECT_GT(tried(2).first, 0.1); // away from the nearer bound: sensitivities are measured
  const double found = s["found"]["Contact_Damping"], damage = s["training"]["middle_damage"]["mean"];
  EXPECT_TRUE((tried(1) == std::pair{found, damage}) || (tried(2) == std::pair{found, damage}));
  EXPECT_NE(text_of(folder / "a/trials.csv").find(",Contact_Damping,status,"), std::string::npos);
}

// From bonds that are off by a third to those that the targets were measured of.
TEST_F(CalibrateApp, bonds_that_yield_are_found_by_what_they_gave) {
  std::vector<std::string> law{"Effects/Bond = yielding parallel bond",
                               "Bond/Friction angle = 27 degree",
                               "Bond/Compression limits = 60 MPa, 110 MPa, 160 MPa",
                               "Bond/Compression slopes = 3, 12, 22",
                               "Calibrate/Seeds = 1",
                               "Calibrate/Verification seeds = 0"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), law.begin(), law.end());
    return more;
  };
  const auto known = run(with({"Calibrate/Most trials = 1", "Calibrate/Compressive strength = 40 MPa",
                               "Calibrate/Tensile strength = 4 MPa"}),
                         "known");
  const auto wanted = [&](const char *entry, const char *key, const char *unit) {
    return std::string("Calibrate/") + entry + " = " +
           std::to_string(known["training"][key]["mean"].get<double>()) + unit;
  };
  const auto s =
      run(with({wanted("Young modulus", "youngs_modulus_gauge_pa", " Pa"),
                wanted("Compressive strength", "compressive_strength_pa", " Pa"),
                wanted("Tensile strength", "tensile_strength_pa", " Pa"), "Bond/Modulus = 25 GPa",
                "Bond/Tensile strength = 7 MPa", "Bond/Shear strength = 38 MPa", "Calibrate/Differences = on",
                "Calibrate/Free = modulus, tensile strength, shear strength", "Calibrate/Most trials = 12"}),
          "found");
  EXPECT_TRUE(s["missed"].empty()) << s["missed"];
  EXPECT_NEAR(s["found"]["bond_modulus_pa"].get<double>(), 36e9, 0.03 * 36e9);
  EXPECT_NEAR(s["found"]["bond_tensile_strength_pa"].get<double>(), 9.5e6, 0.06 * 9.5e6);
  EXPECT_GT(s["sensitivities"][1]["tensile_strength_pa"].get<double>(), 0.7);
  EXPECT_LT(std::abs(s["sensitivities"][2]["tensile_strength_pa"].get<double>()), 0.3);
}

TEST_F(CalibrateApp, faults_are_refused) {
  EXPECT_NE(fault({}).find("Calibrate/Mode = search has nothing to search for"), std::string::npos);
  EXPECT_NE(fault({"Calibrate/Young modulus = 5 m"}).find("Calibrate/Young modulus"), std::string::npos);
  EXPECT_NE(fault({"Calibrate/Poisson ratio = 0.2", "Calibrate/Smallest stiffness ratio = 2"})
                .find("is not below Calibrate/Largest stiffness ratio"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Tensile strength = 3 MPa", "Bond/Tensile strength = unbreakable"})
                .find("is no number that the search"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Tensile strength = 3 MPa", "Calibrate/Compressive strength = 2 MPa"})
                .find("is not below Calibrate/Compressive strength"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Mode = abacus", "Calibrate/Poisson ratio list = 0.2"}).find("is for beams"),
            std::string::npos);
  EXPECT_NE(fault({"Effects/Bond = none", "Calibrate/Mode = bounds"}).find("Effects/Bond"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Compressive strength = 20 MPa", "Calibrate/Triaxial strength = 30 MPa"})
                .find("Calibrate/Confining pressure"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Triaxial strength = 30 MPa", "Calibrate/Confining pressure = 2 MPa"})
                .find("needs Calibrate/Compressive strength"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Tensile strength = 3 MPa", "Calibrate/Largest friction angle = 30 degree"})
                .find("below the bond's own"),
            std::string::npos);
  EXPECT_NE(fault({"Calibrate/Tensile strength = 3 MPa", "Effects/Bond = elasto damage plastic",
                   "Calibrate/Largest friction angle = 60 degree"})
                .find("needs a bond with a friction angle"),
            std::string::npos);
  EXPECT_EQ(fault({"Calibrate/Mode = bounds", "Loading/Axial rate ="}), "");
  // What only a test shows is refused before anything is written.
  const std::string curve = "Calibrate/Curve 1 = " + (folder / "case.prm").string();
  for (const std::vector<std::string> &entries : std::vector<std::vector<std::string>>{
           {"Calibrate/Target 1 = curve 1", curve},
           {"Calibrate/Compressive strength = 20 MPa", "Loading/Axial rate ="},
           {"Calibrate/Target 1 = strength_pa at Loading/Confining pressure = 4 MPa: 50 MPa"},
           {"Calibrate/Target 1 = strength_pa at Specimen/Hight = 4 mm: 50 MPa"}})
    EXPECT_THROW(run(entries, "a"), InputError) << entries[0];
  EXPECT_FALSE(fs::exists(folder / "a"));
  // Tests with speeds of their own need no other.
  CommandLine dry;
  dry.scene = (folder / "case.prm").string(), dry.dry_run = true;
  dry.overrides = {"Calibrate/Target 1 = strength_pa at Loading/Axial rate = 0.02 m/s: 50 MPa",
                   "Calibrate/Tensile strength = 4 MPa", "Calibrate/Tension rate = 0.01 m/s",
                   "Loading/Axial rate ="};
  EXPECT_EQ(run_calibrate(dry, read(dry.overrides)), status_done);
}

} // namespace
} // namespace platen::apps
