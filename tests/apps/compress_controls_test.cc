// What a test asks of its sides and what is reached, through the program: told in the log, in `ended_by` and
// in the summary, and against figures that need it.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Controls : public Crushed {
protected:
  explicit Controls(const std::string &scene = "crushed.prm") : Crushed(scene) {}
  static bool speaks_against(const nlohmann::json &summary, const std::string &figure,
                             const std::string &words) {
    const nlohmann::json &reasons = summary["validity"][figure];
    return reasons.is_array() &&
           std::any_of(reasons.begin(), reasons.end(), [&](const nlohmann::json &reason) {
             return contains(reason.get<std::string>(), words);
           });
  }
  static void expect_control(const nlohmann::json &told, const std::string &quantity, const std::string &side,
                             const std::string &unit, bool met) {
    EXPECT_EQ(told["quantity"], quantity) << told;
    EXPECT_EQ(told["side"], side) << told;
    EXPECT_EQ(told["unit"], unit) << told;
    EXPECT_EQ(told["met"], met) << told;
    const double asked = told["asked"], reached = told["reached"];
    EXPECT_EQ(std::abs(reached - asked) <= 0.01 * std::abs(asked), met) << told;
  }
};

class OnLattice : public Controls {
protected:
  OnLattice() : Controls("exact_lattice.prm") {}
  // A simple cubic lattice of unbreakable bonds, 4 x 4 x 8 spheres of 1 mm.
  nlohmann::json press_lattice(const std::string &name, const std::vector<std::string> &entries) {
    std::ofstream file(folder_ / "lattice.csv");
    file << "# shape: box width_x_m=0.008 width_y_m=0.008 height_m=0.016\nx_m,y_m,z_m,radius_m\n";
    for (int z = 0; z < 8; ++z)
      for (int y = -3; y <= 3; y += 2)
        for (int x = -3; x <= 3; x += 2)
          file << 1e-3 * x << ',' << 1e-3 * y << ',' << 1e-3 * (2 * z + 1) << ",0.001\n";
    file.close();
    return crush(name, with({"Specimen/File = lattice.csv"}, entries));
  }
};

// The servo goes no faster than the axial rate: 1 ms is too short for 5 MPa, 2 ms do for one.
TEST_F(OnLattice, a_stress_that_was_not_reached_is_told_and_speaks_against_figures) {
  const Words common{"Platens/Top/Control = stress", "Loading/Ramp = 1 ms", "Loading/Axial rate = 0.02 m/s",
                     "Loading/Target strain = 0.001"};
  const nlohmann::json missed = press_lattice("missed", with(common, {"Platens/Top/Stress = 5 MPa"}));
  EXPECT_EQ(missed["ended_by"], "target; not reached: top stress of stage 1");
  ASSERT_EQ(missed["controls"].size(), 1u);
  const nlohmann::json &told = missed["controls"][0];
  expect_control(told, "stress", "top", "Pa", false);
  EXPECT_EQ(told["stage"], "stress");
  EXPECT_EQ(told["asked"], 5e6);
  EXPECT_NEAR(told["reached"].get<double>() / column("missed", "axial_stress_top_pa").back(), 1, 0.05);
  EXPECT_LT(told["reached"], 4.9e6);
  EXPECT_TRUE(
      contains(outcome_.error, "stage 1 (ended by: time) has not reached what it asked: top stress "));
  EXPECT_TRUE(contains(outcome_.error, " of 5 MPa"));
  for (const char *figure : {"strength_pa", "youngs_modulus_gauge_pa", "youngs_modulus_platen_pa"}) {
    EXPECT_TRUE(missed[figure].is_null()) << figure;
    EXPECT_TRUE(speaks_against(missed, figure, "stage 1 has not reached what it asked: top stress "))
        << figure;
  }

  const nlohmann::json met =
      press_lattice("met", with(common, {"Platens/Top/Stress = 1 MPa", "Loading/Hold = 1 ms"}));
  EXPECT_EQ(met["ended_by"], "target");
  expect_control(met["controls"][0], "stress", "top", "Pa", true);
  EXPECT_FALSE(contains(outcome_.error, "not reached what it asked"));
  EXPECT_FALSE(speaks_against(met, "youngs_modulus_platen_pa", "has not reached"));
}

