// Figures that a set-up cannot mean are null, with the reason; the others are valid.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Figures : public Crushed {
protected:
  // The reasons against a figure of a run, one after the other; "" where it is valid.
  static std::string against(const nlohmann::json &summary, const std::string &figure) {
    const nlohmann::json &said = summary.at("validity").at(figure);
    if (said == "valid") {
      EXPECT_FALSE(summary.at(figure).is_null()) << figure << " is valid and null";
      return "";
    }
    EXPECT_TRUE(summary.at(figure).is_null())
        << figure << " = " << summary.at(figure) << ", against it: " << said;
    std::string all;
    for (const nlohmann::json &reason : said)
      all += reason.get<std::string>() + "\n";
    EXPECT_NE(all, "") << figure;
    return all;
  }
  static void expect_reason(const nlohmann::json &summary, const std::vector<std::string> &figures,
                            const std::string &words) {
    for (const std::string &figure : figures)
      EXPECT_NE(against(summary, figure).find(words), std::string::npos)
          << figure << " lacks \"" << words << "\": " << against(summary, figure);
  }
  static void expect_valid(const nlohmann::json &summary, const std::vector<std::string> &figures) {
    for (const std::string &figure : figures)
      EXPECT_EQ(against(summary, figure), "") << figure;
  }
};

