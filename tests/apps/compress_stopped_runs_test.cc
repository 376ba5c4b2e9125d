// A run that is stopped and resumed on other threads ends with the bytes of one that was not, in every set-up
// whose runs remember something beside.
#include "apps/crushed.h"

namespace platen::apps::testing {
namespace {

struct Within {
  const char *figure;
  double above, below;
};

// A run that is stopped where history.csv has so many lines, each part on other threads.
struct Stopped {
  const char *name;
  std::string scene;
  Words entries;
  std::vector<long> lines;
  int broken;                         // more bonds in tension than that
  std::vector<std::string> shows{};   // effects of the summary, and files
  std::vector<const char *> moves{};  // columns that are not 0 at the end
  std::vector<const char *> there{};  // figures that are not null
  std::vector<Within> within{};       // figures
  std::vector<const char *> absent{}; // figures, and columns
};

void PrintTo(const Stopped &of, std::ostream *out) {
  *out << of.name;
}

constexpr int none_breaks = -1;

// Of a tube that is longer than the specimen, and shorter above with a clearance.
Words pushed_out(const Words &more) {
  Words all{"Loading/Confinement = sleeve", "Sleeve/Kind = tube",           "Sleeve/Steel = S235",
            "Sleeve/Thickness = 0.5 mm",    "Sleeve/Recess = 1 mm",         "Sleeve/Bond strength = 3 MPa",
            "Sleeve/Bond slip = 5 um",      "Loading/Stop at residual = 0", "Loading/Target strain = 0.002"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Every set-up of the library, tests/coupling/conformance_test.cc stops; here are those in which a run
// remembers something beside: its peak and turns, frames of more series, how it began.
const std::vector<Stopped> stops{
    // What is found after the peak counts from where spheres lay there, which the checkpoint has to know.
    {"plain", "crushed.prm", {}, {30, 110}, 500, {}, {}, {"dead_zone_top", "final_dead_zone_top"}},
    {"explicit",
     "crushed.prm",
     {"Platens/Kind = deformable", "Platens/Motion = explicit"},
     {70},
     500,
     {},
     {"body_energy_j"},
     {},
     {},
     {"platen_unbalanced_work_j", "platen_unbalanced_work_relative"}},
    {"quasi_static",
     "crushed.prm",
     {"Platens/Kind = deformable", "Platens/Motion = quasi-static"},
     {70},
     500,
     {},
     {"body_energy_j", "platen_unbalanced_work_j"},
     {"platen_unbalanced_work_relative"},
     {{"platen_unbalanced_work_relative", -1, 0.01}}},
    // In the hydrostatic stage, and after the peak.
    {"sleeve",
     "crushed.prm",
     {"Loading/Confinement = sleeve", "Loading/Confining pressure = 20 MPa",
      "Loading/Confining ramp = 0.1 ms", "Loading/Target strain = 0.02", "Sleeve/Thickness = 1 mm"},
     {15, 110},
     500,
     {"sleeve.pvd"},
     {"body_energy_j"},
     {},
     {{"sleeve_steps_of_interval", 1, 1e9}}},
    // Before it yields, and after.
    {"tube",
     "crushed.prm",
     {"Loading/Confinement = sleeve", "Sleeve/Kind = tube", "Sleeve/Steel = S235",
      "Sleeve/Yield strength = 40 MPa", "Loading/Target strain = 0.008", "Sleeve/Thickness = 0.5 mm"},
     {5, 60},
     300,
     {"sleeve.pvd"},
     {"body_energy_j", "plastic_work_j", "tube_hoop_stress_pa"},
     {},
     {{"tube_plastic_work_j", 1e-6, 1e9}, {"largest_load_n", 1, 1e9}}},
    // Before it tears, and after.
    {"wrap",
     "crushed.prm",
     {"Loading/Confinement = sleeve", "Sleeve/Kind = wrap", "Sleeve/Modulus = 70 GPa",
      "Sleeve/Rupture strain = 0.0005", "Loading/Target strain = 0.008", "Sleeve/Thickness = 0.1 mm"},
     {5, 60},
     300,
     {"sleeve.pvd"},
     {"body_energy_j", "wrap_hoop_strain"},
     {},
     {{"wrap_torn_energy_j", 1e-9, 1e9}, {"largest_load_n", 1, 1e9}}},
    // Its bond breaks while both run: the upper platen presses the specimen, the lower one the tube.
    {"pushed_out",
     "crushed.prm",
     pushed_out({"Sleeve/Clearance = 1 mm"}),
     {20, 60},
     none_breaks,
     {"sleeve.pvd"},
     {"friction_work_j"},
     {"largest_load_n"},
     {{"tube_bonded_share", -1, 0.5}}},
    {"tube_alone",
     "crushed.prm",
     pushed_out({}),
     {20, 60},
     none_breaks,
     {"sleeve.pvd"},
     {"friction_work_j", "tube_load_n", "plastic_work_j"},
     {"largest_load_n", "energy_residual_relative"},
     {{"tube_bonded_share", -1, 0.5}}},
    // In the hydrostatic stage, and after the peak; the platen turns the rim of the sleeve.
    {"seat_and_sleeve",
     "crushed.prm",
     {"Platens/Top/Seat = spherical", "Platens/Top/Eccentricity = 0.5 mm", "Loading/Confinement = sleeve",
      "Loading/Confining pressure = 20 MPa", "Loading/Confining ramp = 0.1 ms",
      "Loading/Target strain = 0.02", "Sleeve/Thickness = 1 mm"},
     {15, 110},
     500,
     {"sleeve.pvd"},
     {"body_energy_j"},
     {"sleeve_steps_of_interval"}},
    // Areas, ramp, servo, turns of the platens: in the hydrostatic stage, and when the platens turn round.
    {"cell",
     "crushed.prm",
     {"Loading/Confinement = particles", "Loading/Confining pressure = 3 MPa", "Loading/Unload at = 0.003",
      "Loading/Unload to = 0.3"},
     {10, 130},
     300},
    // What crushed.prm leaves out: a servo, Hertz contacts with rolling, seats, gravity, scaled masses, a
    // dissipative scheme, bonds of unlike strength, phases.
    {"all_that_has_a_memory",
     "crushed.prm",
     {"Platens/Top/Control = stress", "Platens/Top/Stress = 60 MPa", "Loading/Ramp = 0.2 ms",
      "Loading/Hold = 0.2 ms", "Effects/Contact = hertz",
      "Effects/Tangential = coulomb with rolling resistance", "Contact/Rolling friction = 0.1",
      "Effects/Gravity = on", "Specimen/Seat = on", "Integration/Mass scaling = 2",
      "Integration/Scheme = tchamwa wielgosz", "Integration/Dissipation = 1.2",
      "Bond/Strength scatter = weibull", "Bond/Weibull modulus = 6", "Phases/By = radius",
      "Phases/Radius above = 0.9 mm", "Phases/Interface modulus factor = 0.7",
      "Phases/Aggregate strength factor = 2"},
     {90},
     500,
     {"hertz contact", "rolling resistance", "gravity", "seats", "mass scaling", "dissipative scheme",
      "scattered strengths", "phases"}},
    // In a hurry, and failing.
    {"in_a_hurry", "crushed.prm", {"Loading/Hurry = 4", "Loading/Axial rate = 0.1"}, {15, 60}, 300},
    {"six_sides",
     "held.prm",
     {"Platens/Friction static = 0.3", "Platens/Friction dynamic = 0.2"},
     {20},
     none_breaks},
    {"interfaces", "crushed.prm", concrete(), {60}, 500},
    {"interfaces_with_moments",
     "crushed.prm",
     concrete({"Effects/Interface moments = on", "Bond/Moment contribution = 1"}),
     {20},
     500,
     {"bond moments"}},
    // By a static solve, which is not made a second time.
    {"begun_at_a_strain", "crushed.prm", {"Loading/Start strain = 4e-4"}, {30}, 300},
    // Before the peak, and behind it.
    {"bent",
     "bent.prm",
     {},
     {38, 115},
     5,
     {},
     {"deflection_m"},
     {"strength_pa", "deflection_at_peak_m", "flexural_modulus_pa", "moment_over_nominal",
      "cracks_near_midspan"}},
    {"bent_by_its_mouth",
     "bent.prm",
     {"Specimen/Notch depth = 4 mm", "Loading/Stage 1/Axial = cmod rate 20 mm/s",
      "Loading/Stage 1/Until = cmod 40 um", "Loading/Stop at residual = 0"},
     {60, 350},
     5,
     {},
     {"cmod_m", "deflection_m"},
     {"cmod_at_peak_m", "deflection_at_peak_m", "cracks_near_midspan"}}};

class StoppedRuns : public Crushed, public ::testing::WithParamInterface<Stopped> {
protected:
  StoppedRuns() : Crushed(GetParam().scene, Frames::as_in_the_scene) {}
};

TEST_P(StoppedRuns, end_as_if_they_had_not_been_on_any_threads_and_their_energy_balance_closes) {
  const Stopped &of = GetParam();
  const nlohmann::json whole = crush("whole", of.entries, {"-t", "1"});
  EXPECT_GT(whole["broken_tension"], of.broken);
  EXPECT_LT(whole["energy_residual_relative"], 0.01);
  for (const std::string &shown : of.shows)
    EXPECT_TRUE(has(whole["effects"], shown) || fs::exists(folder_ / "whole" / shown)) << shown;
  for (const char *name : of.moves)
    EXPECT_NE(column("whole", name).back(), 0) << name;
  for (const char *figure : of.there)
    EXPECT_FALSE(whole.at(figure).is_null()) << figure;
  for (const Within &one : of.within) {
    EXPECT_GT(whole.at(one.figure), one.above) << one.figure;
    EXPECT_LT(whole.at(one.figure), one.below) << one.figure;
  }
  for (const char *name : of.absent) {
    EXPECT_FALSE(whole.contains(name));
    EXPECT_FALSE(contains(content_of(folder_ / "whole/history.csv"), name));
  }
  Words options{"-t", "2"};
  int signal = SIGTERM;
  for (const long lines : of.lines) {
    EXPECT_EQ(stop_at("stopped", lines, signal, of.entries, options), 128 + signal);
    EXPECT_EQ(summary_in(folder_ / "stopped")["status"], "stopped");
    options = {"-t", "1", "--resume"}, signal = SIGHUP;
  }
  crush("stopped", of.entries, {"-t", "4", "--resume"});
  expect_same("whole", "stopped");
}

INSTANTIATE_TEST_SUITE_P(Determinism, StoppedRuns, ::testing::ValuesIn(stops),
                         [](const auto &of) { return of.param.name; });

} // namespace
} // namespace platen::apps::testing