// In series with a spring as stiff as the specimen the faces close half as fast as the machine.
TEST_F(OnLattice, the_rate_behind_a_machines_spring_is_told) {
  const Words slow{"Platens/Stiffness = 1", "Loading/Axial rate = 0.002 m/s", "Integration/Damping = 0.7"};
  const nlohmann::json rigid = press_lattice("rigid", slow);
  EXPECT_EQ(rigid["ended_by"], "target");
  ASSERT_EQ(rigid["controls"].size(), 1u);
  expect_control(rigid["controls"][0], "rate", "axial", "m/s", true);
  EXPECT_EQ(rigid["controls"][0]["stage"], "compression");
  const double asked = rigid["controls"][0]["asked"];
  EXPECT_NEAR(asked, rigid["controls"][0]["reached"], 1e-9 * asked);
  EXPECT_LT(asked, 0.002); // for it begins smoothly
  EXPECT_GT(asked, 0.0015);

  const double stiffness = rigid["youngs_modulus_platen_pa"].get<double>() * 0.008 * 0.008 / 0.016; // N/m
  const nlohmann::json soft =
      press_lattice("soft", with(slow, {"Platens/Machine stiffness = " + std::to_string(stiffness),
                                        "Platens/Machine mass = 0.002"}));
  expect_control(soft["controls"][0], "rate", "axial", "m/s", false);
  EXPECT_NEAR(soft["controls"][0]["reached"].get<double>() / soft["controls"][0]["asked"].get<double>(), 0.5,
              0.05);
  EXPECT_EQ(soft["ended_by"], "target; not reached: axial rate of stage 1");
  EXPECT_EQ(soft["validity"]["youngs_modulus_gauge_pa"], "valid"); // it needs no rate
}

// Without stages of its own a test in a cell tells those that its keys stand for.
TEST_F(Controls, a_triaxial_test_tells_its_pressure) {
  const nlohmann::json s =
      crush("run", {"Loading/Confinement = particles", "Loading/Confining pressure = 3 MPa",
                    "Loading/Stop at residual = 0.8", "Loading/Target strain = 0.02"});
  ASSERT_EQ(s["controls"].size(), 4u);
  expect_control(s["controls"][0], "pressure", "lateral", "Pa", true);
  expect_control(s["controls"][1], "stress", "top", "Pa", true);
  for (const int k : {0, 1}) {
    EXPECT_EQ(s["controls"][k]["stage"], "consolidation");
    EXPECT_EQ(s["controls"][k]["asked"], 3e6);
  }
  EXPECT_EQ(s["controls"][2]["stage"], "compression");
  EXPECT_EQ(s["controls"][2]["quantity"], "rate");
  EXPECT_EQ(s["controls"][3]["quantity"], "pressure");
  EXPECT_EQ(s["ended_by"], "stop at residual");
  EXPECT_EQ(s["validity"]["strength_pa"], "valid");
  const std::vector<double> share = column("run", "confined_area_share"),
                            pressure = column("run", "confining_pressure_pa");
  for (std::size_t k = 0; k < share.size(); ++k) {
    ASSERT_LE(share[k], 1) << k;
    ASSERT_GT(share[k], 0.8) << k;
    ASSERT_LE(pressure[k], 3e6 * share[k] * (1 + 1e-12)) << k;
  }
  EXPECT_EQ(share.front(), 1);
  EXPECT_EQ(s["controls"][3]["reached"], pressure.back());
}

// A specimen that bears hardly anything loses its skin when the cell presses it.
TEST_F(Controls, a_pressure_that_acts_on_a_part_is_told_and_speaks_against_figures) {
  const nlohmann::json s =
      crush("run", {"Loading/Confinement = particles", "Loading/Confining pressure = 3 MPa",
                    "Bond/Tensile strength = 1 kPa", "Bond/Shear strength = 1 kPa",
                    "Loading/Target strain = 0.002", "Loading/Stop at residual = 0", "Output/Every = 5"});
  const std::vector<double> share = column("run", "confined_area_share"),
                            pressure = column("run", "confining_pressure_pa"),
                            deviator = column("run", "deviator_pa"),
                            top = column("run", "axial_stress_top_pa"),
                            bottom = column("run", "axial_stress_bottom_pa");
  EXPECT_EQ(share.front(), 1);
  EXPECT_LT(share.back(), 0.9);
  EXPECT_DOUBLE_EQ(pressure.back(), 3e6 * share.back());
  EXPECT_DOUBLE_EQ(deviator.back(), 0.5 * (top.back() + bottom.back()) - pressure.back());
  EXPECT_EQ(s["confining_pressure_pa"], pressure.back());
  expect_control(s["controls"][0], "pressure", "lateral", "Pa", false);
  EXPECT_TRUE(contains(outcome_.error, "has not reached what it asked: lateral pressure "));
  EXPECT_TRUE(contains(s["ended_by"].get<std::string>(), "lateral pressure of stage 1")) << s["ended_by"];
  for (const char *figure : {"strength_pa", "deviator_strength_pa"}) {
    EXPECT_TRUE(s[figure].is_null());
    EXPECT_TRUE(speaks_against(s, figure, "of the lateral surface then, 90 % at least"))
        << s["validity"][figure];
  }
}

