// Tests in a cell: strength grows with the pressure, the energy balance closes, and a stopped run repeats.
#include <signal.h>

#include <algorithm>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Cell : public Crushed {
protected:
  std::vector<double> column(const std::string &name, const std::string &column) const {
    return column_of(folder_ / name / "history.csv", column);
  }
};

TEST_F(Cell, strength_grows_with_the_confining_pressure) {
  const auto confined = [&](const std::string &name, const std::string &pressure) {
    return crush(name, {"Loading/Confinement = particles", "Loading/Confining pressure = " + pressure,
                        "Loading/Target strain = 0.01"});
  };
  const nlohmann::json bare = crush("bare", {"Loading/Target strain = 0.01"}), low = confined("low", "2 MPa"),
                       high = confined("high", "6 MPa");
  // A unit of pressure adds several units of strength to a brittle material (Richart: 4.1 in concrete); what
  // must not be is less than that unit itself.
  EXPECT_GT(low["strength_pa"].get<double>(), bare["strength_pa"].get<double>() + 2 * 2e6);
  EXPECT_GT(high["strength_pa"].get<double>(), low["strength_pa"].get<double>() + 2 * 4e6);
  EXPECT_GT(high["strain_at_peak_platen"], bare["strain_at_peak_platen"]);
  // The elastic part does not feel the pressure: strains are counted from the end of the hydrostatic stage.
  EXPECT_NEAR(high["youngs_modulus_gauge_pa"].get<double>() / bare["youngs_modulus_gauge_pa"].get<double>(),
              1, 0.05);
  EXPECT_FALSE(bare.contains("confining_pressure_pa"));
  for (const nlohmann::json &s : {low, high}) {
    EXPECT_NEAR(s["strength_pa"].get<double>(),
                s["deviator_strength_pa"].get<double>() + s["confining_pressure_pa"].get<double>(), 1);
    // Through crushing; 1 % is what the program promises, and pressure adds no error of its own.
    EXPECT_LT(s["energy_residual_relative"], 0.01);
  }
  const auto pressure = column("high", "confining_pressure_pa"), deviator = column("high", "deviator_pa"),
             top = column("high", "axial_stress_top_pa"), bottom = column("high", "axial_stress_bottom_pa");
  EXPECT_EQ(pressure.front(), 0);
  // Spheres that have come loose take their share of the pressure along.
  const auto share = column("high", "confined_area_share");
  EXPECT_EQ(*std::max_element(pressure.begin(), pressure.end()), 6e6);
  EXPECT_NEAR(pressure.back(), 6e6 * share.back(), 1);
  EXPECT_GT(share.back(), 0.5);
  for (std::size_t k = 0; k < pressure.size(); ++k)
    ASSERT_NEAR(deviator[k], 0.5 * (top[k] + bottom[k]) - pressure[k], 1e-3);
}

