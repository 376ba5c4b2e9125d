// What platen-calibrate finds and reports.
#include <cmath>

#include "apps/output/sha256.h"
#include "calibrate_app.h"

namespace platen::apps {
namespace {

double young_of(const nlohmann::json &summary, std::size_t row = 0) {
  return summary["abacus"][row]["youngs_modulus_gauge_pa"].get<double>();
}

double poisson_of(const nlohmann::json &summary, std::size_t row = 0) {
  return summary["abacus"][row]["poisson_ratio"].get<double>();
}

// Exact properties of linear networks, and bounds that hold for every one of them.
TEST_F(CalibrateApp, an_abacus_is_linear_in_the_modulus_and_falls_with_the_ratio) {
  const auto s =
      run(asked({}, {"Mode = abacus", "Modulus list = 18 GPa, 36 GPa", "Stiffness ratio list = 0.2, 0.5, 1"}),
          "a");
  ASSERT_EQ(s["abacus"].size(), 6u);
  for (const std::size_t k : {0u, 2u, 4u}) {
    EXPECT_NEAR(young_of(s, k + 1), 2 * young_of(s, k), 1e-9 * young_of(s, k));
    EXPECT_EQ(poisson_of(s, k + 1), poisson_of(s, k));
  }
  EXPECT_LT(young_of(s, 0), young_of(s, 2));
  EXPECT_LT(young_of(s, 2), young_of(s, 4));
  EXPECT_GT(poisson_of(s, 0), poisson_of(s, 2));
  EXPECT_GT(poisson_of(s, 2), poisson_of(s, 4));
  // Of the scene's own ratio, 0.4, between the first two at 36 GPa.
  const double voigt = s["bounds"]["young_voigt_pa"];
  EXPECT_GT(voigt, young_of(s, 1));
  EXPECT_NEAR(s["bounds"]["young_reuss_pa"].get<double>() / voigt,
              5 * .4 / (2 + 3 * .4) / ((2 + 3 * .4) / 4.4), 1e-9);
  EXPECT_EQ(s["trials"], 6); // three ratios on two seeds: the moduli need no solve
  EXPECT_EQ(s["failed_trials"], 0);
}

// The line that the abacus does not use: two moduli solved for are as two lengths.
TEST_F(CalibrateApp, moduli_that_are_solved_for_are_proportional_too) {
  const auto one = run(asked({}, {"Mode = abacus", "Bond/Modulus = 10 GPa"}), "a"),
             other = run(asked({}, {"Mode = abacus", "Bond/Modulus = 70 GPa"}), "b");
  EXPECT_NEAR(young_of(other), 7 * young_of(one), 1e4);
  EXPECT_NEAR(poisson_of(other), poisson_of(one), 1e-6);
}

TEST_F(CalibrateApp, packings_are_found_in_the_cache_by_another_calibration) {
  setenv("PLATEN_CACHE", (folder / "kept").c_str(), 1);
  const auto packing_in = [&](const fs::path &at) {
    for (const auto &entry : fs::directory_iterator(at))
      if (entry.path().extension() == ".csv") return entry.path();
    return fs::path();
  };
  const auto modulus = [&](Texts more, const char *to) {
    more.insert(more.end(), {"Mode = abacus", "Seeds = 1"});
    return young_of(run(asked({}, more), to));
  };
  const double first = modulus({}, "a"), second = modulus({"Scene/Seed = 5", "Specimen/Cache = none"}, "b");
  ASSERT_NE(first, second);
  const fs::path kept = packing_in(folder / "kept"), other = packing_in(folder / "b/packings");
  ASSERT_FALSE(kept.empty() || other.empty());
  // The spheres of the second, planted under the recipe of the first: a line of it, spheres, a checksum.
  const std::string text = content_of(kept), spheres = content_of(other);
  std::string planted = text.substr(0, text.find('\n') + 1) + spheres.substr(spheres.find('\n') + 1);
  planted.resize(planted.rfind("# sha256"));
  testing::put(kept, planted + "# sha256 of all above: " + sha256_of(planted) + "\n");
  EXPECT_EQ(modulus({}, "c"), second);
}

TEST_F(CalibrateApp, the_search_recovers_the_bonds_of_a_known_specimen) {
  const auto known = run(asked({}, {"Mode = abacus"}), "known");
  const auto found = run(asked({"young modulus: " + with_unit(young_of(known), " Pa"),
                                "poisson ratio: " + with_unit(poisson_of(known), "")},
                               {"Bond/Modulus = 20 GPa", "Bond/Stiffness ratio = 0.9"}),
                         "found");
  // Poisson's ratio is met within 1e-4, which is 4e-4 of the stiffness ratio.
  EXPECT_NEAR(found["found"]["stiffness_ratio"].get<double>(), .4, 1e-3);
  EXPECT_NEAR(found["found"]["bond_modulus_pa"].get<double>(), 36e9, 36e6);
  EXPECT_EQ(found["verification"]["poisson_ratio"]["seeds"], 1);
  EXPECT_TRUE(found["missed"].empty());
  const Scene scene = found_in("found");
  EXPECT_EQ(scene.model.bond_layout.modulus, found["found"]["bond_modulus_pa"].get<double>());
  EXPECT_EQ(scene.bond.number("stiffness_ratio"), found["found"]["stiffness_ratio"].get<double>());
}

// Bonds of a ready material to begin with: what they were calibrated on is not what is calibrated now.
TEST_F(CalibrateApp, strengths_are_found_whatever_the_first_bonds_were_calibrated_on) {
  const auto s = run(
      asked_of_one({"strength_pa: 40 MPa"}, {"Most trials = 4", "Bond/Calibrated figures = tension"}), "a");
  EXPECT_EQ(s["failed_trials"], 0);
  // One packing scatters by round-off alone; proportionality has brought it there from 9.5 MPa.
  EXPECT_NEAR(s["strength_pa"].get<double>(), 40e6, 4e6);
  EXPECT_TRUE(found_in("a").bond.calibrated.figures.empty());
}

// One trial on one packing; Mohr's circles rise with pressure by more than the pressure itself wherever there
// is friction.
TEST_F(CalibrateApp, a_triaxial_strength_is_measured_under_its_pressure) {
  const auto s = run(asked_of_one({"strength_pa: 40 MPa",
                                   "strength_pa at Loading/Confinement = particles, "
                                   "Loading/Confining pressure = 4 MPa: 52 MPa"},
                                  {"Scene/Seed = 7", "Most trials = 1"}),
                     "a");
  EXPECT_EQ(s["failed_trials"], 0);
  EXPECT_EQ(s["trials"], 3); // compression, triaxial and a static solve
  EXPECT_GT(s["triaxial_strength_pa"].get<double>(), s["strength_pa"].get<double>() + 1.5 * 4e6);
  EXPECT_LT(s["triaxial_strength_pa"].get<double>(), s["strength_pa"].get<double>() + 15 * 4e6);
}

// Screen, summary and page tell one number of a curve: that which decides whether it is met.
TEST_F(CalibrateApp, a_curve_is_told_by_what_it_is_judged_by) {
  testing::put(folder / "curve.csv", "strain_platen,stress_mpa\n0.001,15\n0.002,28\n0.003,30\n");
  const auto s = run(asked({"curve 1: +- 1 %"},
                           {"Verification seeds = 0", "Most trials = 1", "Free = modulus, tensile strength",
                            "Curve 1 = " + (folder / "curve.csv").string()}),
                     "a");
  const double miss = s["targets"][0]["training_miss"];
  ASSERT_GT(std::abs(mean(s, "curve_miss") - miss), 1e-3 * miss) << "the packings agree: nothing is tested";
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", miss);
  const std::string log = text_in("a/run.log");
  EXPECT_TRUE(contains(log, std::string("miss of the curve ") + text)) << log;
  const auto row = log.find("miss of the curve", log.find("calibrated on"));
  ASSERT_NE(row, std::string::npos) << log;
  EXPECT_TRUE(contains(log.substr(row, log.find('\n', row) - row), text)) << log.substr(row, 120);
}

TEST_F(CalibrateApp, what_is_out_of_reach_is_told_with_the_nearest) {
  const auto s = run(asked_of_one({"poisson ratio: 0.45"}), "a");
  ASSERT_EQ(s["missed"].size(), 1u);
  EXPECT_TRUE(contains(s["missed"][0], "out of reach"));
  EXPECT_NEAR(s["found"]["stiffness_ratio"].get<double>(), 0.02, 1e-9);
  ASSERT_EQ(s["at_bounds"].size(), 1u);
  ASSERT_EQ(s["targets_missed"].size(), 1u);
  const std::string gap = s["targets_missed"][0];
  EXPECT_EQ(gap.rfind("(1) Poisson's ratio: target 0.45, calibrated 0.", 0), 0u) << gap;
  EXPECT_TRUE(contains(gap, ", off by -")) << gap;
}

// One bond strength that is not free, and a target that is four times what it gives.
TEST_F(CalibrateApp, a_target_missed_by_a_factor_is_told_as_one) {
  const auto strength = [&](const std::string &value, const char *to) {
    return run(asked({"strength_pa: " + value},
                     {"Seeds = 1", "Verification seeds = 1", "Free = modulus", "Most trials = 1"}),
               to);
  };
  const double bears = mean(strength("1 GPa", "a"), "compressive_strength_pa", "verification");
  const auto s = strength(with_unit(4 * bears, " Pa"), "b");
  ASSERT_EQ(s["targets_missed"].size(), 1u);
  const std::string gap = s["targets_missed"][0];
  EXPECT_TRUE(contains(gap, "off by -75 % (a factor of 4), tolerance 2 %")) << gap;
}

// Every kind of target on one packing, and one more that judges; what they are is measured, not met.
TEST_F(CalibrateApp, every_kind_of_target_is_measured) {
  testing::put(folder / "curve.csv", "strain_platen,stress_mpa\n0.001,15\n0.002,28\n0.003,30\n");
  const std::string box =
      "Specimen/Shape = box, Specimen/Radius =, Specimen/Width x = 16 mm, Specimen/Width y "
      "= 16 mm, Specimen/Height = 16 mm, Loading/Axial rate = 0.03 m/s, Loading/Target strain = 0.05";
  // Between dry platens the pieces of so small a cylinder are locked and bear most after they have come
  // loose, when the pressure no longer acts on the side: no strength.
  const std::string cell =
      "Loading/Confinement = particles, Loading/Confining pressure = 4 MPa, Platens/Friction static = 0";
  const Texts targets{"young modulus: 20 GPa",
                      "poisson ratio: 0.2",
                      "strength_pa at Platens/Surface = grease: 40 MPa",
                      "strain_at_peak_platen: 2.4 mm/m +- 10 %",
                      "tension: 4 MPa",
                      "splitting at Platens/Friction static = 0.3: 4 MPa",
                      "strength_pa at " + cell + ": 60 MPa",
                      "strength_pa at " + box + " over Platens/Friction static = 0: 1.4",
                      "poisson_ratio: 0.2",
                      "curve 2: +- 10 %"};
  const Texts entries = asked(
      targets, {"Seeds = 1", "Verification seeds = 1", "Most trials = 1", "Free = modulus, tensile strength",
                "Scene/Seed = 7", "Curve 2 = " + (folder / "curve.csv").string()});
  const auto s = run(entries, "a");
  ASSERT_EQ(s["targets"].size(), targets.size());
  EXPECT_EQ(s["failed_trials"], 0) << text_in("a/trials.csv");
  const auto number = [&](const char *key) { return mean(s, key); };
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
  const std::string found = text_in("a/found.prm"), curve = text_in("a/curve.csv");
  EXPECT_EQ(curve.rfind("strain_platen,wanted_pa,calibrated_pa,unseen_pa\n", 0), 0u);
  // The figures of a run are those of the run itself: platen-compress between greased platens.
  EXPECT_EQ(json_in("a/runs/trial_1_compressive_strength_pa_seed_7")["strength_pa"],
            number("compressive_strength_pa"));
  // And the same again.
  run(entries, "a", true);
  EXPECT_EQ(text_in("a/found.prm"), found);
  EXPECT_EQ(text_in("a/curve.csv"), curve);
}

// What nobody has foreseen: any number of the scene, by any number of summary.json.
TEST_F(CalibrateApp, any_entry_is_tried_for_any_figure) {
  const auto s = run(
      asked_of_one({"middle_damage at Loading/Target strain = 0.01: 0.5"},
                   {"Most trials = 2", "Parameter 1 = Contact/Damping: 0 ... 0.5", "Contact/Damping = 0.1"}),
      "a");
  const auto tried = [&](int trial) {
    const std::string run = "a/runs/trial_" + std::to_string(trial) + "_middle_damage_seed_4";
    const Scene scene = read_scene((folder / run / "scene.prm").string(), {}, program("compress"));
    EXPECT_EQ(scene.loading.target_strain, 0.01);
    return std::pair<double, double>(scene.contact.damping, json_in(run)["middle_damage"]);
  };
  EXPECT_EQ(tried(1).first, 0.1);
  EXPECT_GT(tried(2).first, 0.1); // away from the nearer bound: sensitivities are measured
  const double found = s["found"]["Contact_Damping"], damage = mean(s, "middle_damage");
  EXPECT_TRUE((tried(1) == std::pair{found, damage}) || (tried(2) == std::pair{found, damage}));
  EXPECT_TRUE(contains(text_in("a/trials.csv"), ",Contact_Damping,status,"));
}

// From bonds that are off by a third to those that the targets were measured of.
TEST_F(CalibrateApp, bonds_that_yield_are_found_by_what_they_gave) {
  const auto with = [&](Texts more) {
    more.insert(more.begin(), {"Effects/Bond = yielding parallel bond", "Bond/Friction angle = 27 degree",
                               "Bond/Compression limits = 60 MPa, 110 MPa, 160 MPa",
                               "Bond/Compression slopes = 3, 12, 22"});
    return more;
  };
  const auto known =
      run(asked_of_one({"strength_pa: 40 MPa", "tension: 4 MPa"}, with({"Most trials = 1"})), "known");
  const auto wanted = [&](const std::string &what, const char *key) {
    return what + ": " + std::to_string(mean(known, key)) + " Pa";
  };
  const auto s = run(
      asked_of_one(
          {wanted("young modulus", "youngs_modulus_gauge_pa"),
           wanted("strength_pa", "compressive_strength_pa"), wanted("tension", "tensile_strength_pa")},
          with({"Bond/Modulus = 25 GPa", "Bond/Tensile strength = 7 MPa", "Bond/Shear strength = 38 MPa",
                "Differences = on", "Free = modulus, tensile strength, shear strength", "Most trials = 12"})),
      "found");
  EXPECT_TRUE(s["missed"].empty()) << s["missed"];
  EXPECT_NEAR(s["found"]["bond_modulus_pa"].get<double>(), 36e9, 0.03 * 36e9);
  EXPECT_NEAR(s["found"]["bond_tensile_strength_pa"].get<double>(), 9.5e6, 0.06 * 9.5e6);
  EXPECT_GT(s["sensitivities"][1]["tensile_strength_pa"].get<double>(), 0.7);
  EXPECT_LT(std::abs(s["sensitivities"][2]["tensile_strength_pa"].get<double>()), 0.3);
}

} // namespace
} // namespace platen::apps
