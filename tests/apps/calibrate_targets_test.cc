// What a calibration is asked for, and what a trial answers: lines of targets, curves, figures of runs.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "apps/scene/errors.h"
#include "calibrate_stand_in.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// As the words have it: a ratio of strengths is no strength.
TEST(ManyTargets, are_reported_in_the_unit_of_their_words) {
  for (const auto &[line, unit, words] : std::vector<std::tuple<std::string, double, std::string>>{
           {"young modulus: 30 GPa", 1e9, "Young's modulus, GPa"},
           {"poisson ratio: 0.2", 1, "Poisson's ratio"},
           {"strength_pa: 40 MPa", 1e6, "compressive strength, MPa"},
           {"strain_at_peak_platen: 2 mm/m", 1e-3, "strain at peak, mm/m"},
           {"tension: 4 MPa", 1e6, "tensile strength, MPa"},
           {"splitting: 4 MPa", 1e6, "splitting strength, MPa"},
           {"strength_pa over Platens/Friction static = 0: 1.4", 1, "strength over Friction static = 0"},
           {"youngs_modulus_gauge_pa: 30 GPa", 1e9, "youngs_modulus_gauge_pa, GPa"},
           {"middle_damage: 0.4", 1, "middle_damage"},
           {"curve 1", 1, "miss of the curve"}}) {
    EXPECT_EQ(read_target(line).unit(), unit) << line;
    EXPECT_EQ(read_target(line).words(), words);
  }
}

TEST(TargetLine, says_figure_test_value_and_tolerance) {
  const Target at = read_target(std::string("strength_pa at ") + in_a_cell + "9 MPa: 82 MPa +- 3 %");
  EXPECT_EQ(at.kind, TargetKind::strength_at_pressure);
  EXPECT_EQ(at.entries, (Texts{"Loading/Confinement = particles", "Loading/Confining pressure = 9 MPa"}));
  EXPECT_DOUBLE_EQ(at.value, 82e6);
  EXPECT_DOUBLE_EQ(at.tolerance, 0.03);
  EXPECT_TRUE(at.over.empty());
  // A tolerance in the unit of the figure; a test that is the same but for what stands after over.
  const Target over = read_target(
      "strength_pa at Specimen/Radius =, Specimen/Height = 5 cm over Specimen/Height = 1 dm: 1.2");
  EXPECT_EQ(over.entries, (Texts{"Specimen/Radius =", "Specimen/Height = 5 cm"}));
  EXPECT_EQ(over.over, (Texts{"Specimen/Radius =", "Specimen/Height = 1 dm"}));
  EXPECT_EQ(over.kind, TargetKind::ratio);
  EXPECT_DOUBLE_EQ(read_target("strength_pa: 40 MPa +- 2 MPa").tolerance, 0.05);
  EXPECT_TRUE(std::isnan(read_target("strength_pa: 40 MPa").tolerance));
  const Target curve = read_target("curve 2 at Platens/Friction static = 0.1: +- 5 %");
  EXPECT_EQ(curve.curve_file, 2);
  EXPECT_EQ(curve.entries.size(), 1u);
  EXPECT_DOUBLE_EQ(curve.tolerance, 0.05);
  EXPECT_EQ(read_target("splitting: 4 MPa").program, "brazilian");
}

// Shortest tests of tension and splitting: what the line says stays.
TEST(TargetLine, completes_the_tests_of_tension_and_splitting) {
  Scene scene = yielding_scene();
  scene.specimen.radius = 0.025, scene.specimen.height = 0.1;
  scene.loading.rate = 0.08, scene.loading.target_strain = 0.01;
  const auto entries = [&](const char *line) {
    Target target = read_target(line);
    complete_test(target, scene, 0.008);
    return target.entries;
  };
  EXPECT_EQ(entries("tension: 4 MPa"),
            (Texts{"Loading/Test = tension", "Platens/Attachment = glued", "Loading/Axial rate = 0.008 m/s",
                   "Loading/Target strain = 0.0025"}));
  EXPECT_EQ(entries("tension at Loading/Axial rate = 5 mm/s: 4 MPa"),
            (Texts{"Loading/Axial rate = 5 mm/s", "Loading/Test = tension", "Platens/Attachment = glued",
                   "Loading/Target strain = 0.0025"}));
  EXPECT_EQ(entries("splitting: 4 MPa"),
            (Texts{"Specimen/Shape = disc", "Specimen/Height = 0.025 m", "Loading/Axial rate = 0.01 m/s",
                   "Loading/Target strain = 0.005", "Platens/Strip width = 0.005 m"}));
  EXPECT_TRUE(entries("strength_pa: 40 MPa").empty());
}

