// Bare numbers that nobody means: 5 for 5 MPa, 100 for 100 mm. Each entry of that unit refuses them, in lists
// and lists of lists too, with the unit that was perhaps meant.
#include <gtest/gtest.h>

#include <map>

#include <filesystem>

#include "apps/programs.h"
#include "apps/scene/declare.h"
#include "apps/scene/errors.h"
#include "apps/scene/scene.h"

namespace platen::apps {
namespace {

const std::string good = (std::filesystem::path(PLATEN_TEST_DATA) / "fragment" / "good.prm").string();

std::string message_of(const std::vector<std::string> &overrides,
                       const apps::Program &app = program("compress")) {
  try {
    read_scene(good, overrides, app);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

TEST(MeantUnits, a_bare_number_that_no_test_has_is_refused_with_the_unit_that_was_meant) {
  const std::string pascal = " is a bare number, which is in Pa. Did you mean ",
                    item_pascal = "that is a bare number, which is in Pa. Did you mean ",
                    item_metre = "that is a bare number, which is in m. Did you mean ";
  const struct {
    std::vector<std::string> entries;
    std::string says;
    std::string app = "compress";
  } cases[] = {
      {{"Loading/Confinement = particles", "Loading/Confining pressure = 5"},
       "Loading/Confining pressure = 5" + pascal + "\"5 MPa\"? If not, write \"5 Pa\"."},
      {{"Study/Confining pressure list = 0, 5, 10, 20"},
       "holds an item, \"5\", " + item_pascal + "\"5 MPa\"? If not, write \"5 Pa\".",
       "study"},
      {{"Study/Confining pressure list = 0, 5 MPa, 10"},
       "holds an item, \"10\", " + item_pascal + "\"10 MPa\"?",
       "study"},
      {{"Study/Domain list = 72 x 22.5"},
       "holds an item, \"72 x 22.5\", " + item_metre + "\"72 mm\"?",
       "study"},
      {{"Study/Domain list = 72 mm x 22.5"},
       "holds an item, \"72 mm x 22.5\", " + item_metre + "\"22.5 mm\"? If not, write \"22.5 m\".",
       "study"},
      {{"Study/Sphere radius list = 1 mm, 2"}, "holds an item, \"2\", " + item_metre + "\"2 mm\"?", "study"},
      {{"Bond/Modulus = 40"},
       "Bond/Modulus = 40" + pascal + "\"40 MPa\" or \"40 GPa\"? If not, write \"40 Pa\"."},
      {{"Bond/Modulus = 30000"}, "Bond/Modulus = 30000" + pascal + "\"30000 MPa\" or \"30000 GPa\"?"},
      {{"Bond/Tensile strength = 8.9"}, "Bond/Tensile strength = 8.9" + pascal + "\"8.9 MPa\"?"},
      {{"Bond/Compression limits = 1 GPa, 2 GPa, 3"}, "holds an item, \"3\", " + item_pascal + "\"3 MPa\"?"},
      {{"Specimen/Radius = 25"},
       "Specimen/Radius = 25 is a bare number, which is in m. Did you mean \"25 mm\"? If not, write \"25 "
       "m\"."},
      {{"Loading/Stage 1/Axial = stress 30"}, "Stage 1/Axial = stress 30" + pascal + "\"30 MPa\"?"},
      {{"Loading/Stage 1/Until = strain 0.1 %, Left stress 30"}, "Left stress 30" + pascal + "\"30 MPa\"?"},
      {{"Platens/Layers = rubber 2, steel 20 mm"},
       "holds a layer, \"rubber 2\", " + item_metre + "\"2 mm\"?"},
      {{"Platens/Layer materials = rubber: 5, 0.49, 1100"},
       "has a Young modulus, \"5\", " + item_pascal + "\"5 MPa\" or \"5 GPa\"?"},
      {{"Expect/strength_pa = 35 ... 50 MPa"}, "strength_pa = 35 ... 50 MPa" + pascal + "\"35 MPa\"?"},
      {{"Expect/strength_pa = ... 50"}, "strength_pa = ... 50" + pascal + "\"50 MPa\"?"},
      {{"Expect/youngs_modulus_gauge_pa = 20 ... 30"}, pascal + "\"20 MPa\" or \"20 GPa\"?"},
      {{"Calibrate/Target 1 = strength_pa: 40"},
       "Calibrate/Target 1 = strength_pa: 40" + pascal + "\"40 MPa\"?",
       "calibrate"},
      {{"Calibrate/Target 1 = young modulus: 40"}, pascal + "\"40 MPa\" or \"40 GPa\"?", "calibrate"}};
  for (const auto &one : cases) {
    const std::string message = message_of(one.entries, program(one.app));
    EXPECT_NE(message.find(one.says), std::string::npos) << message << "\n not: " << one.says;
  }
}

// Whatever is declared in one of these units refuses such a number; a new entry does so by itself.
TEST(MeantUnits, every_entry_of_the_unit_refuses_it) {
  int stresses = 0, lengths = 0;
  std::map<std::string, const apps::Program *> read_by; // of each entry one that has it
  for (const apps::Program &of : programs()) {
    const Scene scene = default_scene(of);
    for (const Entry &entry : scene.parameters->entries())
      read_by.emplace(entry.path, &of);
  }
  for (const auto &[path, of] : read_by) {
    const Scene scene = default_scene(*of);
    const Entry &entry = scene.parameters->at(path);
    const bool stress = entry.unit == "Pa", length = entry.unit == "m";
    if ((!stress && !length) || entry.path == "Platens/Mesh unit") continue;
    const bool range = entry.path.rfind("Expect/", 0) == 0, domain = entry.path == "Study/Domain list";
    const std::string number = stress ? "7" : "12", value = range    ? "... " + number
                                                            : domain ? "12 x 12"
                                                                     : number;
    const std::string message = message_of({entry.path + " = " + value}, *of);
    EXPECT_NE(message.find("is a bare number, which is in " + entry.unit), std::string::npos)
        << entry.path << ": " << message;
    ++(stress ? stresses : lengths);
  }
  EXPECT_GT(stresses, 30);
  EXPECT_GT(lengths, 20);
}

TEST(MeantUnits, what_tests_have_and_what_has_a_unit_is_taken) {
  for (const std::vector<std::string> &entries : std::vector<std::vector<std::string>>{
           {"Specimen/Radius = 0.005", "Specimen/Height = 0.01", "Specimen/Sphere radius = 1e-3"},
           {"Bond/Modulus = 4e10", "Bond/Tensile strength = 9e6", "Bond/Shear strength = 30e6"},
           {"Loading/Confinement = particles", "Loading/Confining pressure = 2000"},
           {"Loading/Confinement = particles", "Loading/Confining pressure = 50 Pa"},
           {"Bond/Modulus = 100000", "Bond/Tensile strength = 1000", "Bond/Shear strength = 1000",
            "Loading/Axial rate = 1 mm/s"},
           {"Specimen/Radius = 5 m", "Specimen/Height = 10 m", "Specimen/Sphere radius = 1 m",
            "Loading/Axial rate = 1 m/s"},
           {"Platens/Mesh unit = 1"},
           {"Platens/Thickness = 0"},
           {"Platens/Thickness = 0.999"},
           {"Expect/strength_pa = 0 ... 40 MPa"}})
    EXPECT_EQ(message_of(entries), "") << entries.front();
}

TEST(MeantUnits, a_pressure_that_strains_nothing_is_refused_beside_the_modulus) {
  const std::string says = " of Bond/Modulus = 40 GPa. Allowed: 0, or 1e-09 ... 0.1 of it.";
  EXPECT_NE(message_of({"Loading/Confinement = particles", "Loading/Confining pressure = 5 Pa"})
                .find("Loading/Confining pressure = 5 Pa is 1.25e-10" + says),
            std::string::npos);
  EXPECT_NE(message_of({"Loading/Stage 1/Axial = stress 5 mPa", "Loading/Stage 1/Until = settled"})
                .find("Loading/Stage 1/Axial = stress 5 mPa is 1.25e-13" + says),
            std::string::npos);
  EXPECT_NE(message_of({"Loading/Stage 1/Axial = stress 30 GPa", "Loading/Stage 1/Until = settled"})
                .find("Loading/Stage 1/Axial = stress 30 GPa is 0.75" + says),
            std::string::npos);
}

} // namespace
} // namespace platen::apps
