// Effects that are off leave no trace: in the files, in the columns, in what the others find.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class EffectsOff : public Crushed {
protected:
  static bool has(const nlohmann::json &words, const std::string &word) {
    return std::find(words.begin(), words.end(), word) != words.end();
  }
  fs::path first_frame(const std::string &run) const {
    fs::path first;
    for (const auto &file : fs::directory_iterator(folder_ / run / "frames"))
      if (contains(file.path().filename().string(), "specimen") && (first.empty() || file.path() < first))
        first = file.path();
    return first;
  }
  std::vector<std::vector<std::string>> history(const std::string &name) const {
    std::istringstream file(content_of(folder_ / name / "history.csv"));
    std::vector<std::vector<std::string>> rows;
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
  const nlohmann::json with = crush("with", {});
  const nlohmann::json without = crush("without", {"Effects/Energy ledger = off", "Effects/Crack log = off"});
  EXPECT_TRUE(has(with["effects"], "energy ledger"));
  EXPECT_TRUE(has(without["effects_off"], "energy ledger"));
  EXPECT_TRUE(has(without["effects_off"], "crack log"));
  EXPECT_TRUE(fs::exists(folder_ / "with/cracks.csv"));
  EXPECT_FALSE(fs::exists(folder_ / "without/cracks.csv"));
  EXPECT_TRUE(without["energy_residual_relative"].is_null());
  EXPECT_TRUE(without["kinetic_to_internal_max"].is_null());
  EXPECT_EQ(with["strength_pa"], without["strength_pa"]);
  EXPECT_EQ(with["broken_shear"], without["broken_shear"]);
  EXPECT_LT(without["bytes_per_bond"], 100);
  // Every other cell is the same to the byte.
  const auto a = history("with"), b = history("without");
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
  const std::vector<std::string> short_run{"Output/Fields = on", "Loading/Target strain = 0.004"};
  const nlohmann::json plain = crush("plain", short_run);
  std::vector<std::string> entries = short_run;
  entries.insert(entries.end(),
                 {"Phases/By = radius", "Phases/Radius above = 0.9 mm", "Phases/Aggregate modulus factor = 2",
                  "Phases/Interface strength factor = 0.5"});
  const nlohmann::json mixed = crush("mixed", entries);
  EXPECT_TRUE(has(plain["effects_off"], "phases"));
  EXPECT_TRUE(has(mixed["effects"], "phases"));
  const auto frame = [&](const char *run) { return content_of(first_frame(run)); };
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

} // namespace
} // namespace platen::apps::testing
