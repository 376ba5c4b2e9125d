// Set-ups that say something else than they mean: units a thousandfold off, numbers in each other's place,
// numbers that no matter has. Each is refused before anything is packed, by the entries that do not go
// together.
#include <gtest/gtest.h>

#include <filesystem>

#include "apps/programs.h"
#include "apps/scene/declare.h"
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

struct Absurd {
  std::vector<std::string> overrides;
  std::vector<std::string> says;
  std::string app = "compress";
};

void expect_refused(const std::vector<Absurd> &all) {
  for (const Absurd &one : all) {
    const std::string message = message_of(one.overrides, program(one.app));
    EXPECT_NE(message, "") << one.overrides.back();
    for (const std::string &fragment : one.says)
      EXPECT_NE(message.find(fragment), std::string::npos) << message << "\n not: " << fragment;
  }
}

TEST(AbsurdScenes, no_entry_takes_what_no_matter_has) {
  expect_refused(
      {{{"Bond/Modulus = 1e308"}, {"Bond/Modulus = 1e308 is out of range. Allowed: 1 ... 1e13 Pa."}},
       {{"Bond/Modulus = 0.5"}, {"Bond/Modulus = 0.5 is out of range"}},
       {{"Bond/Tensile strength = 1e200"}, {"is out of range. Allowed: unbreakable, or 0.001 ... 1e12 Pa."}},
       {{"Contact/Stiffness = 1e300 N/m"}, {"Contact/Stiffness = 1e300 N/m is out of range"}},
       {{"Contact/Stiffness = 1e9"}, {"Contact/Stiffness = 1e9 is out of range", "1e-6 ... 1e6"}},
       {{"Platens/Stiffness = 1e-300"}, {"Platens/Stiffness = 1e-300 is out of range"}},
       {{"Specimen/Sphere radius = 1e-300"},
        {"Sphere radius = 1e-300 is out of range. Allowed: 1e-10 ... 1e5 m."}},
       {{"Specimen/Height = 1e150"}, {"Specimen/Height = 1e150 is out of range"}},
       {{"Specimen/Radius = 1e-150"}, {"Specimen/Radius = 1e-150 is out of range"}},
       {{"Material/Density = 1e-30"}, {"Density = 1e-30 is out of range. Allowed: 0.001 ... 1e8 kg/m3"}},
       {{"Loading/Axial rate = 1e-30"}, {"Axial rate = 1e-30 is out of range. Allowed: 1e-12 ... 10000 m/s"}},
       {{"Loading/Ramp = 1e300"}, {"Loading/Ramp = 1e300 is out of range. Allowed: 0, or 1e-18 ... 1e9 s"}},
       {{"Integration/Time step = 1e-30"}, {"Time step = 1e-30 is out of range. Allowed: 0, or"}},
       {{"Bond/Radius multiplier = 1e-9"}, {"Radius multiplier = 1e-9 is out of range. Allowed: 0.1 ... 3"}},
       {{"Bond/Radius multiplier = 10"}, {"Radius multiplier = 10 is out of range. Allowed: 0.1 ... 3"}},
       {{"Loading/Test = uniaxial strain", "Loading/Wall stiffness = 1e-6"},
        {"Wall stiffness = 1e-6 is out of range. Allowed: 0.1 ... 1000"}},
       {{"Platens/Machine stiffness = 1e-200"}, {"Machine stiffness = 1e-200 is out of range"}},
       {{"Bond/Gap = 50 R_min"}, {"Bond/Gap = 50 R_min reaches past the neighbours", "0 ... 1 of it"}},
       {{"Bond/Gap = 1.001 R_min"}, {"reaches past the neighbours"}},
       {{"Output/Every = 1e300 s"}, {"Output/Every = 1e300 s is out of range"}},
       {{"Loading/Stage 1/Axial = stress 1e300"}, {"has a value out of range"}},
       {{"Platens/Layer materials = rubber: 1e-9, 0.49, 1100"},
        {"has a Young modulus, \"1e-9\", that is out of range"}},
       {{"Platens/Layers = steel 1e-200"}, {"is out of range"}},
       {{"Study/Domain list = 1e200 x 1e200"}, {"is out of range"}, "study"},
       {{"Study/Gap list = 0.05 R_min, 50 R_min"}, {"reaches past the neighbours"}, "study"},
       {{"Pair test/Displacement = 1e-100"}, {"is out of range. Allowed: 1e-15 ... 1000 m"}, "bonds"}});
}

