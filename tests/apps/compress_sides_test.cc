// Specimens pressed from the side, in a cell and between four and six platens, as a user runs them: what they
// measure, tell and refuse.
#include <algorithm>
#include <cmath>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Cell : public Crushed {};

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
  const nlohmann::json s =
      crush("path", {"Loading/Confinement = particles", "Loading/Confining pressure = 3 MPa",
                     "Loading/Pressure path = -0.333", "Loading/Target strain = 0.002"});
  EXPECT_GT(s["pressure_path_deviation"], 0);
  EXPECT_LT(s["pressure_path_deviation"], 0.05); // thirty times the speed of a laboratory's scene
  const double ended = s["pressure_path_ended_at_strain"];
  // Three times the pressure as a deviator, of a specimen with E of 11 to 20 GPa between soft ends.
  EXPECT_GT(ended, 9e6 / 20e9);
  EXPECT_LT(ended, 9e6 / 5e9);
  const auto pressure = column("path", "confining_pressure_pa");
  EXPECT_EQ(*std::min_element(pressure.begin() + static_cast<long>(pressure.size()) / 2, pressure.end()), 0);
  EXPECT_TRUE(contains(outcome_.error, "from there on the test goes along no path"));
  EXPECT_EQ(s["validity"]["youngs_modulus_gauge_pa"][0],
            "the pressure changes along its path: the ratio of stress and strain is no Young's modulus");
}

