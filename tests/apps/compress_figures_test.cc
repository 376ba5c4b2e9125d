// Figures that a set-up cannot mean are null, with the reason; the others are valid. Of every pair of stage
// kinds a peak is told where the second stage crushes the specimen, and of nothing that falls by command;
// what is told together is of one row of history.csv.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
  static void expect_reason(const nlohmann::json &summary, const Words &figures, const std::string &words) {
    for (const std::string &figure : figures)
      EXPECT_TRUE(contains(against(summary, figure), words)) << figure;
  }
  static void expect_valid(const nlohmann::json &summary, const Words &figures) {
    for (const std::string &figure : figures)
      EXPECT_EQ(against(summary, figure), "") << figure;
  }
};

const Words of_the_peak{"strength_pa", "strain_at_peak_platen", "strain_at_peak_gauge", "barrel_at_peak"},
    youngs_moduli{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa"},
    moduli{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa", "poisson_ratio"};

TEST_F(Figures, of_a_crushed_cylinder_are_valid) {
  const nlohmann::json s = summary_in(crushed_once());
  EXPECT_EQ(s["peak_reached"], true);
  EXPECT_EQ(s["peak_is"], "fallen");
  EXPECT_EQ(s["ended_by"], "stop at residual");
  EXPECT_EQ(s["largest_stress_pa"], s["strength_pa"]);
  EXPECT_LT(s["stress_at_end_pa"].get<double>(), 0.98 * s["strength_pa"].get<double>());
  expect_valid(s, of_the_peak);
  expect_valid(s, moduli);
  expect_valid(s, {"end_damage_top", "middle_damage", "end_spread"});
}

TEST_F(Figures, of_a_test_that_ends_before_its_peak_are_none_but_the_moduli_of_sound_bonds) {
  const nlohmann::json s = crush("short", {"Loading/Target strain = 0.0002", "Expect/pattern ="});
  EXPECT_EQ(s["peak_reached"], false);
  EXPECT_EQ(s["ended_by"], "target");
  expect_reason(s, of_the_peak, "no peak was reached: up to the strain of 0.00018");
  expect_valid(s, moduli);
  EXPECT_NEAR(s["stress_at_end_pa"].get<double>(), s["largest_stress_pa"].get<double>(),
              0.05 * s["largest_stress_pa"].get<double>());
  EXPECT_NEAR(s["moduli_at_stress_pa"].get<double>(), 0.4 * s["largest_stress_pa"].get<double>(), 1);
  expect_reason(s, {"end_damage_top", "cone_top"}, "has not fallen to 0.8");
}

TEST_F(Figures, of_a_tube_are_those_of_the_row_of_the_largest_load) {
  const nlohmann::json s =
      crush("tube", {"Loading/Confinement = sleeve", "Sleeve/Kind = tube", "Sleeve/Steel = S235",
                     "Sleeve/Yield strength = 40 MPa", "Sleeve/Thickness = 0.5 mm",
                     "Loading/Target strain = 0.006", "Expect/pattern ="});
  const std::vector<double> load = column("tube", "total_load_n"),
                            top = column("tube", "axial_stress_top_pa"),
                            bottom = column("tube", "axial_stress_bottom_pa");
  const std::size_t row = static_cast<std::size_t>(std::max_element(load.begin(), load.end()) - load.begin());
  for (const auto &[figure, name] :
       std::map<std::string, std::string>{{"largest_load_n", "total_load_n"},
                                          {"strain_at_largest_load", "axial_strain_platen"},
                                          {"tube_load_at_largest_n", "tube_load_n"},
                                          {"tube_axial_stress_at_largest_pa", "tube_axial_stress_pa"},
                                          {"tube_hoop_stress_at_largest_pa", "tube_hoop_stress_pa"},
                                          {"tube_pressure_at_largest_pa", "tube_pressure_pa"}}) {
    const double expected = column("tube", name)[row];
    EXPECT_NEAR(s[figure].get<double>(), expected, 1e-9 * std::abs(expected)) << figure;
    EXPECT_GT(expected, 0) << figure;
  }
  const double area = s["section"]["area_m2"];
  EXPECT_NEAR(load[row] - column("tube", "tube_load_n")[row], 0.5 * (top[row] + bottom[row]) * area,
              1e-9 * load[row]);
  const double borne = column("tube", "tube_hoop_stress_pa")[row] * 0.5e-3 / 10e-3; // Pa
  EXPECT_NEAR(s["tube_inertia_share"].get<double>(), 1 - borne / column("tube", "tube_pressure_pa")[row],
              1e-9);
  expect_reason(s, moduli, "a tube or a wrap holds the sides");
  EXPECT_TRUE(has(s["effects"], "tube"));
}

TEST_F(Figures, of_a_wrap_are_those_of_the_row_before_it_tears) {
  const Words wrap{"Loading/Confinement = sleeve", "Sleeve/Kind = wrap", "Sleeve/Modulus = 70 GPa",
                   "Sleeve/Thickness = 0.1 mm",    "Expect/pattern =",   "Loading/Target strain = 0.006"};
  const auto with = [&](const char *rupture) {
    Words all = wrap;
    all.push_back(rupture);
    return all;
  };
  const nlohmann::json s = crush("wrap", with("Sleeve/Rupture strain = 0.0005"));
  const std::vector<double> torn = column("wrap", "wrap_torn_share");
  const auto first = std::find_if(torn.begin(), torn.end(), [](double share) { return share > 0; });
  ASSERT_NE(first, torn.end());
  const auto row = static_cast<std::size_t>(first - torn.begin()) - 1;
  EXPECT_NEAR(s["strain_at_first_tear"].get<double>(), column("wrap", "axial_strain_platen")[row], 1e-12);
  EXPECT_NEAR(s["hoop_strain_at_first_tear"].get<double>(), column("wrap", "wrap_hoop_strain")[row], 1e-12);
  EXPECT_LT(column("wrap", "wrap_largest_hoop_strain")[row], 0.0005);
  EXPECT_GT(column("wrap", "wrap_largest_hoop_strain")[row], 0.9 * 0.0005);
  EXPECT_GT(s["wrap_torn_energy_j"], 0);
  EXPECT_TRUE(has(s["effects"], "wrap"));
  EXPECT_FALSE(s.contains("tube_plastic_work_j"));
  Words thin = with("Sleeve/Rupture strain = 0.05");
  thin.push_back("Sleeve/Thickness = 1 um"); // which is heavy, for it has steps as long as others
  EXPECT_GT(crush("thin", thin)["tube_inertia_share"], 0.9);
  EXPECT_TRUE(contains(outcome_.error, "the inertia of the wall, not its stress, bears"));
  const nlohmann::json gone = crush("gone", with("Sleeve/Rupture strain = 0.00001"));
  EXPECT_TRUE(gone["tube_inertia_share"].is_null()); // next to no pressure
  EXPECT_TRUE(std::isnan(column("gone", "wrap_hoop_strain").back()));
  EXPECT_TRUE(std::isnan(column("gone", "wrap_largest_hoop_strain").back()));
  Words at_once = with("Sleeve/Rupture strain = 0.000001");
  at_once.push_back("Output/Every = 400"); // the first row after the start has torn elements
  const nlohmann::json early = crush("early", at_once);
  EXPECT_GT(column("early", "wrap_torn_share")[1], 0);
  expect_reason(early, {"strain_at_first_tear", "hoop_strain_at_first_tear"},
                "no part of the wrap has torn after the first rows");
  const nlohmann::json whole = crush("whole", with("Sleeve/Rupture strain = 0.05"));
  expect_reason(whole, {"strain_at_first_tear", "hoop_strain_at_first_tear"}, "no part of the wrap has torn");
  EXPECT_EQ(whole["wrap_torn_energy_j"], 0);
}

// Its specimen stands off the platens: no strength of it, but loads, and an energy balance.
TEST_F(Figures, of_a_tube_that_is_loaded_alone_are_loads) {
  const nlohmann::json s =
      crush("alone", {"Loading/Confinement = sleeve", "Sleeve/Kind = tube", "Sleeve/Steel = S235",
                      "Sleeve/Thickness = 0.5 mm", "Sleeve/Recess = 1 mm", "Sleeve/Bond strength = 50 MPa",
                      "Loading/Stop at residual = 0", "Loading/Target strain = 0.0006", "Expect/pattern ="});
  expect_reason(s, of_the_peak, "the specimen stands off a platen (Sleeve/Recess)");
  expect_reason(s, moduli, "the specimen stands off a platen (Sleeve/Recess)");
  EXPECT_GT(s["largest_load_n"].get<double>(), 2000);
  EXPECT_EQ(s["largest_load_n"], s["tube_load_at_largest_n"]);
  EXPECT_LT(s["energy_residual_relative"].get<double>(), 0.01);
  EXPECT_EQ(s["tube_bonded_share"], column("alone", "tube_bonded_share").back());
  EXPECT_GT(s["tube_bonded_share"], 0.5);
}

TEST_F(Figures, an_expectation_of_one_that_is_none_says_why) {
  crush("run", {"Loading/Target strain = 0.0002", "Expect/strength_pa = 1 Pa ... 1 GPa"}, {}, 1);
  EXPECT_TRUE(contains(outcome_.error, "strength_pa was not measured (no peak was reached"));
  EXPECT_TRUE(contains(outcome_.out, "none: no peak was reached"));
  EXPECT_TRUE(contains(outcome_.out, "largest stress"));
}

// Rows of history.csv so far apart that the peak may lie anywhere between two.
TEST_F(Figures, a_specimen_that_is_shortened_too_far_ends_its_test) {
  const nlohmann::json s = crush("run", {"Loading/Target strain = 0.9", "Loading/Stop at residual = 0",
                                         "Loading/Axial rate = 20 m/s", "Specimen/Sphere radius = 2 mm"});
  EXPECT_EQ(s["ended_by"], "shortened too far");
  EXPECT_NEAR(column("run", "axial_strain_platen").back(), 0.3, 0.01);
  EXPECT_TRUE(contains(outcome_.error, "is shortened by 30 % of its length"));
}

// Each kind of test asks for a figure of its own; the others stay.
const std::string of = "Bond/Calibrated figures = ";

TEST_F(Figures, for_which_bonds_are_not_calibrated_are_none) {
  const nlohmann::json tensile = crush("tensile", {of + "elastic, tension"});
  expect_reason(tensile, of_the_peak,
                "are not calibrated for it: Bond/Calibrated figures = elastic, tension, without compression");
  expect_reason(tensile, {"end_damage_top", "middle_damage", "end_spread"}, "without compression");
  expect_valid(tensile, youngs_moduli);
  EXPECT_GT(tensile["largest_stress_pa"].get<double>(), 0);
  const nlohmann::json crushed = crush("crushed", {of + "compression"});
  expect_valid(crushed, of_the_peak);
  expect_valid(crushed, {"end_damage_top", "middle_damage", "end_spread"});
  expect_reason(crushed, moduli, "Bond/Calibrated figures = compression, without elastic");
  const Words cell{"Loading/Confinement = particles", "Loading/Confining pressure = 1 MPa",
                   "Expect/pattern ="};
  expect_reason(crush("cell", with(cell, {of + "elastic, compression"})), {"strength_pa"},
                "without confined");
  expect_valid(crush("confined", with(cell, {of + "compression, confined, elastic"})), {"strength_pa"});
}

// Poisson's ratio of a test goes to 40 % of the strength, where bonds have broken: that of small strains says
// nothing of it.
TEST_F(Figures, a_poisson_ratio_of_compression_needs_a_secant_ratio_that_was_calibrated) {
  const nlohmann::json without = crush("without", {of + "elastic, compression"});
  expect_reason(without, {"poisson_ratio"},
                "Bond/Calibrated figures = elastic, compression, without secant ratio");
  EXPECT_TRUE(without["poisson_ratio_extremal"].is_null());
  expect_valid(without, youngs_moduli);
  expect_valid(without, of_the_peak);
  expect_valid(crush("with", {of + "elastic, compression, secant ratio"}), moduli);
  expect_valid(crush("unsaid", {of}), moduli);
}

TEST_F(Figures, of_a_tension_test_need_bonds_calibrated_in_tension) {
  const Words pulled{"Loading/Test = tension",         "Platens/Attachment = glued",
                     "Loading/Target strain = 0.002",  "Loading/Axial rate = 0.05 m/s",
                     "Loading/Stop at residual = 0.5", "Expect/pattern ="};
  expect_reason(crush("a", with(pulled, {of + "compression, confined, elastic"})), {"strength_pa"},
                "without tension");
  expect_valid(crush("b", with(pulled, {of + "tension"})), {"strength_pa"});
  expect_valid(crush("c", with(pulled, {of + "tension, elastic"})),
               {"poisson_ratio"}); // its bonds have not broken by 40 %
}

TEST_F(Figures, between_few_readings_are_none) {
  const nlohmann::json s = crush("coarse", {"Output/Every = 600", "Expect/pattern ="});
  expect_reason(s, {"strength_pa"}, "readings before the peak, 8 at least");
  expect_reason(s, moduli, "3 at least: a smaller Output/Every");
}

struct Kind {
  const char *name;
  Words first, second;  // entries of the stage
  bool crushes = false; // as the second
};

// The first ends at two thirds of what the specimen bears, or where a platen or a pressure has gone a little;
// the second goes on until it would crush the specimen, if it can.
const std::vector<Kind> kinds{
    {"drive", {"Axial = rate", "Until = Axial stress 25 MPa"}, {"Axial = rate", "Until = strain 4 %"}, true},
    {"stress", {"Axial = stress 25 MPa", "Until = settled"}, {"Axial = stress 10 MPa", "Until = settled"}},
    {"more stress",
     {"Axial = stress 20 MPa", "Until = settled"},
     {"Axial = stress 200 MPa", "Ramp = 1 ms", "Until = strain 4 %, time 1.5 ms"},
     true},
    {"pressure",
     {"Lateral = pressure 6 MPa", "Until = settled"},
     {"Lateral = pressure 0.5 MPa", "Until = settled"}},
    {"more pressure",
     {"Lateral = pressure 9 MPa", "Until = settled"},
     {"Lateral = pressure 12 MPa", "Until = settled"}},
    {"circumference",
     {"Axial = circumferential rate 2 1/s", "Until = Axial stress 25 MPa"},
     {"Axial = circumferential rate 2 1/s", "Until = circumferential strain 3 %, strain 4 %"},
     true},
    {"hold", {"Axial = hold", "Until = time 50 us"}, {"Axial = hold", "Until = time 100 us"}},
    {"unload",
     {"Axial = unload", "Until = time 20 us"},
     {"Axial = unload", "Until = share of start 0.3, time 60 us"}},
    {"share",
     {"Lateral = share of Axial 0.5", "Until = time 100 us"},
     {"Lateral = share of Axial 0.05", "Until = time 100 us"}}};

class Pairs : public Crushed, public ::testing::WithParamInterface<std::size_t> {
protected:
  nlohmann::json run(const std::string &name, const std::vector<Words> &stages) {
    Words entries{"Specimen/Sphere radius = 1.6 mm",
                  "Loading/Confinement = particles",
                  "Loading/Stop at residual = 0.5",
                  "Output/Every = 10",
                  "Checkpoint/Every = 0",
                  "Loading/Stage 1/Lateral = pressure 2 MPa",
                  "Loading/Stage 1/Top = stress 2 MPa",
                  "Loading/Stage 1/Until = settled"};
    for (std::size_t k = 0; k < stages.size(); ++k)
      for (const std::string &entry : stages[k])
        entries.push_back(fmt::format("Loading/Stage {}/{}", k + 2, entry));
    return crush(name, entries);
  }
  void expect_of_one_row(const std::string &name, const nlohmann::json &s) const;
};

// The largest are those of the columns; what is told at the peak is of its row.
void Pairs::expect_of_one_row(const std::string &name, const nlohmann::json &s) const {
  const std::vector<double> top = column(name, "axial_stress_top_pa"),
                            bottom = column(name, "axial_stress_bottom_pa"), time = column(name, "time_s"),
                            deviator = column(name, "deviator_pa"),
                            pressure = column(name, "confining_pressure_pa"),
                            strain = column(name, "axial_strain_platen"), stage = column(name, "stage");
  std::vector<double> stress;
  for (std::size_t k = 0; k < top.size(); ++k)
    stress.push_back(0.5 * (top[k] + bottom[k]));
  const auto row_of = [&](double when) {
    return static_cast<std::size_t>(std::find(time.begin(), time.end(), when) - time.begin());
  };
  EXPECT_EQ(s["largest_stress_pa"], *std::max_element(stress.begin(), stress.end()));
  EXPECT_EQ(s["largest_stress_pa"], stress.at(row_of(s["largest_stress_time_s"])));
  std::size_t zero = 0;
  while (stage[zero + 1] == 1)
    ++zero;
  EXPECT_EQ(s["largest_deviator_pa"],
            *std::max_element(deviator.begin() + static_cast<std::ptrdiff_t>(zero) + 1, deviator.end()));
  EXPECT_EQ(s["largest_deviator_pa"], deviator.at(row_of(s["largest_deviator_time_s"])));
  if (s["peak_reached"] != true) {
    EXPECT_TRUE(s["peak_time_s"].is_null());
    EXPECT_EQ(s["confining_pressure_pa"], pressure.back());
    return;
  }
  const std::size_t peak = row_of(s["peak_time_s"]);
  EXPECT_EQ(s["confining_pressure_pa"], pressure.at(peak));
  if (s["strength_pa"].is_null()) return; // at a pressure that was not the asked one
  EXPECT_EQ(s["strength_pa"], stress.at(peak));
  EXPECT_NEAR(s["deviator_strength_pa"], deviator.at(peak), 1);
  EXPECT_NEAR(s["strain_at_peak_platen"], strain.at(peak) - strain.at(zero), 1e-12);
}

TEST_P(Pairs, tell_a_peak_where_the_second_stage_crushes_the_specimen) {
  const Kind &first = kinds[GetParam()];
  for (const Kind &second : kinds) {
    const std::string name = fmt::format("{}, {}", first.name, second.name);
    SCOPED_TRACE(name);
    const nlohmann::json s = run(name, {first.first, second.second});
    const nlohmann::json &said = s["validity"]["strength_pa"];
    expect_of_one_row(name, s);
    EXPECT_EQ(s["peak_reached"] == true, second.crushes);
    // A first stage that ended before its pressure was reached speaks against the strength at that pressure.
    const bool missed = said.dump().find("has not reached what it asked: lateral") != std::string::npos;
    EXPECT_TRUE(!missed || first.name == std::string("share")) << said;
    EXPECT_EQ(said == "valid", second.crushes && !missed) << said;
    EXPECT_EQ(s["strength_pa"].is_null(), !second.crushes || missed);
    // How it has failed is told of a specimen that its cell still presses.
    const bool has_pattern = !s["pattern"].is_null() || !s["middle_damage"].is_null();
    const std::string against = s["validity"]["middle_damage"].dump();
    if (second.crushes)
      EXPECT_TRUE(has_pattern || missed || against.find("of the lateral surface") != std::string::npos)
          << against;
    else
      EXPECT_FALSE(has_pattern);
    EXPECT_EQ(s["fall_time_s"].is_null(), !second.crushes);
  }
}

INSTANTIATE_TEST_SUITE_P(Stages, Pairs, ::testing::Range<std::size_t>(0, kinds.size()));

} // namespace
} // namespace platen::apps::testing