// What is missed along an axis speaks against what is read off later, until that axis is asked again.
TEST_F(Controls, a_miss_counts_until_its_axis_is_asked_again) {
  const Words first{"Specimen/Radius =",
                    "Specimen/Shape = box",
                    "Specimen/Width x = 16 mm",
                    "Specimen/Width y = 14 mm",
                    "Specimen/Height = 18 mm",
                    "Platens/Sides = six",
                    "Expect/pattern =",
                    "Loading/Stop at residual = 0",
                    "Bond/Tensile strength = unbreakable",
                    "Bond/Shear strength = unbreakable",
                    "Loading/Stage 1/Lateral = stress 5 MPa",
                    "Loading/Stage 1/Until = time 5 us",
                    "Loading/Stage 2/Axial = rate",
                    "Loading/Stage 2/Until = strain 0.1 %"};
  const std::string reason = "stage 1 has not reached what it asked: lateral x stress ";
  const nlohmann::json left = crush("left", first);
  EXPECT_TRUE(contains(left["ended_by"].get<std::string>(),
                       "target; not reached: lateral x stress of stage 1, lateral y stress of stage 1"))
      << left["ended_by"];
  EXPECT_FALSE(left.contains("controls"));
  ASSERT_EQ(left["stages"][0]["controls"].size(), 2u);
  expect_control(left["stages"][0]["controls"][0], "stress", "lateral x", "Pa", false);
  EXPECT_TRUE(speaks_against(left, "strength_pa", reason));
  const nlohmann::json again = crush("again", with(first, {"Loading/Stage 2/Lateral = stress 5 MPa"}));
  ASSERT_EQ(again["stages"][1]["controls"].size(), 3u);
  EXPECT_FALSE(speaks_against(again, "strength_pa", reason)) << again["validity"]["strength_pa"];
}

// The specimen fails below the stress that it is asked: that is its strength, and no failure of the control.
TEST_F(Controls, a_specimen_that_fails_is_no_stress_that_was_missed) {
  const nlohmann::json s =
      crush("run", {"Loading/Stage 1/Axial = stress 100 MPa", "Loading/Stage 1/Ramp = 0.4 ms",
                    "Loading/Stop at residual = 0", "Loading/Stage 1/Until = share of peak 0.5"});
  expect_control(s["stages"][0]["controls"][0], "stress", "axial", "Pa", false);
  EXPECT_EQ(s["ended_by"], "target");
  EXPECT_EQ(s["peak_reached"], true);
  EXPECT_EQ(s["validity"]["strength_pa"], "valid");
  EXPECT_TRUE(
      contains(log("run"), "stage 1 (ended by: share of peak) has not reached what it asked: axial stress"));
  EXPECT_TRUE(contains(log("run"), "(the specimen failed in it)"));
}

// The end of a test is that of its last stage.
TEST_F(Controls, a_rate_that_was_not_reached_when_the_test_ended_is_told) {
  const nlohmann::json s =
      crush("run", {"Loading/Stage 1/Axial = circumferential rate 200 1/s", "Loading/Stop at residual = 0.6",
                    "Loading/Stage 1/Until = circumferential strain 5 %, strain 4 %"});
  EXPECT_EQ(s["ended_by"], "stop at residual");
  expect_control(s["stages"][0]["controls"][0], "circumferential rate", "axial", "1/s", false);
  EXPECT_TRUE(contains(log("run"),
                       "stage 1 (ended by: the end of the test) has not reached what it asked: "
                       "axial circumferential rate "));
}

} // namespace
} // namespace platen::apps::testing
