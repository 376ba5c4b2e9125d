// Defaults that come from an entry which another entry replaces: a specimen from a file, lists of a study,
// targets with speeds of their own.
#include <gtest/gtest.h>

#include <cmath>

#include "apps/read_scenes.h"
#include "apps/run/needs.h"
#include "apps/scratch_folder.h"
#include "apps/study/cases.h"

namespace platen::apps {
namespace {

using namespace testing;

class Replaced : public ScratchFolder {
protected:
  Replaced() {
    put("cylinder.csv",
        "# shape: cylinder radius_m=0.01 "
        "height_m=0.04\nx_m,y_m,z_m,radius_m\n0,0,0.01,0.001\n0,0,0.02,0.003\n");
    put("box.csv",
        "# shape: box width_x_m=0.01 width_y_m=0.02 height_m=0.03\nx_m,y_m,z_m,radius_m\n0,0,0.01,0.001\n");
    put("bare.csv", "x_m,y_m,z_m,radius_m\n0,0,0.01,0.001\n0,0,0.02,0.001\n");
    bonds_ =
        "subsection Bond\n  set Modulus = 40 GPa\n  set Tensile strength = 9 MPa\n"
        "  set Shear strength = 30 MPa\nend\n";
  }
  std::string put(const std::string &name, const std::string &text) const {
    testing::put(folder_ / name, text);
    return (folder_ / name).string();
  }
  std::string from_file(const std::string &file, const std::string &rate = "0.02 m/s") const {
    return put("scene.prm",
               "subsection Specimen\n  set Packing = file\n  set File = " + file + "\nend\n" + bonds_ +
                   (rate.empty() ? "" : "subsection Loading\n  set Axial rate = " + rate + "\nend\n"));
  }
  // A packed one without `left_out`, a line.
  std::string packed(const std::string &left_out = "") const {
    std::string text =
        "subsection Specimen\n  set Radius = 10 mm\n  set Height = 40 mm\n  set Sphere radius = 1 mm\nend\n" +
        bonds_ + "subsection Loading\n  set Axial rate = 0.02 m/s\nend\n";
    if (const std::size_t at = text.find("  set " + left_out + " ="); !left_out.empty())
      text.erase(at, text.find('\n', at) + 1 - at);
    return put("packed.prm", text);
  }