TEST(Trial, ends_when_its_figures_are_known) {
  Scene scene = yielding_scene();
  scene.loading.target_strain = 0.01;
  SpecimenTest test;
  const auto has = [&](const char *entry) {
    return holds(entries_of_trials(scene, test), std::string(entry));
  };
  test.figures = {"strength_pa"};
  EXPECT_TRUE(has("Loading/Stop at residual = 0.8"));
  EXPECT_TRUE(has("Effects/Energy ledger = off"));
  test.figures.emplace_back("broken_tension"); // of the end, wherever the scene has it
  EXPECT_FALSE(has("Loading/Stop at residual = 0.8"));
  EXPECT_FALSE(has("Effects/Energy ledger = off"));
  EXPECT_FALSE(has("Bond/Calibrated figures ="));
  scene.bond.calibrated.figures = {CalibratedFigure::elastic};
  EXPECT_TRUE(has("Bond/Calibrated figures ="));
  test.curve_strain = 0.02, test.figures = {"strength_pa"};
  EXPECT_FALSE(has("Loading/Stop at residual = 0.8"));
  EXPECT_TRUE(has("Loading/Target strain = 0.02"));
  test.entries = {"Loading/Target strain = 0.03"};
  EXPECT_FALSE(has("Loading/Target strain = 0.02"));
}

TEST(Trial, that_was_too_fast_or_not_valid_has_a_reason_and_no_number) {
  SpecimenTest test;
  test.figures = {"strength_pa"};
  const TrialResult fast = result_of(test,
                                     {{"quasi_static", false},
                                      {"peak_reached", true},
                                      {"strength_pa", 4e7},
                                      {"signs_of_haste", {"36 wave crossings"}}},
                                     "");
  EXPECT_TRUE(fast.too_fast());
  EXPECT_TRUE(std::isnan(fast.number("strength_pa")));
  const TrialResult none = result_of(test,
                                     {{"quasi_static", true},
                                      {"strength_pa", nullptr},
                                      {"validity", {{"strength_pa", {"no peak was reached"}}}}},
                                     "");
  EXPECT_EQ(none.status, "no peak was reached");
  EXPECT_FALSE(none.too_fast());
  EXPECT_TRUE(result_of(test, {{"quasi_static", true}, {"strength_pa", 4e7}}, "").good());
}

class CurveFile : public ::testing::Test {
protected:
  CurveFile() : folder(fs::temp_directory_path() / ("platen_curve_" + std::to_string(::getpid()))) {
    fs::create_directories(folder);
  }
  ~CurveFile() override { fs::remove_all(folder); }
  Curve read(const std::string &text) const {
    std::ofstream(path, std::ios::binary) << text;
    return read_curve(path);
  }
  std::string fault(const std::string &text) const {
    try {
      read(text);
    } catch (const InputError &error) {
      return error.what();
    }
    return "";
  }
  fs::path folder, path = folder / "curve.csv";
};

TEST_F(CurveFile, a_known_curve_has_the_miss_that_it_was_given) {
  const Curve curve = read(
      "\xef\xbb\xbf# of our own press\r\nstrain_gauge, stress_mpa\r\n 0.001 , 20\r\n\r\n"
      "0.002,30\n0.004,10\n");
  EXPECT_TRUE(curve.of_gauge);
  EXPECT_DOUBLE_EQ(curve.stress_at(0.0005), 10e6); // from the origin
  EXPECT_DOUBLE_EQ(curve.stress_at(0.0015), 25e6);
  EXPECT_DOUBLE_EQ(curve.stress_at(0.003), 20e6);
  std::vector<double> stress = curve.sampled();
  EXPECT_EQ(root_mean_square(curve.misses(stress)), 0);
  for (double &value : stress)
    value += 3e6;
  EXPECT_NEAR(root_mean_square(curve.misses(stress)), 0.1, 1e-12); // of 30 MPa
  // Half of its 16 points lie on the way to the peak.
  stress = curve.sampled();
  for (std::size_t k = 0; k < stress.size(); ++k)
    stress[k] -= k < 8 ? 6e6 : 1.5e6;
  EXPECT_EQ(branches_of_curve(curve, stress),
            "largest stress 26 of 30 MPa, rising branch off by 20 %, after the peak by 5 %");
}