const std::vector<std::string> strength{"strength_pa", "strain_at_peak_platen", "strain_at_peak_gauge",
                                        "barrel_at_peak"},
    youngs_moduli{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa"},
    moduli{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio"};

TEST_F(Figures, of_a_crushed_cylinder_are_valid) {
  const nlohmann::json s = crush("run", {});
  EXPECT_EQ(s["peak_reached"], true);
  EXPECT_EQ(s["peak_is"], "fallen");
  EXPECT_EQ(s["ended_by"], "stop at residual");
  EXPECT_EQ(s["largest_stress_pa"], s["strength_pa"]);
  EXPECT_LT(s["stress_at_end_pa"].get<double>(), 0.98 * s["strength_pa"].get<double>());
  expect_valid(s, strength);
  expect_valid(s, moduli);
  expect_valid(s, {"end_damage_top", "middle_damage", "end_spread"});
}

TEST_F(Figures, of_a_test_that_ends_before_its_peak_are_none_but_the_moduli_of_sound_bonds) {
  const nlohmann::json s = crush("short", {"Loading/Target strain = 0.0002", "Expect/pattern ="});
  EXPECT_EQ(s["peak_reached"], false);
  EXPECT_EQ(s["ended_by"], "target");
  expect_reason(s, strength, "no peak was reached: by the strain of 0.00018");
  expect_valid(s, moduli);
  EXPECT_NEAR(s["stress_at_end_pa"].get<double>(), s["largest_stress_pa"].get<double>(),
              0.05 * s["largest_stress_pa"].get<double>());
  EXPECT_NEAR(s["moduli_at_stress_pa"].get<double>(), 0.4 * s["largest_stress_pa"].get<double>(), 1);
  expect_reason(s, {"end_damage_top", "cone_top"}, "has not fallen to 0.8");
}

TEST_F(Figures, an_expectation_of_one_that_is_none_says_why) {
  const Outcome outcome =
      run_compress({test_scene("crushed.prm"), "-o", "run", "-s", "Loading/Target strain = 0.0002", "-s",
                    "Output/Fields = off", "-s", "Expect/strength_pa = 1 Pa ... 1 GPa"},
                   folder_);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.error.find("strength_pa was not measured (no peak was reached"), std::string::npos)
      << outcome.error;
  EXPECT_NE(outcome.out.find("none: no peak was reached"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("largest stress"), std::string::npos) << outcome.out;
}

// Rows of history.csv so far apart that the peak may lie anywhere between two.
TEST_F(Figures, a_specimen_that_is_shortened_too_far_ends_its_test) {
  const Outcome outcome =
      run_compress({test_scene("crushed.prm"), "-o", "run", "-s", "Loading/Target strain = 0.9", "-s",
                    "Loading/Stop at residual = 0", "-s", "Loading/Axial rate = 20 m/s", "-s",
                    "Output/Fields = off", "-s", "Specimen/Sphere radius = 2 mm"},
                   folder_);
  EXPECT_EQ(outcome.status, 0) << outcome.error;
  const nlohmann::json s = summary_in(folder_ / "run");
  EXPECT_EQ(s["ended_by"], "shortened too far");
  EXPECT_NEAR(column_of(folder_ / "run/history.csv", "axial_strain_platen").back(), 0.3, 0.01);
  EXPECT_NE(outcome.error.find("is shortened by 30 % of its length"), std::string::npos) << outcome.error;
}

// Each kind of test asks for a figure of its own; the others stay.
TEST_F(Figures, for_which_bonds_are_not_calibrated_are_none) {
  const std::string of = "Bond/Calibrated figures = ";
  const nlohmann::json tensile = crush("tensile", {of + "elastic, tension"});
  expect_reason(tensile, strength,
                "are not calibrated for it: Bond/Calibrated figures = elastic, tension, without compression");
  expect_reason(tensile, {"end_damage_top", "middle_damage", "end_spread"}, "without compression");
  expect_valid(tensile, youngs_moduli);
  EXPECT_GT(tensile["largest_stress_pa"].get<double>(), 0);
  const nlohmann::json crushed = crush("crushed", {of + "compression"});
  expect_valid(crushed, strength);
  expect_valid(crushed, {"end_damage_top", "middle_damage", "end_spread"});
  expect_reason(crushed, moduli, "Bond/Calibrated figures = compression, without elastic");
  const std::vector<std::string> cell{"Loading/Confinement = particles", "Loading/Confining pressure = 1 MPa",
                                      "Expect/pattern ="};
  const auto with = [&](const std::string &figures) {
    std::vector<std::string> all = cell;
    all.push_back(of + figures);
    return all;
  };
  expect_reason(crush("cell", with("elastic, compression")), {"strength_pa"}, "without confined");
  expect_valid(crush("confined", with("compression, confined, elastic")), {"strength_pa"});
}

// Poisson's ratio of a test goes to 40 % of the strength, where bonds have broken: that of small strains says
// nothing of it.
TEST_F(Figures, a_poisson_ratio_of_compression_needs_a_secant_ratio_that_was_calibrated) {
  const std::string of = "Bond/Calibrated figures = elastic, compression";
  const nlohmann::json without = crush("without", {of});
  expect_reason(without, {"poisson_ratio"},
                "Bond/Calibrated figures = elastic, compression, without secant ratio");
  EXPECT_TRUE(without["poisson_ratio_extremal"].is_null());
  expect_valid(without, youngs_moduli);
  expect_valid(without, strength);
  expect_valid(crush("with", {of + ", secant ratio"}), moduli);
  expect_valid(crush("unsaid", {"Bond/Calibrated figures ="}), moduli);
}

TEST_F(Figures, of_a_tension_test_need_bonds_calibrated_in_tension) {
  const std::vector<std::string> pulled{"Loading/Test = tension",         "Platens/Attachment = glued",
                                        "Loading/Target strain = 0.002",  "Loading/Axial rate = 0.05 m/s",
                                        "Loading/Stop at residual = 0.5", "Expect/pattern ="};
  const auto with = [&](const std::string &figures) {
    std::vector<std::string> all = pulled;
    all.push_back("Bond/Calibrated figures = " + figures);
    return all;
  };
  expect_reason(crush("a", with("compression, confined, elastic")), {"strength_pa"}, "without tension");
  expect_valid(crush("b", with("tension")), {"strength_pa"});
  expect_valid(crush("c", with("tension, elastic")), {"poisson_ratio"}); // its bonds have not broken by 40 %
}

TEST_F(Figures, between_few_readings_are_none) {
  const nlohmann::json s = crush("coarse", {"Output/Every = 600", "Expect/pattern ="});
  expect_reason(s, {"strength_pa"}, "readings before the peak, 8 at least");
  expect_reason(s, moduli, "3 at least: a smaller Output/Every");
}

} // namespace
} // namespace platen::apps::testing