  std::string bonds_;
};

TEST_F(Replaced, a_specimen_from_a_file_gives_the_lengths_that_the_scene_leaves_out) {
  const Scene round = read_scene(from_file("cylinder.csv"), {}, program("compress"));
  EXPECT_DOUBLE_EQ(round.specimen.sphere_radius, 0.002);
  EXPECT_EQ(round.specimen.radius, 0.01);
  EXPECT_EQ(round.specimen.height, 0.04);
  EXPECT_DOUBLE_EQ(round.platens.thickness, 0.004); // a tenth of the height
  EXPECT_TRUE(std::isnan(round.specimen.width_x));
  const Scene box = read_scene(from_file("box.csv"), {}, program("compress"));
  EXPECT_EQ(box.specimen.shape, SpecimenShape::box);
  EXPECT_EQ(box.specimen.width_x, 0.01);
  EXPECT_EQ(box.specimen.width_y, 0.02);
  EXPECT_EQ(box.specimen.height, 0.03);
  EXPECT_TRUE(std::isnan(box.specimen.radius));
  const Scene bare = read_scene(from_file("bare.csv"), {}, program("compress"));
  EXPECT_DOUBLE_EQ(bare.specimen.sphere_radius, 0.001);
  EXPECT_DOUBLE_EQ(bare.specimen.height, 0.012); // which its spheres reach
  // What the scene says stays, to the bit, and what is written back leaves out what was left out.
  EXPECT_DOUBLE_EQ(
      read_scene(from_file("cylinder.csv"), {"Specimen/Sphere radius = 2.1 mm"}, program("compress"))
          .specimen.sphere_radius,
      0.0021);
  EXPECT_TRUE(contains(scene_text(round, folder_), "set Sphere radius       = \n"));
}

// A scene that packs 1 mm spheres is pressed with a file of larger ones: the spheres are what they are.
TEST_F(Replaced, spheres_of_another_size_than_the_scene_says_replace_it) {
  const auto with = [&](const std::string &radius) {
    return read_scene(from_file("cylinder.csv"), {"Specimen/Sphere radius = " + radius}, program("compress"));
  };
  EXPECT_DOUBLE_EQ(with("3 mm").specimen.sphere_radius, 0.002);
  ASSERT_EQ(with("3 mm").notes.size(), 1u);
  EXPECT_TRUE(contains(with("3 mm").notes[0],
                       "Specimen/Sphere radius = 3 mm has no effect: spheres of Specimen/File have a "
                       "mean radius of 0.002 m."));
  EXPECT_DOUBLE_EQ(with("2.19 mm").specimen.sphere_radius, 0.00219); // what was asked of the packing
  EXPECT_TRUE(with("2.19 mm").notes.empty());
  EXPECT_DOUBLE_EQ(with("1.79 mm").specimen.sphere_radius, 0.002);
}

// A sleeve's faces are told in radii: not a number, they made the run ask for memory without end.
TEST_F(Replaced, a_sleeve_around_a_file_needs_no_radius) {
  const Scene scene = read_scene(
      from_file("cylinder.csv"),
      {"Loading/Confinement = sleeve", "Loading/Confining pressure = 1 MPa", "Sleeve/Thickness = 1 mm"},
      program("compress"));
  const CountedCosts costs = counted_costs(scene, dem::cylinder(0.01, 0.04));
  EXPECT_TRUE(std::isfinite(costs.bytes));
  EXPECT_NO_THROW(require_memory(scene, dem::cylinder(0.01, 0.04)));
}

TEST_F(Replaced, settings_in_radii_and_heights_hold_for_a_file) {
  const std::string scene = from_file("cylinder.csv");
  EXPECT_EQ(said_of(scene, {"Bond/Calibrated radius = 2 mm"}), "");
  EXPECT_TRUE(
      contains(said_of(scene, {"Bond/Calibrated radius = 9 mm"}), "is too far from Specimen/Sphere radius"));
  EXPECT_TRUE(contains(said_of(scene, {"Specimen/Ends = ground", "Specimen/End layer = 10",
                                       "Specimen/Sphere radius = 2.1 mm"}),
                       "Specimen/End layer = 10 is too deep"));
  EXPECT_TRUE(contains(said_of(scene, {"Bond/Gap = 3 mm"}), "is as large as Specimen/Sphere radius"));
  const Entries pad{"Platens/Kind = deformable", "Platens/Pad modulus = 5 MPa",
                    "Platens/Pad Poisson ratio = 0.49", "Platens/Pad density = 1100"};
  Entries thin = pad, thick = pad;
  thin.emplace_back("Platens/Pad thickness = 2 mm"), thick.emplace_back("Platens/Pad thickness = 4 mm");
  EXPECT_EQ(said_of(scene, thin), "");
  EXPECT_TRUE(contains(said_of(scene, thick),
                       "Platens/Pad thickness = 4 mm leaves nothing of the platen. Allowed: 0 ... 0.004 m"));
}

TEST_F(Replaced, a_bad_file_is_told_with_its_line) {
  put("bad.csv", "x_m,y_m,z_m,radius_m\n0,0,0.01,nan\n");
  EXPECT_TRUE(contains(said_of(from_file("bad.csv")), "bad.csv:2: error: column radius_m: \"nan\""));
}

TEST_F(Replaced, lists_of_a_study_stand_for_the_entries_that_they_vary) {
  const std::string study = "study";
  EXPECT_EQ(said_of(packed(), {}, study), "");
  for (const char *key : {"Axial rate", "Sphere radius", "Height"})
    EXPECT_TRUE(contains(said_of(packed(key), {}, study), std::string(key) + " is not set")) << key;
  EXPECT_EQ(said_of(packed("Axial rate"), {"Study/Axial rate list = 0.02 m/s, 0.01 m/s"}, study), "");
  EXPECT_EQ(said_of(packed("Axial rate"), {"Study/Wave crossings list = 30, 60"}, study), "");
  EXPECT_EQ(said_of(packed("Axial rate"), {"Study/Quality list = fast, standard"}, study), "");
  EXPECT_EQ(said_of(packed("Axial rate"), {"Study/Target/Accuracy = 5 %"}, study), "");
  EXPECT_EQ(said_of(packed("Sphere radius"), {"Study/Sphere radius list = 2 mm, 1 mm"}, study), "");
  EXPECT_NE(said_of(packed("Sphere radius"),
                    {"Study/Sphere radius list = 2 mm", "Study/Domain list = 72 mm x 22.5 mm"}, study),
            "");
  EXPECT_EQ(said_of(packed("Height"), {"Study/Slenderness list = 1, 2"}, study), "");
  EXPECT_NE(said_of(packed("Height"), {"Study/Slenderness list = 1, 2", "Platens/Kind = deformable"}, study),
            "");
  EXPECT_EQ(
      said_of(packed("Height"),
              {"Study/Slenderness list = 1, 2", "Platens/Kind = deformable", "Platens/Thickness = 5 mm"},
              study),
      "");
  // A study whose kind does not read the list finds the entry missing in its cases.
  const Entries rates{"Study/Axial rate list = 0.02 m/s, 0.01 m/s", "Study/Surface list = 0, 0.3"};
  const Scene scene = read_scene(packed("Axial rate"), rates, program(study));
  EXPECT_EQ(plan_study(StudyKind::rate, scene, rates).cases.size(), 2u);
  EXPECT_TRUE(contains(message_of<InputError>([&] { plan_study(StudyKind::friction, scene, rates); }),
                       "Loading/Axial rate is not set"));
}

TEST_F(Replaced, a_series_of_pressures_begins_with_none_and_needs_no_other_pressure) {
  const Entries entries{"Study/Surface list = 0, 0.3", "Study/Confining pressure list = 0, 5 MPa",
                        "Loading/Confinement = particles"};
  const Scene scene = read_scene(packed(), entries, program("study"));
  const StudyPlan plan = plan_study(StudyKind::friction, scene, entries);
  ASSERT_EQ(plan.cases.size(), 4u);
  EXPECT_EQ(plan.cases[0].name, "friction_0_pressure_0_MPa");
  EXPECT_EQ(plan.cases[3].name, "friction_0.3_pressure_5_MPa");
  for (const std::size_t k : {0u, 3u}) {
    const Scene led_to = scene_of(plan.cases[k], plan.kind, scene, 1, entries);
    EXPECT_EQ(led_to.loading.confinement, k == 0 ? ConfinementKind::none : ConfinementKind::particles);
    EXPECT_EQ(led_to.loading.cell->pressure, k == 0 ? 0 : 5e6);
  }
}

TEST_F(Replaced, a_pressure_of_nothing_is_a_test_without_a_cell) {
  for (const char *kind : {"particles", "sleeve"}) {
    const Entries with{std::string("Loading/Confinement = ") + kind},
        none{with.front(), "Loading/Confining pressure = 0"};
    const Scene scene = read_scene(packed(), none, program("compress"));
    EXPECT_EQ(scene.loading.confinement, ConfinementKind::none);
    ASSERT_EQ(scene.notes.size(), 1u);
    EXPECT_TRUE(contains(scene.notes[0], "has no effect: Loading/Confining pressure = 0."));
    // One that was forgotten is not none.
    EXPECT_TRUE(contains(said_of(packed(), with), "needs Loading/Confining pressure > 0."));
  }
  EXPECT_NE(said_of(packed(), {"Loading/Confinement = particles", "Loading/Confining pressure = 0 MPa",
                               "Loading/Test = hydrostatic"}),
            "");
}

TEST_F(Replaced, a_table_of_moduli_needs_no_other_modulus) {
  const Entries list{"Calibrate/Mode = abacus", "Calibrate/Modulus list = 20 GPa, 40 GPa"};
  EXPECT_EQ(said_of(packed("Modulus"), list, "calibrate"), "");
  EXPECT_EQ(read_scene(packed("Modulus"), list, program("calibrate")).model.bond_layout.modulus, 20e9);
  EXPECT_TRUE(contains(said_of(packed("Modulus"), {list.back()}, "calibrate"), "Bond/Modulus is not set"));
  EXPECT_TRUE(contains(said_of(packed("Modulus"), list), "Bond/Modulus is not set"));
}

} // namespace
} // namespace platen::apps