// The cell alone closes the specimen by more than the target: that is consolidation, and the axial test comes
// after it. Turns of the platens are counted alike.
TEST_F(Cell, the_target_strain_is_counted_from_the_end_of_the_hydrostatic_stage) {
  const nlohmann::json s =
      crush("deep", {"Loading/Confinement = particles", "Loading/Confining pressure = 20 MPa",
                     "Loading/Target strain = 0.001", "Loading/Unload at = 0.0005", "Loading/Unload to = 0.5",
                     "Bond/Tensile strength = unbreakable", "Bond/Shear strength = unbreakable"});
  const auto closure = column("deep", "axial_strain_platen"), deviator = column("deep", "deviator_pa"),
             pressure = column("deep", "confining_pressure_pa");
  // The last row near the 1 % of the pressure at which the platens take over.
  std::size_t stood = 0;
  for (std::size_t k = 0; k < closure.size() && deviator[k] < 1e6; ++k)
    if (deviator[k] < 0.02 * 20e6) stood = k;
  ASSERT_EQ(pressure[stood], 20e6);
  EXPECT_GT(closure[stood], 0.001);
  EXPECT_NEAR(closure.back() - closure[stood], 0.001, 0.0001); // a row closes by a thirtieth
  EXPECT_GT(*std::max_element(deviator.begin(), deviator.end()), 0.001 * 5e9);
  EXPECT_TRUE(s["deviator_strength_pa"].is_null()); // bonds that never break, and unloading is no peak
  const auto time = column("deep", "time_s");
  const double end = s["consolidation_end_time_s"].get<double>();
  const auto zero = static_cast<std::size_t>(std::find(time.begin(), time.end(), end) - time.begin());
  ASSERT_LT(zero + 1, time.size()); // a row of the table, the last before the platens take over
  EXPECT_GT(pressure[zero], 0.95 * 20e6);
  EXPECT_EQ(pressure[zero + 1], 20e6);
  EXPECT_LE(zero, stood);
  std::size_t turn = stood;
  while (turn + 1 < deviator.size() && deviator[turn + 1] > deviator[turn] - 0.01e6)
    ++turn;
  ASSERT_LT(turn + 1, deviator.size()); // unloaded
  // It slows down by the ramp, ten wave crossings.
  EXPECT_NEAR(closure[turn] - closure[stood], 0.0005, 0.0004);
  EXPECT_GT(closure[turn] - closure[stood], 0.00045);
}

TEST_F(Cell, a_stress_path_tells_how_well_it_held_and_where_it_ended) {
  const Outcome outcome =
      run_compress({test_scene("crushed.prm"), "-o", "path", "-s", "Output/Fields = off", "-s",
                    "Loading/Confinement = particles", "-s", "Loading/Confining pressure = 3 MPa", "-s",
                    "Loading/Pressure path = -0.333", "-s", "Loading/Target strain = 0.002"},
                   folder_);
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const nlohmann::json s = summary_in(folder_ / "path");
  EXPECT_GT(s["pressure_path_deviation"], 0);
  EXPECT_LT(s["pressure_path_deviation"], 0.05); // thirty times the speed of a laboratory's scene
  const double ended = s["pressure_path_ended_at_strain"];
  // Three times the pressure as a deviator, of a specimen with E of 11 to 20 GPa between soft ends.
  EXPECT_GT(ended, 9e6 / 20e9);
  EXPECT_LT(ended, 9e6 / 5e9);
  const auto pressure = column("path", "confining_pressure_pa");
  EXPECT_EQ(*std::min_element(pressure.begin() + static_cast<long>(pressure.size()) / 2, pressure.end()), 0);
  EXPECT_TRUE(contains(outcome.error, "from there on the test goes along no path")) << outcome.error;
  EXPECT_EQ(s["validity"]["youngs_modulus_gauge_pa"][0],
            "the pressure changes along its path: the ratio of stress and strain is no Young's modulus");
}

TEST_F(Cell, unconfined_runs_have_no_column_of_it) {
  EXPECT_TRUE(crush("bare", {"Loading/Target strain = 0.001"})["consolidation_end_time_s"].is_null());
  const std::string header = content_of(folder_ / "bare/history.csv").substr(0, 900);
  EXPECT_FALSE(contains(header, "deviator_pa"));
  EXPECT_FALSE(contains(header, "opening_m"));
}