TEST_F(CurveFile, faults_are_refused_with_their_line) {
  const std::string head = "strain_platen,stress_pa\n";
  for (const auto &[text, says] : std::vector<std::pair<std::string, const char *>>{
           {"", "has no header"},
           {"strain,stress\n1,2\n", ":1: error: the header \"strain,stress\" is not that of a curve"},
           {head, "has no row"},
           {head + "0,0\n", "has no row with a strain above 0"},
           {head + "0.001,1\n0.001,2\n", ":3: error: the strain 0.001 is not above the one before it"},
           {head + "-0.001,1\n", ":2: error: the strain -0.001"},
           {head + "0.001;1\n", ":2: error: \"0.001;1\" has not two numbers"},
           {head + "0.001,x\n", "\"x\" is not a finite number"},
           {head + "0.001,-1\n", "has no stress above 0"},
           {head + "0.001,\u00a01\n", "The line holds U+00A0 (no-break space) in column 7."},
           {"strain_platen,stress_pa\r0.001,1\r0.001,2\r",
            ":3: error: the strain 0.001 is not above the one before it"}})
    EXPECT_NE(fault(text).find(says), std::string::npos) << fault(text);
  fs::remove(path);
  EXPECT_THROW(read_curve(path), InputError);
}

// Stress 10 GPa times the strain of the gauge, half of that of the platens, after a cell of 3 MPa has taken 1
// mm/m.
TEST_F(CurveFile, that_of_a_run_is_read_in_the_sense_of_its_test) {
  for (const double sign : {1.0, -1.0}) {
    std::ofstream file(folder / "history.csv");
    file << "time_s,axial_strain_platen,axial_strain_gauge,axial_stress_top_pa,axial_stress_bottom_pa\n0,0,0,"
            "0,0\n";
    for (int k = 0; k <= 20; ++k) {
      const double gauge = 1e-4 * k;
      file << 1 + k << ',' << sign * (2 * gauge + 1e-3) << ',' << sign * (gauge + 1e-3) << ','
           << sign * (11e9 * gauge + 3e6) << ',' << sign * (9e9 * gauge + 3e6) << '\n';
    }
    file.close();
    const Json summary{{"test", sign > 0 ? "compression" : "tension"}, {"consolidation_end_time_s", 1}};
    const auto curve = [&](double strain, bool of_gauge) {
      SpecimenTest test;
      test.program = "compress", test.curve_strain = strain, test.curve_of_gauge = of_gauge;
      return result_of(test, summary, folder).curve;
    };
    ASSERT_EQ(curve(1.6e-3, true).size(), curve_points);
    EXPECT_NEAR(curve(1.6e-3, true).front(), 1e6, 1);
    EXPECT_NEAR(curve(1.6e-3, true).back(), 16e6, 1);
    EXPECT_NEAR(curve(8e-3, false)[1], 5e6, 1);
    EXPECT_NEAR(curve(8e-3, false).back(), 20e6, 1); // ends before it: the last reading
  }
}

// s(e) = S F(e G/S) with the parabola F(x) = x - x^2/4: modulus and strength are what the curve was made of.
TEST_F(CurveFile, a_search_recovers_what_a_curve_was_made_of) {
  const auto stress = [](double modulus, double strength, double strain) {
    const double x = strain * modulus / strength;
    return strength * (x - 0.25 * x * x);
  };
  std::ofstream file(path);
  file << "strain_platen,stress_pa\n";
  for (int k = 1; k <= 60; ++k)
    file << 5e-5 * k << "," << stress(30e9, 40e6, 5e-5 * k) << "\n";
  file.close();
  Scene scene = yielding_scene(targets_of({"curve 1"}, 0.01),
                               {FreeParameter::modulus, FreeParameter::tensile_strength});
  scene.own<Calibrate>().targets[0].file = path.string();
  scene.model.bond_layout.modulus = 20e9;
  const Goals goals(scene);
  const Measurement test = [&](const std::vector<Choice> &choices, bool) {
    std::vector<Measured> all;
    for (const Choice &c : choices) {
      std::vector<TrialResult> results(goals.tests().size());
      for (std::size_t point = 1; point <= curve_points; ++point)
        results[goals.all()[0].test].curve.push_back(stress(c[FreeParameter::modulus],
                                                            10 * c[FreeParameter::tensile_strength],
                                                            Curve::strain_of(point, 3e-3)));
      all.push_back(goals.measured(results));
    }
    return all;
  };
  const Found f = search(scene, goals, test);
  EXPECT_TRUE(analyse(goals, f).missed.empty());
  EXPECT_LE(f.trials, 12);
  EXPECT_NEAR(f.choice[FreeParameter::modulus], 30e9, 0.03 * 30e9);
  EXPECT_NEAR(f.choice[FreeParameter::tensile_strength], 4e6, 0.03 * 4e6);
}

} // namespace
} // namespace platen::apps
