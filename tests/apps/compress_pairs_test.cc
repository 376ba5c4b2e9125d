// Every pair of stage kinds on one specimen: a peak is told where the second stage crushes it, and of nothing
// that falls by command. What is told together is of one row of history.csv.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

struct Kind {
  const char *name;
  std::vector<std::string> first, second; // entries of the stage
  bool crushes = false;                   // as the second
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
  nlohmann::json run(const std::string &name, const std::vector<std::vector<std::string>> &stages) {
    std::vector<std::string> entries{"Specimen/Sphere radius = 1.6 mm",
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
  std::vector<double> column(const std::string &name, const char *of) const {
    return column_of(folder_ / name / "history.csv", of);
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
  fmt::print("{:<30}{:>10}{:>10}{:>10}{:>10}  {}\n", "pair", "strength", "deviator", "pressure", "largest",
             "told");
  const auto mpa = [](const nlohmann::json &value) {
    return value.is_null() ? std::string("-") : fmt::format("{:.2f}", value.get<double>() / 1e6);
  };
  for (const Kind &second : kinds) {
    const std::string name = fmt::format("{}, {}", first.name, second.name);
    SCOPED_TRACE(name);
    const nlohmann::json s = run(name, {first.first, second.second});
    const nlohmann::json &said = s["validity"]["strength_pa"];
    fmt::print("{:<30}{:>10}{:>10}{:>10}{:>10}  {}\n", name, mpa(s["strength_pa"]),
               mpa(s["deviator_strength_pa"]), mpa(s["confining_pressure_pa"]), mpa(s["largest_stress_pa"]),
               said.is_array() ? said[0].get<std::string>() : said.get<std::string>());
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
