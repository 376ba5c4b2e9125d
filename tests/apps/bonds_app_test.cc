// The output folder of platen-bonds. PLATEN_SCENES is the folder of scenes.
#include <gtest/gtest.h>

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "apps/bonds/run_bonds.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class BondsApp : public ::testing::Test {
protected:
  BondsApp() : folder(fs::temp_directory_path() / ("platen_bonds_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
  }
  ~BondsApp() override { fs::remove_all(folder); }

  int run(const std::string &file, const std::string &to, bool overwrite = false) const {
    CommandLine command;
    command.scene = file;
    command.output = (folder / to).string();
    command.quiet = true;
    command.overwrite = overwrite;
    return run_bonds(command, read_scene(file, {}, program("bonds")));
  }

  fs::path folder;
  const std::string scene = std::string(PLATEN_SCENES) + "/two_particles.prm";
};

TEST_F(BondsApp, writes_table_summary_scene_and_log) {
  EXPECT_EQ(run(scene, "a"), status_done);
  for (const char *name : {"bonds.csv", "summary.json", "scene.prm", "run.log"})
    EXPECT_TRUE(fs::exists(folder / "a" / name)) << name;
  std::istringstream table(text_of(folder / "a/bonds.csv"));
  std::string header, line;
  std::getline(table, header);
  EXPECT_EQ(header.rfind("run,modulus_pa,stiffness_ratio,force_n,displacement_m,moment_nm,rotation_rad,", 0),
            0u);
  int rows = 0;
  while (std::getline(table, line))
    ++rows;
  EXPECT_EQ(rows, 30); // 5 moduli, 6 load steps
  const auto summary = nlohmann::json::parse(text_of(folder / "a/summary.json"));
  EXPECT_EQ(summary["status"], "done");
  EXPECT_EQ(summary["app"], "platen-bonds");
  EXPECT_EQ(summary["runs"].size(), 5u);
  EXPECT_TRUE(summary["strength_pa"].is_null()); // not measured, not 0
  for (const auto &of : summary["runs"]) {
    const double by_hand = of["modulus_pa"].get<double>() * 3.14159265358979e-6 / 2e-3;
    EXPECT_NEAR(of["stiffness"].get<double>(), by_hand, 1e-6 * by_hand);
  }
}

TEST_F(BondsApp, the_scene_that_it_leaves_gives_the_same_table) {
  ASSERT_EQ(run(scene, "a"), status_done);
  ASSERT_EQ(run((folder / "a/scene.prm").string(), "b"), status_done);
  EXPECT_EQ(text_of(folder / "a/bonds.csv"), text_of(folder / "b/bonds.csv"));
}

TEST_F(BondsApp, an_earlier_run_is_not_overwritten_unasked) {
  ASSERT_EQ(run(scene, "a"), status_done);
  EXPECT_THROW(run(scene, "a"), InputError);
  EXPECT_EQ(run(scene, "a", true), status_done);
}

TEST_F(BondsApp, an_included_file_is_not_overwritten) {
  ASSERT_EQ(run(scene, "a"), status_done);
  const fs::path again = folder / "again.prm", included = folder / "a/scene.prm";
  std::ofstream(again) << "include a/scene.prm\n";
  const std::string before = text_of(included);
  EXPECT_THROW(run(again.string(), "a", true), InputError);
  EXPECT_EQ(text_of(included), before);
  EXPECT_EQ(run(again.string(), "b"), status_done);
}

} // namespace
} // namespace platen::apps
