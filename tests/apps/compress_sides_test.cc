// Boxes between four and six platens as a user runs them: what they measure, what they refuse, what two
// platens keep.
#include <gtest/gtest.h>
#include <signal.h>

#include <cmath>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {
namespace {

class Sides : public ScratchFolder {
protected:
  std::vector<std::string> options(const std::vector<std::string> &entries) const {
    std::vector<std::string> all{test_scene("held.prm"), "--quiet"};
    for (const std::string &entry : entries)
      all.insert(all.end(), {"-s", entry});
    return all;
  }
  nlohmann::json press(const std::string &name, const std::vector<std::string> &entries) {
    std::vector<std::string> arguments = options(entries);
    arguments.insert(arguments.end(), {"-o", name, "-s", "Output/Fields = off"});
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 0) << outcome.error;
    return summary_in(folder_ / name);
  }
  double last(const std::string &name, const std::string &column) const {
    return column_of(folder_ / name / "history.csv", column).back();
  }
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
  const nlohmann::json six = press("six", {}),
                       wall = press("wall", {"Platens/Sides = two", "Loading/Test = uniaxial strain"}),
                       bare = press("bare", {"Platens/Sides = two"});
  press("four_x", {"Platens/Sides = four x"});
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
  const std::vector<std::string> quick{"Loading/Target strain = 0.0002"};
  const auto sides = [&](const std::string &word) {
    std::vector<std::string> entries = quick;
    entries.push_back("Platens/Sides = " + word);
    press(word, entries);
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
  press("rough", {"Effects/Contact = none", "Effects/Tangential = none", "Platens/Friction static = 0.05",
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

TEST_F(Sides, a_stopped_run_ends_as_if_it_had_not_been) {
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> all =
        options({"Platens/Friction static = 0.3", "Platens/Friction dynamic = 0.2"});
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  const Outcome whole = run_compress(with({"-o", "whole", "-t", "2"}), folder_);
  ASSERT_EQ(whole.status, 0) << whole.error;
  Program program(compress_command(with({"-o", "stopped", "-t", "1"})), folder_);
  EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= 20; }));
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), 143);
  const Outcome last = run_compress(with({"-o", "stopped", "-t", "1", "--resume"}), folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
}

TEST_F(Sides, frames_hold_all_platens_and_the_start_tells_them) {
  const Outcome outcome =
      run_compress({test_scene("held.prm"), "-o", "six", "-s", "Loading/Target strain = 0.0001", "-s",
                    "Platens/Left/Surface = grease"},
                   folder_);
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const std::string list = content_of(folder_ / "six/platens.pvd");
  for (int part = 0; part < 6; ++part)
    EXPECT_TRUE(contains(list, "platens_00000" + std::to_string(part))) << part;
  EXPECT_TRUE(contains(outcome.out, "seated spheres: bottom "));
  EXPECT_TRUE(contains(outcome.out, ", back "));
  EXPECT_TRUE(contains(outcome.out, "  top, bottom, right, front, back platens: custom, friction 0 static"));
  EXPECT_TRUE(contains(outcome.out, "  left platen: grease, friction 0.0048 static"));
}

// The platens of the sides crush the box between top and bottom that bear a stress.
TEST_F(Sides, strength_follows_the_axis_that_stages_drive) {
  const nlohmann::json s = press(
      "across", {"Bond/Tensile strength = 6 MPa", "Bond/Shear strength = 15 MPa",
                 "Loading/Stop at residual = 0.75", "Loading/Stage 1/Axial = stress 1 MPa",
                 "Loading/Stage 1/Lateral = stress 1 MPa", "Loading/Stage 1/Until = settled",
                 "Loading/Stage 2/Lateral x = rate", "Loading/Stage 2/Axial = stress 1 MPa",
                 "Loading/Stage 2/Lateral y = stress 1 MPa", "Loading/Stage 2/Until = Lateral x strain 3 %"});
  const auto column = [&](const char *name) { return column_of(folder_ / "across/history.csv", name); };
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
  const auto refuses = [&](const std::vector<std::string> &entries, const std::string &says) {
    std::vector<std::string> arguments = options(entries);
    arguments.insert(arguments.end(), {"-o", "refused"});
    const Outcome outcome = run_compress(arguments, folder_);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_TRUE(contains(outcome.error, says)) << outcome.error;
    EXPECT_FALSE(fs::exists(folder_ / "refused"));
  };
  refuses(
      {"Platens/Edge gap = 4 mm"},
      "command line, --set 1: error: Platens/Edge gap = 4 mm leaves too little of a platen. Allowed: up to "
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
