// platen-bar as a user runs it: what it finds of a small bar, what it leaves, what it refuses.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/program.h"
#include "apps/scene/scene.h"
#include "apps/scratch_folder.h"
#include "base/pi.h"

namespace platen::apps::testing {
namespace {

class BarApp : public ScratchFolder {
protected:
  Outcome run(const std::string &to, const std::vector<std::string> &overrides = {},
              const std::vector<std::string> &options = {}) {
    std::vector<std::string> command{PLATEN_BAR_PROGRAM, test_scene("bar.prm"), "-o", to, "--quiet"};
    command.insert(command.end(), options.begin(), options.end());
    for (const std::string &entry : overrides) {
      command.emplace_back("-s");
      command.push_back(entry);
    }
    Outcome outcome;
    outcome.status = Program(command, folder_).wait();
    outcome.out = content_of(folder_ / "out.txt");
    outcome.error = content_of(folder_ / "error.txt");
    return outcome;
  }
  nlohmann::json summary(const std::string &of) { return summary_in(folder_ / of); }
};

TEST_F(BarApp, finds_what_strength_of_materials_says) {
  ASSERT_EQ(run("a").status, 0);
  const nlohmann::json s = summary("a");
  EXPECT_EQ(s["status"], "done");
  EXPECT_EQ(s["app"], "platen-bar");
  // Of some hundred spheres, five across: the scatter of such a packing.
  EXPECT_NEAR(s["tension"]["static_error"].get<double>(), 0, .1);
  EXPECT_NEAR(s["tension"]["dynamic_error"].get<double>(), 0, .05);
  for (const char *load : {"bending", "torsion"}) {
    EXPECT_NEAR(s[load]["static_error_effective"].get<double>(), 0, .15) << load;
    EXPECT_NEAR(s[load]["dynamic_error_effective"].get<double>(), 0, .08) << load;
  }
  EXPECT_NEAR(s["impact"]["wave_error"].get<double>(), 0, .03);
  EXPECT_LT(s["energy_residual_relative"].get<double>(), .01);
  EXPECT_LT(s["effective_radius_m"].get<double>(), s["bounding_radius_m"].get<double>());
  double shares = 0;
  for (const char *share : {"axial_energy_share", "bending_energy_share", "torsion_energy_share"})
    shares += s["tension"][share].get<double>();
  EXPECT_NEAR(shares, 1, 1e-12);
  EXPECT_TRUE(s["strength_pa"].is_null());               // not measured, not 0
  EXPECT_TRUE(s["bulk"]["youngs_modulus_pa"].is_null()); // too thin to have an inside
  for (const char *file : {"scene.prm", "history.csv", "run.log"})
    EXPECT_TRUE(fs::exists(folder_ / "a" / file)) << file;
  EXPECT_EQ(s["effects"][0], "cohesive beam");
}

// Linear: the moduli, the shares and the errors do not see the size of the load, and a frequency hardly.
TEST_F(BarApp, the_size_of_the_load_falls_out) {
  const std::vector<std::string> entries{"Bar test/Load = tension", "Bar test/Strain = 1e-5"};
  ASSERT_EQ(run("a", {entries[0]}).status, 0);
  ASSERT_EQ(run("b", entries).status, 0);
  const nlohmann::json a = summary("a")["tension"], b = summary("b")["tension"];
  EXPECT_NEAR(a["force_n"].get<double>(), 10 * b["force_n"].get<double>(), 1e-9 * a["force_n"].get<double>());
  EXPECT_NEAR(a["static_error"].get<double>(), b["static_error"].get<double>(), 1e-6);
  EXPECT_NEAR(a["frequency_hz"].get<double>() / b["frequency_hz"].get<double>(), 1, 1e-3);
  EXPECT_NEAR(a["period_s"].get<double>() * a["frequency_hz"].get<double>(), 1, 1e-12);
  EXPECT_FALSE(summary("a").contains("bending"));
  EXPECT_FALSE(summary("a").contains("impact"));
}

TEST_F(BarApp, repeats_to_the_byte_on_any_number_of_threads) {
  const std::vector<std::string> entries{"Bar test/Load = bending", "Bar test/Periods = 4"};
  ASSERT_EQ(run("a", entries, {"-t", "1"}).status, 0);
  ASSERT_EQ(run("b", entries, {"-t", "2"}).status, 0);
  EXPECT_EQ(difference(results_in(folder_ / "a"), results_in(folder_ / "b")), "");
  EXPECT_GT(lines_in(folder_ / "a" / "history.csv"), 200);
}

// Other bonds, another section, a specimen from a file, and no rotation.
TEST_F(BarApp, any_bond_and_any_specimen_go_through) {
  const std::vector<std::string> parallel{"Effects/Bond = parallel bond", "Bond/Stiffness ratio = 0.4",
                                          "Bar test/Periods = 4"},
      box{"Specimen/Shape = box",    "Specimen/Radius =",       "Specimen/Width x = 6 mm",
          "Specimen/Width y = 9 mm", "Bar test/Load = bending", "Bar test/Bent along = y"};
  ASSERT_EQ(run("a", parallel).status, 0);
  EXPECT_EQ(summary("a")["effects"][0], "parallel bond");
  EXPECT_NEAR(summary("a")["tension"]["dynamic_error"].get<double>(), 0, .08);
  ASSERT_EQ(run("b", box).status, 0);
  EXPECT_NEAR(summary("b")["bounding_width_y_m"].get<double>(), 9e-3, 4e-4);
  EXPECT_LT(std::abs(summary("b")["bending"]["static_error_effective"].get<double>()), .15);

  std::ofstream spheres(folder_ / "tower.csv"); // two by two columns
  spheres << "x_m,y_m,z_m,radius_m\n";
  for (int k = 0; k < 12; ++k)
    for (const int x : {-1, 1})
      for (const int y : {-1, 1})
        spheres << x * 1e-3 << ',' << y * 1e-3 << ',' << (2 * k + 1) * 1e-3 << ",1e-3\n";
  spheres.close();
  std::vector<std::string> tower{
      "Specimen/Packing = file", "Specimen/File = tower.csv",  "Specimen/Shape = bar",
      "Specimen/Radius =",       "Specimen/Width x = 4 mm",    "Specimen/Width y = 4 mm",
      "Specimen/Height = 24 mm", "Specimen/Radius spread = 0", "Effects/Bond = parallel bond",
      "Effects/Rotation = off",  "Effects/Bond moments = off", "Bond/Stiffness ratio = 0.5",
      "Bar test/Load = tension"};
  const Outcome outcome = run("c", tower);
  ASSERT_EQ(outcome.status, 0) << outcome.error;
  const nlohmann::json c = summary("c");
  // Four straight columns: E A = 4 E_b A_b of bonds between centres, exactly.
  const double bond = 265e9 * pi * .71e-3 * .71e-3;
  EXPECT_NEAR(c["axial_rigidity_n"].get<double>(), 4 * bond, 1e-5 * bond);
  EXPECT_NEAR(c["tension"]["static_error"].get<double>(), 0, 1e-5);
  EXPECT_NEAR(c["effective_width_x_m"].get<double>(), std::sqrt(12) * 1e-3, 1e-9);
}

TEST_F(BarApp, expectations_decide_the_exit_status) {
  const std::vector<std::string> quick{"Bar test/Method = static", "Bar test/Load = tension",
                                       "Expect/tension/static_error = -10 % ... 10 %"};
  std::vector<std::string> wrong = quick;
  wrong.back() = "Expect/tension/static_error = 0.5 ... 0.6";
  EXPECT_EQ(run("a", quick).status, 0);
  EXPECT_EQ(run("b", wrong).status, 1);
  EXPECT_EQ(summary("a")["expectations"][0]["met"], true);
  EXPECT_EQ(summary("b")["expectations"][0]["met"], false);
  EXPECT_EQ(summary("b")["expectations"][0]["value"], summary("b")["tension"]["static_error"]);
  EXPECT_FALSE(summary("a")["tension"].contains("frequency_hz"));
  EXPECT_TRUE(summary("a")["energy_residual_relative"].is_null());
}

TEST_F(BarApp, what_cannot_be_is_refused_before_anything_is_written) {
  const std::pair<std::vector<std::string>, const char *> faults[] = {
      {{"Integration/Damping = 0.5"}, "Integration/Damping = 0.5 would damp what is to oscillate freely"},
      {{"Bond/Damping = 0.1"}, "Bond/Damping = 0.1 would damp"},
      {{"Effects/Gravity = on"}, "Effects/Gravity = on would load the bar"},
      {{"Effects/Bond = none", "Effects/Contact = hertz"}, "Effects/Bond = none leaves a heap of grains"},
      {{"Bar test/Load = impact", "Bar test/Method = static"}, "leaves nothing of Bar test/Load = impact"},
      {{"Bar test/End depth = 9", "Specimen/Height = 20 mm"}, "Bar test/End depth = 9 is too deep"},
      {{"Bar test/Strain = 0.5"}, "Bar test/Strain = 0.5 is out of range"},
      {{"Bar test/Periods = 1"}, "Bar test/Periods = 1 is out of range"},
      {{"Bar test/Load = shear"}, "Bar test/Load = shear"},
      {{"Integration/Time step = 1 ms"}, "Integration/Time step = 1 ms is above the limit of this bar"},
      {{"Bond/Gap = 0 m", "Specimen/Packing = advancing front", "Specimen/Radius = 1.2 mm"}, "error:"}};
  for (const auto &[entries, says] : faults) {
    const Outcome outcome = run("none", entries);
    EXPECT_EQ(outcome.status, 2) << says;
    EXPECT_TRUE(contains(outcome.error, says)) << outcome.error;
    EXPECT_FALSE(fs::exists(folder_ / "none")) << says;
  }
  EXPECT_EQ(run("none", {}, {"--resume"}).status, 2);
}

TEST_F(BarApp, a_file_that_it_reads_is_not_written_over) {
  put(folder_ / "a/specimen.csv", "0\n");
  const std::string file = (folder_ / "a/specimen.csv").string();
  for (const char *key : {"Specimen/File = ", "Phases/File = ", "Platens/Top/Mesh file = "}) {
    const Outcome outcome = run("a", {key + file}, {"--overwrite"});
    EXPECT_EQ(outcome.status, 2) << key;
    EXPECT_TRUE(contains(outcome.error, "would replace " + file + ", which it reads")) << outcome.error;
    EXPECT_EQ(content_of(file), "0\n") << key;
  }
}

TEST_F(BarApp, a_dry_run_says_what_would_be_done_and_writes_nothing) {
  std::vector<std::string> none;
  const Outcome outcome = run("a", none, {"--dry-run"});
  EXPECT_EQ(outcome.status, 0);
  for (const char *word : {"spheres", "bonds", "effective", "steps of", "clamped"})
    EXPECT_TRUE(contains(outcome.out, word)) << outcome.out;
  EXPECT_FALSE(fs::exists(folder_ / "a"));
}

} // namespace
} // namespace platen::apps::testing