// Areas, ramp, servo, turns of the platens: all in the checkpoint. Stopped in the hydrostatic stage and again
// when bonds have broken and the platens turn round.
TEST_F(Cell, a_stopped_run_ends_as_if_it_had_not_been) {
  const std::vector<std::string> entries{"Loading/Confinement = particles",
                                         "Loading/Confining pressure = 3 MPa", "Loading/Unload at = 0.003",
                                         "Loading/Unload to = 0.3"};
  std::vector<std::string> options{test_scene("crushed.prm")};
  for (const std::string &entry : entries)
    options.insert(options.end(), {"-s", entry});
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all = options;
    all.insert(all.end(), more.begin(), more.end());
    all.emplace_back("--quiet");
    return all;
  };
  const Outcome whole = run_compress(with({"-o", "whole", "-t", "2"}), folder_);
  ASSERT_EQ(whole.status, 0) << whole.error;
  EXPECT_GT(summary_in(folder_ / "whole")["broken_tension"], 300);
  const auto stop_at = [&](long rows, std::vector<std::string> more) {
    Program program(compress_command(with(std::move(more))), folder_);
    EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= rows; }));
    program.send(SIGTERM);
    EXPECT_EQ(program.wait(), 143);
  };
  stop_at(10, {"-o", "stopped", "-t", "1"});
  stop_at(130, {"-o", "stopped", "-t", "2", "--resume"});
  const Outcome last = run_compress(with({"-o", "stopped", "-t", "1", "--resume"}), folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
}

TEST_F(Cell, a_wall_measures_what_it_holds) {
  const nlohmann::json s =
      crush("wall", {"Loading/Test = uniaxial strain", "Bond/Tensile strength = unbreakable",
                     "Bond/Shear strength = unbreakable", "Loading/Target strain = 0.002"});
  EXPECT_EQ(s["test"], "uniaxial strain");
  EXPECT_TRUE(s["youngs_modulus_gauge_pa"].is_null());
  EXPECT_GT(s["constrained_modulus_pa"], 0);
  EXPECT_GT(s["lateral_over_axial_stress"], 0.05);
  EXPECT_LT(s["lateral_over_axial_stress"], 0.5);
  EXPECT_LT(s["energy_residual_relative"], 1e-3);
}

// What the keys of a cell and of a turn stand for, written as stages: the same bytes.
TEST_F(Cell, stages_are_what_the_keys_mean) {
  const std::vector<std::string> both{"Loading/Confinement = particles", "Output/Every = 100"};
  std::vector<std::string> keys = both, stages = both;
  keys.insert(keys.end(), {"Loading/Confining pressure = 3 MPa", "Loading/Target strain = 0.003",
                           "Loading/Unload at = 0.001", "Loading/Unload to = 0.2"});
  stages.insert(stages.end(), {"Loading/Stage 1/Lateral = pressure 3 MPa",
                               "Loading/Stage 1/Top = stress 3 MPa", "Loading/Stage 1/Until = settled",
                               "Loading/Stage 2/Axial = rate", "Loading/Stage 2/Until = strain 0.1 %",
                               "Loading/Stage 3/Axial = unload", "Loading/Stage 3/Until = share of start 0.2",
                               "Loading/Stage 4/Axial = rate", "Loading/Stage 4/Until = strain 0.3 %"});
  const nlohmann::json by_keys = crush("keys", keys), by_stages = crush("stages", stages);
  EXPECT_EQ(by_keys["strength_pa"], by_stages["strength_pa"]);
  EXPECT_EQ(by_keys["steps"], by_stages["steps"]);
  for (const char *name : {"axial_strain_platen", "axial_stress_top_pa", "lateral_strain", "deviator_pa",
                           "kinetic_energy_j", "boundary_work_j", "energy_residual_j", "time_step_s"})
    EXPECT_EQ(column("keys", name), column("stages", name)) << name;
  ASSERT_EQ(by_stages["stages"].size(), 4u);
  EXPECT_FALSE(by_keys.contains("stages"));
  const std::vector<std::string> ends{"settled", "strain", "share of start", "strain"};
  for (std::size_t k = 0; k < ends.size(); ++k)
    EXPECT_EQ(by_stages["stages"][k]["ended_by"], ends[k]) << k;
  const std::vector<double> stage = column("stages", "stage");
  EXPECT_EQ(stage.front(), 1);
  EXPECT_EQ(stage.back(), 4);
}

