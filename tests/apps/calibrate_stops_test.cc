// What platen-calibrate refuses, gives up, and takes up again.
#include <chrono>
#include <csignal>
#include <thread>

#include "apps/output/stop_signal.h"
#include "apps/program.h"
#include "calibrate_app.h"

namespace platen::apps {
namespace {

TEST_F(CalibrateApp, a_search_that_was_cut_off_goes_on_to_the_same_answer) {
  const auto entries = [](const char *poisson) {
    return asked({std::string("poisson ratio: ") + poisson, "tension: 3 MPa"}, {"Tolerance = 0.05"});
  };
  run(entries("0.12"), "a", false, 2);
  const std::string found = text_in("a/found.prm"), trials = text_in("a/trials.csv");
  const fs::path one = folder / "a/runs/trial_2_tensile_strength_pa_seed_5/summary.json";
  ASSERT_TRUE(fs::exists(one));
  fs::remove(one);
  for (const char *file : {"found.prm", "trials.csv", "summary.json"})
    fs::remove(folder / "a" / file);
  run(entries("0.12"), "a", true);
  EXPECT_TRUE(fs::exists(one));
  EXPECT_EQ(text_in("a/found.prm"), found);
  EXPECT_EQ(text_in("a/trials.csv"), trials);
  const auto refused = [&](const std::string &to) {
    return testing::message_of<InputError>([&] { run(entries("0.13"), to, true); });
  };
  EXPECT_TRUE(contains(refused("a"),
                       "Calibrate/Target 1 = poisson ratio: 0.13 was poisson ratio: 0.12 when the run began"))
      << refused("a");
  EXPECT_TRUE(contains(refused("b"), "b/scene.prm: error: is missing: the folder holds nothing to resume"))
      << refused("b");
}

// A test of minutes is given up, not waited for; what was written before is there to go on with.
TEST_F(CalibrateApp, a_signal_ends_it_within_a_trial) {
  const fs::path table = folder / "a/trials.csv";
  Texts command{PLATEN_CALIBRATE_PROGRAM, "case.prm", "-o", "a", "-t", "1", "--quiet"};
  for (const std::string &entry : asked({"young modulus: 17 GPa", "strength_pa: 40 MPa"},
                                        {"Loading/Axial rate = 1e-4 m/s", "Loading/Target strain = 0.2"}))
    command.insert(command.end(), {"-s", entry});
  testing::Program program(command, folder);
  ASSERT_TRUE(program.wait_until([&] {
    return fs::exists(table) && contains(content_of(table), "elastic,");
  })) << text_in("error");
  std::this_thread::sleep_for(std::chrono::milliseconds(300)); // after the static solves the trial begins
  program.send(SIGTERM);
  EXPECT_EQ(program.wait(), exit_status_of_signal(SIGTERM)) << text_in("error");
  const std::string rows = content_of(table);
  EXPECT_TRUE(contains(rows, "elastic,"));
  EXPECT_FALSE(contains(rows, "compressive_strength_pa,")) << rows;
  EXPECT_FALSE(fs::exists(folder / "a/summary.json"));
}

TEST_F(CalibrateApp, runs_without_a_peak_are_counted_and_not_fatal) {
  const auto s = run(asked_of_one({"strength_pa: 20 MPa"},
                                  {"Bond/Tensile strength = 30 MPa", "Bond/Shear strength = 120 MPa",
                                   "Loading/Target strain = 0.006", "Loading/Axial rate = 0.04 m/s"}),
                     "a");
  EXPECT_GT(s["failed_trials"].get<int>(), 0);
  EXPECT_EQ(s["status"], "done");
  EXPECT_NEAR(s["strength_pa"].get<double>(), 20e6, 2e6);
  EXPECT_TRUE(contains(text_in("a/trials.csv"), "no peak"));
}

// What a fast test bears is not the specimen's strength: no bonds are found by it.
TEST_F(CalibrateApp, trials_that_are_too_fast_do_not_count) {
  const auto at = [](const char *rate) {
    return asked_of_one({"strength_pa: 40 MPa", "young modulus: 24 GPa"},
                        {std::string("Loading/Axial rate = ") + rate});
  };
  const std::string says = testing::message_of<NumericsError>([&] { run(at("0.8 m/s"), "fast"); });
  for (const char *part : {"no trial counts, too fast to be quasi-static", "wave crossings to the peak",
                           "A lower Loading/Axial rate helps"})
    EXPECT_TRUE(contains(says, part)) << says;
  const std::string rows = text_in("fast/trials.csv");
  const auto compression = rows.find("\ncompressive_strength_pa");
  ASSERT_NE(compression, std::string::npos) << rows;
  EXPECT_NE(rows.find("too fast to be quasi-static", compression), std::string::npos) << rows;
  EXPECT_EQ(rows.find("\ncompressive_strength_pa", compression + 1), std::string::npos)
      << rows; // one is enough
  // Before anything is packed the dry run says so, and of a slow one nothing.
  const std::string fast = dry_run(at("0.8 m/s")), slow = dry_run(at("0.05 m/s"));
  EXPECT_TRUE(contains(fast, "too fast to be quasi-static: such trials do not count")) << fast;
  EXPECT_TRUE(contains(fast, "A lower Loading/Axial rate helps: 0.")) << fast;
  EXPECT_FALSE(contains(slow, "too fast")) << slow;
}

// A run that is believed on --resume is one that was written so.
TEST_F(CalibrateApp, a_resumed_one_makes_again_what_was_edited) {
  const Texts entries = asked({"strength_pa: 40 MPa"}, {"Verification seeds = 0", "Most trials = 1"});
  const auto whole = run(entries, "a");
  EXPECT_EQ(whole["trials"], 4); // a run and a static solve on each packing
  EXPECT_EQ(run(entries, "a", true)["trials"], 2);
  std::ofstream(folder / "a/runs/trial_1_compressive_strength_pa_seed_5/scene.prm", std::ios::app)
      << "# more\n";
  const auto again = run(entries, "a", true);
  EXPECT_EQ(again["trials"], 3);
  EXPECT_EQ(again["training"], whole["training"]);
  EXPECT_TRUE(contains(text_in("a/run.log"), "trial_1_compressive_strength_pa_seed_5: is made again"));
}

TEST_F(CalibrateApp, faults_are_refused) {
  const std::string tension = "tension: 3 MPa";
  for (const auto &[entries, says] : std::vector<std::pair<Texts, const char *>>{
           {asked({}), "Calibrate/Mode = search has nothing to search for"},
           {asked({"young modulus: 5 m"}), "Calibrate/Target 1"},
           {asked({"poisson ratio: 0.2"}, {"Smallest stiffness ratio = 2"}),
            "is not below Calibrate/Largest stiffness ratio"},
           {asked({tension}, {"Smallest contact friction = 2"}),
            "is not below Calibrate/Largest contact friction"},
           {asked({tension}, {"Bond/Tensile strength = unbreakable"}), "is no number that the search"},
           {asked({tension, "strength_pa: 2 MPa"}),
            "tension: 3 MPa is not below Calibrate/Target 2 = strength_pa: 2 MPa"},
           {asked({}, {"Mode = abacus", "Poisson ratio list = 0.2"}), "is for beams"},
           {asked({}, {"Mode = bounds", "Effects/Bond = none"}), "Effects/Bond"},
           {asked({}, {"Young modulus = 25 GPa"}),
            "is not a parameter. Allowed: Calibrate/Target 1 = young modulus: 25 GPa."},
           {asked({tension}, {"Smallest moment contribution = 0.5"}), "above the bond's own"},
           {asked({tension}, {"Largest friction angle = 30 degree"}), "below the bond's own"},
           {asked({tension}, {"Effects/Bond = elasto damage plastic", "Largest friction angle = 60 degree"}),
            "needs a bond with a friction angle"}}) {
    const std::string fault = testing::message_of<InputError>([&, &of = entries] { read(of); });
    EXPECT_TRUE(contains(fault, says)) << fault;
  }
  EXPECT_NO_THROW(read(asked({}, {"Mode = bounds", "Loading/Axial rate ="})));
  // What only a test shows is refused before anything is written.
  for (const Texts &entries : {asked({"curve 1"}, {"Curve 1 = " + (folder / "case.prm").string()}),
                               asked({"strength_pa: 20 MPa"}, {"Loading/Axial rate ="}),
                               asked({"strength_pa at Loading/Confining pressure = 4 MPa: 50 MPa"}),
                               asked({"strength_pa at Specimen/Hight = 4 mm: 50 MPa"})})
    EXPECT_THROW(run(entries, "a"), InputError) << entries[0];
  EXPECT_FALSE(fs::exists(folder / "a"));
  // Tests with speeds of their own need no other.
  dry_run(asked({"strength_pa at Loading/Axial rate = 0.02 m/s: 50 MPa", "tension: 4 MPa"},
                {"Tension rate = 0.01 m/s", "Loading/Axial rate ="}));
}

} // namespace
} // namespace platen::apps
