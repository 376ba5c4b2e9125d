// What is told of a state that was just read is what was told of it before it was written: energies, stresses
// and every column of a sample, without a step between.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/programs.h"
#include "apps/run/history.h"
#include "apps/run/problem_setup.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/scene.h"
#include "base/state.h"
#include "tests/same_state.h"

namespace platen::apps {
namespace {

struct Case {
  std::string name, scene;
  std::vector<std::string> overrides;
  std::vector<std::string> moves; // columns that are not zero in it
};

// Of every part that keeps a number between steps, one.
const std::vector<Case> cases{
    {"friction and breaks", "crushed.prm", {}, {"contact_energy_j", "friction_work_j", "fracture_work_j"}},
    {"seats", "crushed.prm", {"Specimen/Seat = on"}, {"contact_energy_j"}},
    {"rolling",
     "crushed.prm",
     {"Effects/Tangential = coulomb with rolling resistance", "Contact/Rolling friction = 0.2"},
     {"contact_energy_j"}},
    {"hertz", "crushed.prm", {"Effects/Contact = hertz", "Platens/Contact = hertz"}, {"contact_energy_j"}},
    {"slip weakening",
     "crushed.prm",
     {"Platens/Friction law = slip weakening", "Platens/Slip length = 10 um"},
     {"friction_work_j"}},
    {"wall",
     "crushed.prm",
     {"Loading/Test = uniaxial strain"},
     {"contact_energy_j", "confining_pressure_pa"}},
    {"skin",
     "crushed.prm",
     {"Loading/Confinement = particles", "Loading/Confining pressure = 2 MPa"},
     {"confining_pressure_pa", "boundary_work_j"}},
    {"sleeve",
     "crushed.prm",
     {"Loading/Confinement = sleeve", "Loading/Confining pressure = 2 MPa", "Sleeve/Thickness = 1 mm",
      "Sleeve/Modulus = 2 MPa"},
     {"confining_pressure_pa", "sleeve_deviator_pa", "body_energy_j", "contact_energy_j"}},
    {"elastic platens",
     "crushed.prm",
     {"Platens/Kind = deformable", "Platens/Thickness = 4 mm"},
     {"body_energy_j"}},
    {"elastic platens without inertia",
     "crushed.prm",
     {"Platens/Kind = deformable", "Platens/Thickness = 4 mm", "Platens/Motion = quasi-static"},
     {"body_energy_j", "platen_unbalanced_work_j"}},
    {"machine",
     "crushed.prm",
     {"Platens/Machine stiffness = 1e8 N/m"},
     {"machine_energy_j", "machine_closure_m"}},
    {"seat that turns", "crushed.prm", {"Platens/Top/Seat = spherical"}, {"contact_energy_j"}},
    {"six sides",
     "held.prm",
     {"Platens/Friction static = 0.2", "Platens/Friction dynamic = 0.2"},
     {"stress_left_pa", "friction_work_left_j"}},
    {"disc", "split.prm", {}, {"opening_m"}},
    {"bar", "bent.prm", {}, {"deflection_m", "midspan_moment_n_m"}},
    {"notched bar",
     "bent.prm",
     {"Specimen/Notch depth = 4 mm", "Specimen/Notch width = 1 mm",
      "Loading/Stage 1/Axial = cmod rate 20 mm/s", "Loading/Stage 1/Until = cmod 30 um"},
     {"cmod_m", "deflection_m"}},
    {"bonds that soften",
     "crushed.prm",
     {"Effects/Bond = elasto damage plastic", "Bond/Poisson ratio = 0.2", "Bond/Friction static = 0.9",
      "Bond/Friction dynamic = 0.25", "Bond/Compression limits = 20 MPa, 45 MPa, 70 MPa",
      "Bond/Compression slopes = 3, 12, 22"},
     {"fracture_work_j"}},
    {"bonds that yield",
     "crushed.prm",
     {"Effects/Bond = yielding parallel bond", "Bond/Compression limits = 5 MPa, 10 MPa, 20 MPa",
      "Bond/Compression slopes = 2, 4, 8"},
     {"plastic_work_j"}},
    {"facets",
     "crushed.prm",
     {"Effects/Bond = facet", "Bond/Tensile strength = 4 MPa", "Bond/Shear strength = 11 MPa",
      "Bond/Fracture energy = 20 J/m2", "Bond/Friction static = 0.2", "Bond/Friction dynamic = 0.6",
      "Bond/Gap = 0.6 R_min", "Bond/Compression limits = 5 MPa, 10 MPa, 20 MPa",
      "Bond/Compression slopes = 2, 4, 8"},
     {"plastic_work_j"}}};

class ToldAfterRead : public ::testing::TestWithParam<Case> {};

TEST_P(ToldAfterRead, is_what_was_told_before) {
  const Case &of = GetParam();
  const std::filesystem::path file = std::filesystem::path(PLATEN_TEST_SCENES) / of.scene;
  std::vector<std::string> overrides = of.overrides;
  if (of.scene != "bent.prm") overrides.push_back("Specimen/Sphere radius = 1.5 mm");
  const Scene scene =
      read_scene(file.string(), overrides, of.name == "disc" ? program("brazilian") : program("compress"));
  dem::Specimen specimen = make_bonded_specimen(scene);
  if (of.name == "disc") specimen = dem::laid_down(specimen);
  specimen = dem::notched(specimen, scene.specimen.notch);
  const coupling::PlatenTestSettings settings = problem_settings(scene);
  coupling::PlatenTest run(specimen, settings);
  const Sampler sampler(run);
  while (run.steps() < 900 && !run.program().finished())
    run.advance(100);
  coupling::PlatenTest read(specimen, settings);
  set_state(read, state_of(run));
  const Sampler of_read(read);

  Sample before = sampler(run), after = sampler(read);
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t k = 0; k < history_columns().size(); ++k) {
    const HistoryColumn &column = history_columns()[k];
    const double told = value_of(before, k), now = value_of(after, k);
    EXPECT_TRUE(same(told, now)) << column.name << ": " << told << " before, " << now << " after";
    if (std::count(of.moves.begin(), of.moves.end(), column.name) > 0) {
      EXPECT_NE(told, 0) << column.name << ": shows nothing";
    }
  }
  for (const coupling::Side side : coupling::all_sides) {
    const coupling::Platen *one = run.platen(side), *other = read.platen(side);
    if (one == nullptr) continue;
    EXPECT_EQ(one->layer().elastic_energy(), other->layer().elastic_energy()) << coupling::name_of(side);
    EXPECT_EQ(one->layer().closed, other->layer().closed) << coupling::name_of(side);
  }
  const dem::EnergyLedger was = run.energy(), is = read.energy();
  EXPECT_EQ(was.contacts, is.contacts);
  EXPECT_EQ(was.residual(), is.residual());
}

std::string name_of_case(const ::testing::TestParamInfo<Case> &info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Parts, ToldAfterRead, ::testing::ValuesIn(cases), name_of_case);

// A state that was written before these numbers were kept says that it does not know them.
TEST(ToldAfterReadOfOlderStates, is_no_number_until_the_next_step) {
  const std::filesystem::path file = std::filesystem::path(PLATEN_TEST_SCENES) / "crushed.prm";
  const Scene scene =
      read_scene(file.string(), {"Specimen/Sphere radius = 1.5 mm", "Loading/Test = uniaxial strain"},
                 program("compress"));
  const dem::Specimen specimen = make_bonded_specimen(scene);
  coupling::PlatenTest run(specimen, problem_settings(scene)), read(specimen, problem_settings(scene));
  run.advance(300);
  State older = state_of(run);
  for (const char *block :
       {"contacts/elastic_energy", "springs/elastic_energy", "springs/force", "unbalanced"})
    older = without(older, block);
  set_state(read, older);
  EXPECT_TRUE(std::isnan(read.energy().contacts));
  EXPECT_TRUE(std::isnan(read.confining_pressure()));
  EXPECT_TRUE(std::isnan(read.unbalanced_ratio()));
  EXPECT_NO_THROW(set_state(read, state_of(read))); // written again before a step
  run.advance(1), read.advance(1);
  EXPECT_EQ(run.energy().contacts, read.energy().contacts);
  EXPECT_EQ(run.confining_pressure(), read.confining_pressure());
  EXPECT_EQ(run.unbalanced_ratio(), read.unbalanced_ratio());
}

} // namespace
} // namespace platen::apps