// A ramp of a few wave crossings leaves no time: the run says so when it happens and at its end, and a run
// that was stopped between says the same.
TEST_F(Cell, a_stage_that_does_not_settle_is_told) {
  const std::vector<std::string> entries{"Loading/Stop at residual = 0",
                                         "Loading/Confinement = particles",
                                         "Loading/Stage 1/Lateral = pressure 3 MPa",
                                         "Loading/Stage 1/Top = stress 3 MPa",
                                         "Loading/Stage 1/Ramp = 3 us",
                                         "Loading/Stage 1/Until = settled",
                                         "Loading/Stage 2/Axial = rate",
                                         "Loading/Stage 2/Until = strain 0.3 %",
                                         "Loading/Stage 3/Axial = stress 3 MPa",
                                         "Loading/Stage 3/Until = time 10 us",
                                         "Checkpoint/Every = 100"};
  const nlohmann::json s = crush("hasty", entries);
  ASSERT_EQ(s["stages"].size(), 3u);
  EXPECT_EQ(s["stages"][0]["ended_by"], "not settled");
  EXPECT_EQ(s["stages"][1]["ended_by"], "strain");
  EXPECT_EQ(s["stages"][2]["ended_by"], "time");
  const auto told = [&](const std::string &name) {
    const std::string log = content_of(folder_ / name / "run.log");
    std::vector<std::string> lines;
    for (std::size_t at = 0; (at = log.find("stage 1 did not settle", at)) != std::string::npos; ++at)
      lines.push_back(log.substr(at, log.find('\n', at) - at));
    return lines;
  };
  const std::vector<std::string> lines = told("hasty");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(contains(lines[0], "in its time: top ")) << lines[0];
  EXPECT_TRUE(contains(lines[0], " of 3 MPa")) << lines[0];
  EXPECT_EQ(lines[0], lines[1]);
  EXPECT_FALSE(contains(content_of(folder_ / "hasty/run.log"), "stage 2 did"));

  std::vector<std::string> arguments{test_scene("crushed.prm"), "-o", "stopped", "-s", "Output/Fields = off"};
  for (const std::string &entry : entries)
    arguments.insert(arguments.end(), {"-s", entry});
  Program program(compress_command(arguments), folder_);
  EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= 20; }));
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), 143);
  const nlohmann::json part = summary_in(folder_ / "stopped");
  EXPECT_EQ(part["stages"][0]["ended_by"], "not settled");
  EXPECT_EQ(part["stages"].back()["ended_by"], "stopped");
  arguments.push_back("--resume");
  const Outcome rest = run_compress(arguments, folder_);
  EXPECT_EQ(rest.status, 0) << rest.error;
  EXPECT_EQ(summary_in(folder_ / "stopped")["stages"], s["stages"]);
  EXPECT_EQ(told("stopped"), (std::vector<std::string>{lines[0], lines[0], lines[0]}));
}

// Held between its own servo and the specimen: the stress stays, and what is loaded again climbs where it
// came down.
TEST_F(Cell, a_stress_is_held_by_a_stage) {
  const nlohmann::json s =
      crush("held", {"Output/Every = 50", "Bond/Tensile strength = 1 GPa", "Bond/Shear strength = 1 GPa",
                     "Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = Axial stress 10 MPa",
                     "Loading/Stage 2/Axial = stress 10 MPa", "Loading/Stage 2/Until = time 1 ms",
                     "Loading/Stage 3/Axial = unload", "Loading/Stage 3/Until = share of start 0.1"});
  const std::vector<double> stage = column("held", "stage"), stress = column("held", "axial_stress_top_pa"),
                            time = column("held", "time_s");
  double begun = 0;
  for (std::size_t k = 1; k < stage.size(); ++k) {
    if (stage[k] != stage[k - 1]) begun = time[k];
    if (stage[k] != 2 || time[k] < begun + 7e-4) continue;
    EXPECT_NEAR(stress[k], 10e6, 0.01 * 10e6) << time[k];
  }
  EXPECT_LT(stress.back(), 2.5e6); // the last row before a tenth
  EXPECT_GT(stress.back(), 0.5e6);
  EXPECT_EQ(s["stages"].size(), 3u);
}

} // namespace
} // namespace platen::apps::testing
