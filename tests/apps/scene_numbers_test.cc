// Numbers with units, against values worked out by hand from the definitions of the units; and numbers that
// nobody means: 5 for 5 MPa, 100 for 100 mm (tests/apps/faulty.txt has the words).
#include <cmath>
#include <locale>
#include <map>

#include "apps/read_scenes.h"
#include "apps/scene/declare.h"
#include "apps/scene/units.h"
#include "apps/scene/values.h"
#include "apps/scratch_folder.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

using namespace testing;

struct Conversion {
  const char *text, *unit;
  double expected;
};

// Tolerance: the text, the factor and their product are each rounded once, 4 units of the last place in all.
TEST(SceneUnits, quantities_become_si) {
  const Conversion conversions[] = {{"1.25 mm", "m", 0.00125},
                                    {"1.25mm", "m", 0.00125},
                                    {"0.00125", "m", 0.00125},
                                    {"5 µm", "m", 5e-6},
                                    {"5 um", "m", 5e-6},
                                    {"2 inches", "m", 0.0508},
                                    {"30 degree", "rad", pi / 6},
                                    {"30 deg", "rad", pi / 6},
                                    {"30°", "rad", pi / 6},
                                    {"0.5", "rad", 0.5},
                                    {"0.03 mm/ms", "m/s", 0.03},
                                    {"36 km/h", "m/s", 10},
                                    {"8.9 MPa", "Pa", 8.9e6},
                                    {"320 GPa", "Pa", 320e9},
                                    {"1 N/mm2", "Pa", 1e6},
                                    {"2400 kg/m3", "kg/m3", 2400},
                                    {"2.4e-6 kg/mm3", "kg/m3", 2400},
                                    {"2.4 g/cm3", "kg/m3", 2400},
                                    {"2400 kg m-3", "kg/m3", 2400},
                                    {"1e-3 kJ/m2", "J/m2", 1},
                                    {"5 %", "1", 0.05},
                                    {"0.1 t/m3", "kg/m3", 100},

                                    {"10 min", "s", 600},
                                    {"50 N/m", "N/m", 50},
                                    {"4 kN/mm", "N/m", 4e6},
                                    {"20 %", "1", 0.2},
                                    {"+3.5e-2", "1", 0.035},
                                    {"-2 kN", "N", -2000},
                                    {"0.5 rad", "degree", 90 / pi}};
  for (const Conversion &c : conversions)
    EXPECT_DOUBLE_EQ(to_si(c.text, c.unit), c.expected) << c.text;
}

struct Refusal {
  const char *text, *unit, *reason;
};

TEST(SceneUnits, what_is_no_quantity_is_refused_with_its_reason) {
  const Refusal refusals[] = {
      {"", "m", "has no value"},
      {"abc", "m", "is not a number"},
      {"-", "m", "is not a number"},
      {"+-1", "m", "is not a number"},
      {"inf", "m", "is not a finite number"},
      {"-infinity", "m", "is not a finite number"},
      {"nan", "m", "is not a finite number"},
      {"1e999", "m", "is too large or too small"},
      {"1e-999", "m", "is too large or too small"},
      {"1e308 km", "m", "is not a finite number"},
      {"1,25 mm", "m", "the decimal sign is a point"},
      {"5 m", "Pa", "which is not that of a pressure (Pa)"},
      {"5 m2", "m", "which is not that of a length (m)"},
      {"5 kg", "kg/m3", "which is not that of a density (kg/m3)"},
      {"5 degree", "1", "which is not that of a plain number"},
      {"5 %", "rad", "which is not that of an angle (rad)"},
      {"5 mmm", "m", "which is not known"},
      {"5 Gpa", "Pa", "has the unit \"Gpa\", which is not known. Did you mean \"GPa\"?"},
      {"5 mpa", "Pa", "Did you mean \"MPa\"?"},
      {"5 MPA", "Pa", "Did you mean \"MPa\"?"},
      {"5 KPa", "Pa", "Did you mean \"kPa\"?"},
      {"5 Mpa", "Pa", "Did you mean \"MPa\"?"},
      {"5 MM", "m", "Did you mean \"mm\"?"},
      {"5 KN", "N", "Did you mean \"kN\"?"},
      {"5 Kg/m3", "kg/m3", "Did you mean \"kg/m3\"?"},
      {"5 m 5", "m", "which is not known"},
      {"5 6", "1", "which is not known"},
      {"0x10", "m", "which is not known"},
      {"5 days since 2000", "s", "which is not known"},
      {"5 lg(re 1 mW)", "1", "which is not known"},
      {"5 m(", "m", "which is not known"}};
  for (const Refusal &r : refusals)
    try {
      to_si(r.text, r.unit);
      ADD_FAILURE() << r.text << " was read";
    } catch (const ValueError &error) {
      EXPECT_TRUE(contains(error.what(), r.reason)) << r.text << " " << error.what();
    }
}

// A decimal comma, as in a German locale, in C++ streams and, where the machine has such a locale, in C too.
TEST(SceneUnits, numbers_do_not_depend_on_the_locale) {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  const std::string c_before = setlocale(LC_NUMERIC, nullptr);
  for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8"})
    if (setlocale(LC_NUMERIC, name) != nullptr) break;
  EXPECT_EQ(to_si("1.25 mm", "m"), 0.00125);
  EXPECT_EQ(shortest_text(1234567.5), "1234567.5");
  setlocale(LC_NUMERIC, c_before.c_str());
  std::locale::global(before);
}

