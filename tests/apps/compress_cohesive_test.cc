// Specimens of elasto-damage-plastic interfaces between platens: stops, threads, energy, softening.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <fstream>

#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

class Interfaces : public Crushed {
protected:
  static std::vector<std::string> concrete(std::vector<std::string> more = {}) {
    std::vector<std::string> entries{"Effects/Bond = elasto damage plastic",
                                     "Bond/Modulus = 28 GPa",
                                     "Bond/Poisson ratio = 0.2",
                                     "Bond/Tensile strength = 5 MPa",
                                     "Bond/Shear strength = 16 MPa",
                                     "Bond/Friction static = 0.9",
                                     "Bond/Friction dynamic = 0.25",
                                     "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa",
                                     "Bond/Compression slopes = 3, 12, 22",
                                     "Contact/Friction = 0.25"};
    entries.insert(entries.end(), more.begin(), more.end());
    return entries;
  }
  static std::vector<std::string> command(const std::string &output, const std::string &threads,
                                          const std::vector<std::string> &more = {}) {
    std::vector<std::string> arguments{test_scene("crushed.prm"), "-o", output, "-t", threads, "--quiet"};
    for (const std::string &entry : concrete(more))
      arguments.insert(arguments.end(), {"-s", entry});
    return arguments;
  }
};

TEST_F(Interfaces, a_crushed_cylinder_yields_softens_and_balances_its_energy) {
  const nlohmann::json s = crush("run", concrete());
  EXPECT_EQ(s["effects"][0], "elasto damage plastic");
  EXPECT_GT(s["strength_pa"], 5e6);
  EXPECT_LT(s["strength_pa"], 60e6);
  EXPECT_LT(s["energy_residual_relative"], 5e-3);
  EXPECT_GT(s["broken_tension"], 500);
  EXPECT_GT(s["broken_shear"], 0);
  const fs::path history = folder_ / "run/history.csv";
  EXPECT_GT(column_of(history, "fracture_work_j").back(), 0);
  EXPECT_GT(column_of(history, "plastic_work_j").back(), 0);
  EXPECT_GT(column_of(history, "friction_work_j").back(), 0);
  EXPECT_EQ(column_of(history, "intact_bonds").back() + column_of(history, "broken_tension").back() +
                column_of(history, "broken_shear").back(),
            s["bonds"]);
}

// With moments: weaker by the stress of the skin, the same ledger, columns and bytes for any number of
// threads.
TEST_F(Interfaces, that_bend_and_twist_have_the_same_columns_and_a_closed_ledger) {
  const std::vector<std::string> bending{"Effects/Interface moments = on", "Bond/Moment contribution = 1"};
  const nlohmann::json without = crush("without", concrete()), with = crush("with", concrete(bending));
  const auto has = [](const nlohmann::json &list) {
    return std::find(list.begin(), list.end(), "bond moments") != list.end();
  };
  EXPECT_TRUE(has(with["effects"]));
  EXPECT_TRUE(has(without["effects_off"]));
  EXPECT_LT(with["strength_pa"], without["strength_pa"]);
  EXPECT_LT(with["energy_residual_relative"], 5e-3);
  const auto header = [&](const char *run) {
    std::string line;
    std::ifstream history(folder_ / run / "history.csv");
    std::getline(history, line);
    return line;
  };
  EXPECT_EQ(header("with"), header("without"));
  ASSERT_EQ(run_compress(command("one", "1", bending), folder_).status, 0);
  ASSERT_EQ(run_compress(command("four", "4", bending), folder_).status, 0);
  EXPECT_EQ(difference(results_in(folder_ / "one"), results_in(folder_ / "four")), "");
}

TEST_F(Interfaces, threads_and_stops_change_no_byte) {
  ASSERT_EQ(run_compress(command("whole", "1"), folder_).status, 0);
  Program program(compress_command(command("stopped", "2")), folder_);
  EXPECT_TRUE(program.wait_until([&] { return lines_in(folder_ / "stopped/history.csv") >= 60; }));
  program.send(SIGTERM);
  ASSERT_EQ(program.wait(), 143);
  std::vector<std::string> resume = command("stopped", "4");
  resume.emplace_back("--resume");
  const Outcome last = run_compress(resume, folder_);
  EXPECT_EQ(last.status, 0) << last.error;
  EXPECT_EQ(difference(results_in(folder_ / "whole"), results_in(folder_ / "stopped")), "");
}

// E = E_0 times what the network makes of it; the area is the only thing that alpha changes.
TEST_F(Interfaces, the_area_factor_scales_the_modulus) {
  const std::vector<std::string> brief{"Loading/Target strain = 2e-4", "Platens/Stiffness = 1"};
  std::vector<std::string> wide = brief, packed = brief;
  wide.emplace_back("Bond/Area factor = 2");
  packed.emplace_back("Bond/Area factor = 0");
  const double one = crush("one", concrete(brief))["youngs_modulus_gauge_pa"];
  const double two = crush("two", concrete(wide))["youngs_modulus_gauge_pa"];
  const nlohmann::json by_packing = crush("packed", concrete(packed));
  EXPECT_NEAR(two / one, 2, 0.06); // the fast start oscillates by some percent
  const double porosity = 1 - by_packing["packing_fraction"].get<double>(),
               contacts = by_packing["coordination_number"];
  const double factor = 40 * porosity / contacts;
  EXPECT_NEAR(by_packing["youngs_modulus_gauge_pa"].get<double>() / one, factor, 0.03 * factor);
}

} // namespace
} // namespace platen::apps::testing