TEST(AbsurdScenes, honest_extremes_are_taken) {
  // A gel of micrometre grains, a rock face of metres, atoms of a diamond lattice.
  EXPECT_EQ(message_of({"Bond/Modulus = 10 Pa", "Bond/Tensile strength = 5 Pa", "Bond/Shear strength = 5 Pa",
                        "Specimen/Sphere radius = 1 um", "Specimen/Radius = 10 um", "Specimen/Height = 20 um",
                        "Material/Density = 1000", "Loading/Axial rate = 1 um/s"}),
            "");
  EXPECT_EQ(message_of({"Specimen/Sphere radius = 1 m", "Specimen/Radius = 50 m", "Specimen/Height = 100 m",
                        "Loading/Axial rate = 1 m/s"}),
            "");
  EXPECT_EQ(message_of({"Bond/Modulus = 1 TPa", "Bond/Tensile strength = 100 GPa",
                        "Specimen/Sphere radius = 1 nm", "Specimen/Radius = 10 nm", "Specimen/Height = 20 nm",
                        "Material/Density = 3500", "Loading/Axial rate = 1 m/s"}),
            "");
  EXPECT_EQ(message_of({"Material/Density = 1e7", "Loading/Axial rate = 1 mm/s"}), ""); // scaled
}

TEST(AbsurdScenes, entries_that_make_no_whole_are_told_together) {
  expect_refused(
      {{{"Specimen/Height = 10 m"},
        {"Specimen/Height = 10 m is 1e+03 times the width that Specimen/Radius = 5 mm gives. Allowed: 0.005 "
         "... 200."}},
       {{"Specimen/Radius = 10 um", "Specimen/Sphere radius = 1 um"},
        {"Specimen/Height = 10 mm is 500 times the width that Specimen/Radius = 10 um gives"}},
       {{"Specimen/Shape = box", "Specimen/Radius =", "Specimen/Width x = 5 mm", "Specimen/Width y = 5 m"},
        {"Specimen/Width y = 5 m is 1e+03 times the width that Specimen/Width x = 5 mm gives"}},
       {{"Specimen/Radius = 1 mm", "Specimen/Sphere radius = 5 mm"},
        {"Specimen/Sphere radius = 5 mm is too large"}},
       {{"Material/Density = 0.002"},
        {"Material/Density = 0.002 does not go with Bond/Modulus = 40 GPa: waves would run at 4.47e+06 "
         "m/s."}},
       {{"Material/Density = 2.4"},
        {"waves would run at 1.29e+05 m/s. Allowed: 0.001 ... 4e+04 m/s."}}, // g/cm3
       {{"Bond/Modulus = 40 Pa", "Material/Density = 1e8", "Bond/Tensile strength = 1 Pa",
         "Bond/Shear strength = 1 Pa"},
        {"Material/Density = 1e8 does not go with Bond/Modulus = 40 Pa: waves would run at 0.000632 m/s"}},
       {{"Loading/Axial rate = 5000"},
        {"Loading/Axial rate = 5000 is 1.22 times the speed of waves, 4.08e+03 m/s by Bond/Modulus = 40 GPa "
         "and Material/Density = 2400. Allowed: up to 0.1 times."}},
       {{"Loading/Axial rate = 10", "Loading/Hurry = 100"},
        {"Loading/Axial rate = 10 with Loading/Hurry = 100 is 0.245 times the speed of waves"}},
       {{"Loading/Stage 1/Axial = rate 9 km/s", "Loading/Stage 1/Until = strain 0.1"},
        {"Loading/Stage 1/Axial = rate 9 km/s is more than 0.1 of the speed of waves, 4.08e+03 m/s"}},
       {{"Loading/Axial rate = 300", "Loading/Target strain = 1e-4"},
        {"Loading/Axial rate = 300 comes to Loading/Target strain = 1e-4", "time steps of spheres of"}},
       {{"Loading/Target strain = 1e-9"},
        {"comes to Loading/Target strain = 1e-9", "Allowed: 100 ... 1e+12."}},
       {{"Loading/Axial rate = 1e-12"},
        {"Loading/Axial rate = 1e-12 comes to", "at least 4.08e+14 time steps"}},
       {{"Loading/Axial rate =", "Loading/Wave crossings = 0.01", "Loading/Target strain = 1e-5"},
        {"Loading/Wave crossings = 0.01 comes to Loading/Target strain = 1e-5"}},
       {{"Bond/Tensile strength = 90 GPa"},
        {"Bond/Tensile strength = 90 GPa over Bond/Modulus = 40 GPa is a strain at break of 2.25. Allowed: "
         "1e-09 ... 1."}},
       {{"Bond/Shear strength = 30 Pa"}, {"Bond/Shear strength = 30 Pa over Bond/Modulus = 40 GPa"}},
       {{"Bond/Modulus = 9 MPa", "Bond/Tensile strength = 40 GPa"}, {"is a strain at break of 4.44e+03"}},
       {{"Loading/Confinement = particles", "Loading/Confining pressure = 20 GPa"},
        {"Loading/Confining pressure = 20 GPa is 0.5 of Bond/Modulus = 40 GPa. Allowed: 0, or 1e-09 ... 0.1 "
         "of it."}},
       {{"Platens/Top/Control = stress", "Platens/Top/Stress = 10 GPa", "Loading/Ramp = 1 ms"},
        {"Platens/Top/Stress = 10 GPa is 0.25 of Bond/Modulus"}},
       {{"Contact/Stiffness = 1e15 N/m"},
        {"Contact/Stiffness = 1e15 N/m is 1.59e+07 times that of a bond, which Bond/Modulus = 40 GPa and "
         "Specimen/Sphere radius = 1 mm give."}},
       {{"Platens/Stiffness = 1 N/m"}, {"Platens/Stiffness = 1 N/m is 1.59e-08 times that of a bond"}},
       {{"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa", "Sleeve/Thickness = 3 m"},
        {"Sleeve/Thickness = 3 m is more than Specimen/Radius = 5 mm. Allowed: up to that."}},
       {{"Platens/Kind = deformable", "Platens/Thickness = 20 m"},
        {"Platens/Thickness = 20 m is more than a hundred times the specimen's size"}},
       {{"Platens/Kind = deformable", "Platens/Young modulus = 210 Pa"},
        {"Platens/Young modulus = 210 Pa is 5.25e-09 of Bond/Modulus = 40 GPa: it bears nothing. Allowed: "
         "1e-06 "
         "of it"}},
       {{"Platens/Kind = deformable", "Platens/Density = 7.85"},
        {"Platens/Density = 7.85 does not go with Platens/Young modulus", "waves would run at 1.6e+05 m/s"}},
       {{"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa", "Sleeve/Thickness = 1 mm",
         "Sleeve/Modulus = 2 Pa"},
        {"Sleeve/Modulus = 2 Pa is 5e-11 of Bond/Modulus = 40 GPa"}},
       {{"Platens/Strip width = 4 mm"},
        {"Platens/Strip width = 4 mm is 0.4 of the diameter that Specimen/Radius = 5 mm gives",
         "Allowed: up to 0.3"},
        "brazilian"},
       {{"Bond/Gap = 2 mm"}, {"Bond/Gap = 2 mm is as large as Specimen/Sphere radius = 1 mm"}},
       {{"Pair test/Displacement = 5 m"},
        {"Pair test/Displacement = 5 m moves a sphere by more than its size, Specimen/Sphere radius = 1 mm"},
        "bonds"},
       {{"Effects/Bond = elasto damage plastic", "Bond/Compression limits = 1 MPa, 2 MPa, 3 MPa",
         "Bond/Compression slopes = 2, 3, 4", "Pair test/Turns = 1 um, -1 m"},
        {"Pair test/Turns = 1 um, -1 m moves a sphere by more"},
        "bonds"},
       {{"Pair test/Force = 1e9"}, {"Pair test/Force = 1e9 strains bonds between spheres of"}, "bonds"}});
}

} // namespace
} // namespace platen::apps