TEST(SceneUnits, shortest_texts_read_back_to_the_same_bits) {
  for (const double value : {0.1, 1.0 / 3, 17e9, 200e9, 1e6, 1e-6, 2.5e-300, 1.7976931348623157e308, -4e-7})
    EXPECT_EQ(to_si(shortest_text(value), "1"), value) << shortest_text(value);
  EXPECT_EQ(shortest_text(1e6), "1e6");
  EXPECT_EQ(shortest_text(1e-6), "1e-6");
  EXPECT_EQ(shortest_text(not_given), "");
}

TEST(SceneValues, intervals_are_steps_or_times) {
  EXPECT_EQ(read_interval("500").kind, Interval::Kind::steps);
  EXPECT_EQ(read_interval("500").value, 500);
  EXPECT_EQ(read_interval("0.1 ms").kind, Interval::Kind::time);
  EXPECT_DOUBLE_EQ(read_interval("0.1 ms").value, 1e-4);
  EXPECT_EQ(read_interval("0").kind, Interval::Kind::none);
  EXPECT_THROW(read_interval("0.5"), ValueError);
}

TEST(SceneValues, gaps_are_lengths_or_multiples_of_the_smaller_radius) {
  EXPECT_DOUBLE_EQ(read_gap("0.05 R_min").length(2e-3), 1e-4);
  EXPECT_DOUBLE_EQ(read_gap("0.1 mm").length(2e-3), 1e-4);
  EXPECT_DOUBLE_EQ(read_gap("1e-4").length(2e-3), 1e-4);
}

TEST(SceneValues, stiffnesses_name_what_they_are_multiples_of) {
  EXPECT_EQ(read_stiffness("2", true).kind, Stiffness::Kind::of_bond);
  EXPECT_EQ(read_stiffness("4e5 N/m", true).kind, Stiffness::Kind::absolute);
  EXPECT_EQ(read_stiffness("4e5 N/m", true).value, 4e5);
  EXPECT_EQ(read_stiffness("0.01 bulk", true).kind, Stiffness::Kind::of_bulk);
  EXPECT_THROW(read_stiffness("0.01 bulk", false), ValueError);
}

TEST(SceneValues, expectations_may_be_open_on_one_side) {
  const auto read = [](const char *text, const char *unit) {
    return read_expectation(text, unit, Quantity("", unit, any_number()));
  };
  EXPECT_DOUBLE_EQ(read("35 MPa ... 50 MPa", "Pa").low, 35e6);
  EXPECT_DOUBLE_EQ(read("35 MPa ... 50 MPa", "Pa").high, 50e6);
  EXPECT_EQ(read("... 0.1", "1").low, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(read("0.9 ...", "1").high, std::numeric_limits<double>::infinity());
  EXPECT_THROW(read("...", "1"), ValueError);
  EXPECT_DOUBLE_EQ(read("16 ... 37", "degree").high, 37);
}

TEST(SceneValues, lists_are_parted_by_commas) {
  const Quantity pascals("", "Pa", above(0));
  EXPECT_EQ(read_list("1 GPa, 2 GPa,3e9", pascals), (std::vector<double>{1e9, 2e9, 3e9}));
  EXPECT_TRUE(read_list("", pascals).empty());
  EXPECT_THROW(read_list("1 GPa,, 2 GPa", pascals), ValueError);
  EXPECT_THROW(read_list("1 GPa, -2 GPa", pascals), ValueError);
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
    EXPECT_TRUE(testing::contains(said_with({entry.path + " = " + value}, of->name),
                                  "is a bare number, which is in " + entry.unit))
        << entry.path;
    ++(stress ? stresses : lengths);
  }
  EXPECT_GT(stresses, 30);
  EXPECT_GT(lengths, 20);
}

TEST(MeantUnits, what_tests_have_and_what_has_a_unit_is_taken) {
  for (const Entries &entries : std::vector<Entries>{
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
           {"Expect/strength_pa = 0 ... 40 MPa"},
           // A gel of micrometre grains, a rock face of metres, atoms of a diamond lattice, masses that are
           // scaled.
           {"Bond/Modulus = 10 Pa", "Bond/Tensile strength = 5 Pa", "Bond/Shear strength = 5 Pa",
            "Specimen/Sphere radius = 1 um", "Specimen/Radius = 10 um", "Specimen/Height = 20 um",
            "Material/Density = 1000", "Loading/Axial rate = 1 um/s"},
           {"Specimen/Sphere radius = 1 m", "Specimen/Radius = 50 m", "Specimen/Height = 100 m",
            "Loading/Axial rate = 1 m/s"},
           {"Bond/Modulus = 1 TPa", "Bond/Tensile strength = 100 GPa", "Specimen/Sphere radius = 1 nm",
            "Specimen/Radius = 10 nm", "Specimen/Height = 20 nm", "Material/Density = 3500",
            "Loading/Axial rate = 1 m/s"},
           {"Material/Density = 1e7", "Loading/Axial rate = 1 mm/s"}})
    EXPECT_EQ(said_with(entries), "") << entries.front();
}

} // namespace
} // namespace platen::apps