TEST_F(Cell, unconfined_runs_have_no_column_of_it) {
  EXPECT_TRUE(crush("bare", {"Loading/Target strain = 0.001"})["consolidation_end_time_s"].is_null());
  const std::string header = content_of(folder_ / "bare/history.csv").substr(0, 900);
  EXPECT_FALSE(contains(header, "deviator_pa"));
  EXPECT_FALSE(contains(header, "opening_m"));
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
  const Words both{"Loading/Confinement = particles", "Output/Every = 100"};
  const Words keys = with(both, {"Loading/Confining pressure = 3 MPa", "Loading/Target strain = 0.003",
                                 "Loading/Unload at = 0.001", "Loading/Unload to = 0.2"}),
              stages =
                  with(both, {"Loading/Stage 1/Lateral = pressure 3 MPa",
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
  const Words entries{"Loading/Stop at residual = 0",
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
    const std::string text = log(name);
    std::vector<std::string> lines;
    for (std::size_t at = 0; (at = text.find("stage 1 did not settle", at)) != std::string::npos; ++at)
      lines.push_back(text.substr(at, text.find('\n', at) - at));
    return lines;
  };
  const std::vector<std::string> lines = told("hasty");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_TRUE(contains(lines[0], "in its time: top "));
  EXPECT_TRUE(contains(lines[0], " of 3 MPa"));
  EXPECT_EQ(lines[0], lines[1]);
  EXPECT_FALSE(contains(log("hasty"), "stage 2 did"));

  EXPECT_EQ(stop_at("stopped", 20, SIGTERM, entries), 143);
  const nlohmann::json part = summary_in(folder_ / "stopped");
  EXPECT_EQ(part["stages"][0]["ended_by"], "not settled");
  EXPECT_EQ(part["stages"].back()["ended_by"], "stopped");
  crush("stopped", entries, {"--resume"});
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

class Sides : public Crushed {
protected:
  Sides() : Crushed("held.prm") {}
  double last(const std::string &name, const std::string &of) const { return column(name, of).back(); }
  double axial(const std::string &name) const {
    return 0.5 * (last(name, "axial_stress_top_pa") + last(name, "axial_stress_bottom_pa"));
  }
  double over_axial(const std::string &name, const std::string &side) const {
    return last(name, "stress_" + side + "_pa") / axial(name);
  }
  std::string header(const std::string &name) const {
    const std::string all = content_of(folder_ / name / "history.csv");
    return all.substr(0, all.find('\n'));
  }
};

// Held sides are a stiff ring: lateral over axial stress is what the wall of a uniaxial strain test bears,
// and nu / (1 - nu); with one pair of sides free, nu. The gauge's nu is of the middle half alone, in a box of
// 16 radii larger than that of the whole: of eight packings the ratios are 0.90 and 0.93, each within 8 %.
TEST_F(Sides, held_sides_bear_what_a_stiff_wall_bears) {
  const nlohmann::json six = crush("six", {}),
                       wall = crush("wall", {"Platens/Sides = two", "Loading/Test = uniaxial strain"}),
                       bare = crush("bare", {"Platens/Sides = two"});
  crush("four_x", {"Platens/Sides = four x"});
  double mean = 0;
  for (const char *side : {"left", "right", "front", "back"})
    mean += 0.25 * over_axial("six", side);
  EXPECT_NEAR(mean / (last("wall", "confining_pressure_pa") / axial("wall")), 1, 0.02);
  EXPECT_NEAR(axial("six") / axial("wall"), 1, 0.01);
  const double nu = bare["poisson_ratio"];
  EXPECT_NEAR(mean / (nu / (1 - nu)), 0.90, 0.08);
  EXPECT_NEAR(0.5 * (over_axial("four_x", "left") + over_axial("four_x", "right")) / nu, 0.93, 0.08);
  // Smooth and at rest: opposite ones bear the same.
  EXPECT_NEAR(over_axial("six", "left") / over_axial("six", "right"), 1, 0.01);
  EXPECT_NEAR(over_axial("six", "front") / over_axial("six", "back"), 1, 0.01);
  EXPECT_EQ(last("six", "strain_x"), 0);
  EXPECT_EQ(last("six", "strain_y"), 0);
  EXPECT_LT(six["energy_residual_relative"], 1e-5);
  // Neither is measured where sides are held.
  EXPECT_TRUE(six["youngs_modulus_gauge_pa"].is_null());
  EXPECT_TRUE(six["poisson_ratio"].is_null());
  EXPECT_EQ(six["loaded_axis"], "z");
  EXPECT_TRUE(six["side_stress_at_peak_pa"].is_null()); // it ends while the stress rises
  EXPECT_EQ(six["validity"]["youngs_modulus_gauge_pa"][0],
            "platens hold the sides: the ratio of stress and strain is no Young's modulus");
  EXPECT_GT(six["seated_sides"]["back"], 20);
  for (const nlohmann::json &two : {wall, bare}) {
    EXPECT_FALSE(two.contains("side_stress_at_peak_pa"));
    EXPECT_FALSE(two.contains("seated_sides"));
  }
}

TEST_F(Sides, columns_are_there_where_platens_are) {
  const auto sides = [&](const std::string &word) {
    const Words entries{"Loading/Target strain = 0.0002", "Platens/Sides = " + word};
    const nlohmann::json s = crush(word, entries);
    EXPECT_TRUE(s["consolidation_end_time_s"].is_null());
    for (const char *of_sides : {"side_stress_at_peak_pa", "seated_sides"})
      EXPECT_EQ(s.contains(of_sides), word != "two") << of_sides;
    return header(word);
  };
  const std::string common =
      "time_s,axial_strain_platen,axial_strain_gauge,lateral_strain,volumetric_strain,axial_stress_top_pa,"
      "axial_"
      "stress_bottom_pa,confining_pressure_pa,intact_bonds,broken_tension,broken_shear,kinetic_energy_j,bond_"
      "energy_j,contact_energy_j,body_energy_j,damping_work_j,friction_work_j,fracture_work_j,boundary_work_"
      "j,"
      "energy_residual_j,unbalanced_force_ratio,lateral_strain_extremal,axial_strain_extremal,platen_speed_m_"
      "s,time_"
      "step_s,grain_contacts,plastic_work_j";
  EXPECT_EQ(sides("two"), common);
  const std::string ends = ",friction_work_top_j,friction_work_bottom_j";
  EXPECT_EQ(sides("four x"), common + ",stress_left_pa,stress_right_pa,strain_x" + ends +
                                 ",friction_work_left_j,friction_work_right_j");
  EXPECT_EQ(sides("four y"), common + ",stress_front_pa,stress_back_pa,strain_y" + ends +
                                 ",friction_work_front_j,friction_work_back_j");
  EXPECT_EQ(sides("six"),
            common + ",stress_left_pa,stress_right_pa,stress_front_pa,stress_back_pa,strain_x,strain_y" +
                ends +
                ",friction_work_left_j,friction_work_right_j,friction_work_front_j,friction_work_"
                "back_j");
}

// Without grain contacts all friction is that of platens: the whole is the sum of its parts. A rough side
// turns the shortening specimen's skin back, a smooth one does no work.
TEST_F(Sides, friction_is_told_by_platen) {
  crush("rough", {"Effects/Contact = none", "Effects/Tangential = none", "Platens/Friction static = 0.05",
                  "Platens/Friction dynamic = 0.05", "Platens/Back/Friction static = 0",
                  "Platens/Back/Friction dynamic = 0"});
  double sum = 0;
  for (const char *side : {"top", "bottom", "left", "right", "front", "back"})
    sum += last("rough", std::string("friction_work_") + side + "_j");
  EXPECT_NEAR(sum / last("rough", "friction_work_j"), 1, 1e-12);
  for (const char *side : {"left", "right", "front"})
    EXPECT_GT(last("rough", std::string("friction_work_") + side + "_j"), 0) << side;
  EXPECT_EQ(last("rough", "friction_work_back_j"), 0);
}

TEST_F(Sides, frames_hold_all_platens_and_the_start_tells_them) {
  crush("six", {"Output/Fields = on", "Loading/Target strain = 0.0001", "Platens/Left/Surface = grease"});
  const std::string list = content_of(folder_ / "six/platens.pvd");
  for (int part = 0; part < 6; ++part)
    EXPECT_TRUE(contains(list, "platens_00000" + std::to_string(part))) << part;
  EXPECT_TRUE(contains(outcome_.out, "seated spheres: bottom "));
  EXPECT_TRUE(contains(outcome_.out, ", back "));
  EXPECT_TRUE(contains(outcome_.out, "  top, bottom, right, front, back platens: custom, friction 0 static"));
  EXPECT_TRUE(contains(outcome_.out, "  left platen: grease, friction 0.0048 static"));
}

// The platens of the sides crush the box between top and bottom that bear a stress.
TEST_F(Sides, strength_follows_the_axis_that_stages_drive) {
  const nlohmann::json s = crush(
      "across", {"Bond/Tensile strength = 6 MPa", "Bond/Shear strength = 15 MPa",
                 "Loading/Stop at residual = 0.75", "Loading/Stage 1/Axial = stress 1 MPa",
                 "Loading/Stage 1/Lateral = stress 1 MPa", "Loading/Stage 1/Until = settled",
                 "Loading/Stage 2/Lateral x = rate", "Loading/Stage 2/Axial = stress 1 MPa",
                 "Loading/Stage 2/Lateral y = stress 1 MPa", "Loading/Stage 2/Until = Lateral x strain 3 %"});
  const auto column = [&](const char *name) { return Crushed::column("across", name); };
  const std::vector<double> stage = column("stage"), left = column("stress_left_pa"),
                            right = column("stress_right_pa"), strain = column("strain_x"),
                            top = column("axial_stress_top_pa");
  std::size_t peak = 0, zero = 0;
  for (std::size_t k = 0; k < stage.size(); ++k) {
    if (stage[k] == 1) zero = peak = k;
    if (left[k] + right[k] > left[peak] + right[peak]) peak = k;
  }
  EXPECT_EQ(s["loaded_axis"], "x");
  EXPECT_EQ(s["strength_pa"], 0.5 * (left[peak] + right[peak]));
  EXPECT_GT(s["strength_pa"], 10e6);
  EXPECT_EQ(s["strain_at_peak_platen"], strain[peak] - strain[zero]);
  EXPECT_EQ(s["side_stress_at_peak_pa"]["top"], top[peak]);
  EXPECT_FALSE(s["side_stress_at_peak_pa"].contains("left"));
  EXPECT_EQ(s["stages"][1]["ended_by"], "stop at residual");
  EXPECT_EQ(s["stages"][1]["stress_x_pa"], 0.5 * (left.back() + right.back()));
  EXPECT_EQ(s["stages"][1]["strain_x"], strain.back());
  EXPECT_LT(left.back() + right.back(), 2 * 0.75 * s["strength_pa"].get<double>());
  for (const char *key : {"cone_top", "cone_bottom", "pattern", "end_damage_top", "middle_damage",
                          "end_spread", "barrel_at_peak", "strain_at_peak_gauge", "final_end_damage_top"})
    EXPECT_TRUE(s[key].is_null()) << key;
}

// What the packed shape and the library decide is told by file, line, key and value too.
TEST_F(Sides, what_the_library_refuses_is_told_by_key) {
  const auto refuses = [&](const Words &entries, const std::string &says) {
    const Outcome outcome = run_compress(arguments("refused", entries), folder_);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_TRUE(contains(outcome.error, says));
    EXPECT_FALSE(fs::exists(folder_ / "refused"));
  };
  refuses(
      {"Platens/Edge gap = 4 mm"},
      "command line, --set 2: error: Platens/Edge gap = 4 mm leaves too little of a platen. Allowed: up to "
      "0.0035 m, a quarter");
  put(folder_ / "round.csv",
      "x_m,y_m,z_m,radius_m\n0,0,0.001,0.001\n0.0021,0,0.001,0.001\n"
      "-0.0021,0,0.001,0.001\n0,0.0021,0.001,0.001\n");
  refuses({"Specimen/Packing = file", "Specimen/File = " + (folder_ / "round.csv").string(),
           "Specimen/Shape = cylinder", "Specimen/Width x =", "Specimen/Width y =", "Specimen/Radius = 4 mm",
           "Specimen/Height = 2 mm"},
          "Platens/Sides = six presses a flat side. Allowed: a specimen that is a box.");
}

} // namespace
} // namespace platen::apps::testing
