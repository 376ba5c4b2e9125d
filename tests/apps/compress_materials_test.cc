// Effects that are off leave no trace: in the files, in the columns, in what the others find. Specimens of
// elasto-damage-plastic interfaces: energy, softening, moments, area.
#include <cmath>
#include <fstream>
#include <sstream>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class EffectsOff : public Crushed {
protected:
  static fs::path first_frame(const fs::path &run) {
    fs::path first;
    for (const auto &file : fs::directory_iterator(run / "frames"))
      if (contains(file.path().filename().string(), "specimen") && (first.empty() || file.path() < first))
        first = file.path();
    return first;
  }
  static std::vector<Words> history(const fs::path &run) {
    std::istringstream file(content_of(run / "history.csv"));
    std::vector<Words> rows;
    for (std::string line; std::getline(file, line);) {
      std::istringstream cells(line + ','); // an empty last cell is one
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');)
        rows.back().push_back(cell);
    }
    return rows;
  }
};

TEST_F(EffectsOff, ledger_and_log_only_watch) {
  const fs::path whole = crushed_once();
  const nlohmann::json with = summary_in(whole),
                       without = crush("without", {"Effects/Energy ledger = off", "Effects/Crack log = off"});
  EXPECT_TRUE(has(with["effects"], "energy ledger"));
  EXPECT_TRUE(has(without["effects_off"], "energy ledger"));
  EXPECT_TRUE(has(without["effects_off"], "crack log"));
  EXPECT_TRUE(fs::exists(whole / "cracks.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "without/cracks.csv"));
  EXPECT_TRUE(without["energy_residual_relative"].is_null());
  EXPECT_TRUE(without["kinetic_to_internal_max"].is_null());
  EXPECT_EQ(with["strength_pa"], without["strength_pa"]);
  EXPECT_EQ(with["broken_shear"], without["broken_shear"]);
  EXPECT_LT(without["bytes_per_bond"], 100);
  // Every other cell is the same to the byte.
  const auto a = history(whole), b = history(folder_ / "without");
  ASSERT_EQ(a.size(), b.size());
  std::size_t energies = 0;
  for (std::size_t c = 0; c < a[0].size(); ++c) {
    const std::string &column = a[0][c];
    const bool energy = column.size() > 2 && column.compare(column.size() - 2, 2, "_j") == 0;
    energies += energy;
    for (std::size_t row = 1; row < a.size(); ++row)
      ASSERT_EQ(b[row][c], energy ? "" : a[row][c]) << column << " in row " << row;
  }
  EXPECT_EQ(energies, 10u);
}

// Large grains held by a weak interface; the scene's list and its threshold say the same.
TEST_F(EffectsOff, phases_show_in_frames_and_strength) {
  const Words short_run{"Output/Fields = on", "Loading/Target strain = 0.004"};
  const nlohmann::json plain = crush("plain", short_run);
  Words entries =
      with(short_run, {"Phases/By = radius", "Phases/Radius above = 0.9 mm",
                       "Phases/Aggregate modulus factor = 2", "Phases/Interface strength factor = 0.5"});
  const nlohmann::json mixed = crush("mixed", entries);
  EXPECT_TRUE(has(plain["effects_off"], "phases"));
  EXPECT_TRUE(has(mixed["effects"], "phases"));
  const auto frame = [&](const char *run) { return content_of(first_frame(folder_ / run)); };
  EXPECT_FALSE(contains(frame("plain"), "Name=\"phase\""));
  EXPECT_TRUE(contains(frame("mixed"), "Name=\"phase\""));
  EXPECT_LT(mixed["strength_pa"].get<double>(), 0.95 * plain["strength_pa"].get<double>());
  EXPECT_LT(mixed["energy_residual_relative"], 0.02);
  // The same spheres by their ids.
  std::istringstream spheres(content_of(folder_ / "mixed/specimen.csv"));
  std::string line, list;
  for (int id = -2; std::getline(spheres, line); ++id) // two lines of header
    if (id >= 0 && std::stod(line.substr(line.rfind(',') + 1)) > 0.9e-3) list += std::to_string(id) + "\n";
  put(folder_ / "large.txt", list);
  entries[2] = "Phases/By = file";
  entries[3] = "Phases/File = " + (folder_ / "large.txt").string();
  crush("listed", entries);
  EXPECT_EQ(content_of(folder_ / "listed/history.csv"), content_of(folder_ / "mixed/history.csv"));
}

TEST_F(EffectsOff, moments_cost_columns_of_no_bond_but_strength_of_all) {
  const nlohmann::json with = crush("with", {"Bond/Damping = 0.02"});
  const nlohmann::json without = crush("without", {"Bond/Damping = 0.02", "Effects/Bond moments = off"});
  EXPECT_TRUE(has(with["effects"], "bond moments"));
  EXPECT_TRUE(has(without["effects_off"], "bond moments"));
  EXPECT_LT(without["bytes_per_bond"], with["bytes_per_bond"]); // no moment of a dashpot
  EXPECT_LT(without["youngs_modulus_gauge_pa"], with["youngs_modulus_gauge_pa"]);
  EXPECT_GT(without["youngs_modulus_gauge_pa"], 0);
  EXPECT_LT(without["energy_residual_relative"], 0.01);
}

class Interfaces : public Crushed {};

// With moments: weaker by the stress of the skin, the same ledger and columns.
TEST_F(Interfaces, yield_soften_and_balance_their_energy_and_with_moments_have_the_same_columns) {
  const nlohmann::json s = crush("without", concrete()),
                       bent = crush("with", concrete({"Effects/Interface moments = on",
                                                      "Bond/Moment contribution = 1"}));
  EXPECT_EQ(s["effects"][0], "elasto damage plastic");
  EXPECT_GT(s["strength_pa"], 5e6);
  EXPECT_LT(s["strength_pa"], 60e6);
  EXPECT_GT(s["broken_tension"], 500);
  EXPECT_GT(s["broken_shear"], 0);
  for (const char *work : {"fracture_work_j", "plastic_work_j", "friction_work_j"})
    EXPECT_GT(column("without", work).back(), 0) << work;
  EXPECT_EQ(column("without", "intact_bonds").back() + column("without", "broken_tension").back() +
                column("without", "broken_shear").back(),
            s["bonds"]);
  for (const nlohmann::json &one : {s, bent})
    EXPECT_LT(one["energy_residual_relative"], 5e-3);
  EXPECT_TRUE(has(bent["effects"], "bond moments"));
  EXPECT_TRUE(has(s["effects_off"], "bond moments"));
  EXPECT_LT(bent["strength_pa"], s["strength_pa"]);
  const auto header = [&](const char *run) {
    std::string line;
    std::ifstream history(folder_ / run / "history.csv");
    std::getline(history, line);
    return line;
  };
  EXPECT_EQ(header("with"), header("without"));
}

// E = E_0 times what the network makes of it; the area is the only thing that alpha changes.
TEST_F(Interfaces, the_area_factor_scales_the_modulus) {
  const Words brief = concrete({"Loading/Target strain = 2e-4", "Platens/Stiffness = 1"});
  const double one = crush("one", brief)["youngs_modulus_gauge_pa"],
               two = crush("two", with(brief, {"Bond/Area factor = 2"}))["youngs_modulus_gauge_pa"];
  const nlohmann::json by_packing = crush("packed", with(brief, {"Bond/Area factor = 0"}));
  EXPECT_NEAR(two / one, 2, 0.06); // the fast start oscillates by some percent
  const double porosity = 1 - by_packing["packing_fraction"].get<double>(),
               contacts = by_packing["coordination_number"];
  const double factor = 40 * porosity / contacts;
  EXPECT_NEAR(by_packing["youngs_modulus_gauge_pa"].get<double>() / one, factor, 0.03 * factor);
}

// All stresses of a facet concrete times `strength`, all moduli times `stiffness`, its fracture energy times
// the square of the one over the other: the same test at strains of `strength` over `stiffness`
// (docs/theory.md, facet bonds).
Words facets(double stiffness, double strength) {
  const auto times = [](double value, double factor, const char *unit) {
    return std::to_string(value * factor) + " " + unit;
  };
  const auto limit = [&](double value) { return times(value, strength, "MPa"); };
  return {"Effects/Bond = facet",
          "Bond/Gap = 0.6 R_min",
          "Bond/Stiffness ratio = 0.36",
          "Bond/Modulus = " + times(24, stiffness, "GPa"),
          "Bond/Tensile strength = " + limit(3.15),
          "Bond/Shear strength = " + limit(6),
          "Bond/Fracture energy = " + times(15.5, strength * strength / stiffness, "J/m2"),
          "Bond/Transitional stress = " + limit(50),
          "Bond/Friction static = 0.42",
          "Bond/Friction dynamic = 0.6",
          "Bond/Compression limits = " + limit(29) + ", " + limit(65) + ", " + limit(216),
          "Bond/Compression slopes = 3, 12, 20",
          "Bond/Moment stiffness = 0.003",
          "Loading/Axial rate = " + times(0.3, strength / std::sqrt(stiffness), "m/s"),
          "Loading/Target strain = " + std::to_string(0.01 * strength / stiffness),
          "Output/Every = 0"};
}

TEST_F(EffectsOff, facets_of_other_strengths_and_moduli_are_alike) {
  const nlohmann::json one = crush("one", facets(1, 1)), other = crush("other", facets(1.5, 1.8));
  const auto over = [&](const char *key) { return other[key].get<double>() / one[key].get<double>(); };
  EXPECT_NEAR(over("strength_pa"), 1.8, 0.01 * 1.8);
  EXPECT_NEAR(over("youngs_modulus_gauge_pa"), 1.5, 0.01 * 1.5);
  EXPECT_NEAR(over("strain_at_peak_platen"), 1.8 / 1.5, 0.03 * 1.8 / 1.5);
  EXPECT_NEAR(over("broken_tension"), 1,
              0.15); // once it has failed, by what is large against its strains too
}

} // namespace
} // namespace platen::apps::testing
