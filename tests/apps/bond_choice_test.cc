// Bonds from a file and flaws, as a scene says them: read, refused with what is allowed, and bonded as they
// say.
#include <gtest/gtest.h>

#include "apps/programs.h"
#include "apps/run/model_setup.h"
#include "apps/run/shared_packing.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/bond_file.h"
#include "apps/scene/errors.h"
#include "apps/scene/flaws.h"
#include "apps/scratch_folder.h"
#include "dem/model.h"

namespace platen::apps::testing::bond_choice {
namespace {

using Words = std::vector<std::string>;
using Form = dem::Flaw::Form;

constexpr const char *spheres =
    "id,x_mm,y_mm,z_mm,radius_mm\n10,0,0,1,1\n20,0,0,3,1\n30,0,0,5.5,1\n40,0,0,9,1\n";

class BondFile : public ScratchFolder {
protected:
  BondFile() {
    put(folder_ / "spheres.csv", spheres);
    put(folder_ / "scene.prm",
        "subsection Specimen\n  set Packing = file\n  set File = spheres.csv\n  set Bond file = "
        "bonds.csv\nend\n"
        "subsection Bond\n  set Modulus = 40 GPa\n  set Tensile strength = 9 MPa\n  set Shear strength = 30 "
        "MPa\nend\n"
        "subsection Loading\n  set Axial rate = 0.02 m/s\nend\n");
  }
  dem::ModelSettings settings(const std::string &bonds) const {
    put(folder_ / "bonds.csv", bonds);
    return model_settings(scene());
  }
  Scene scene(const Words &entries = {}) const {
    return read_scene((folder_ / "scene.prm").string(), entries, program("compress"));
  }
  void expect_refused(const std::string &bonds, const std::string &says) const {
    const std::string text = message_of<InputError>([&] { settings(bonds); });
    EXPECT_TRUE(contains(text, (folder_ / "bonds.csv").string() + says)) << bonds << "\nsays " << text;
  }
};

TEST_F(BondFile, names_spheres_by_the_ids_of_their_file_and_leaves_broken_bonds_out) {
  const dem::ModelSettings read =
      settings("# cracked\nbroken;b;strength_factor;a\n0;10;0,25;20\n1;20;1;30\n");
  ASSERT_TRUE(read.bond_choice.given.has_value());
  ASSERT_EQ(read.bond_choice.given->size(), 1u);
  const dem::GivenBond &bond = read.bond_choice.given->front();
  EXPECT_EQ(std::minmax(bond.first, bond.second), std::minmax(0, 1));
  EXPECT_EQ(bond.strength_factor, 0.25);
  // Farther than Bond/Gap, but within a radius.
  put(folder_ / "bonds.csv", "a,b\n20,30\n10,20\n");
  const Scene both = scene();
  const dem::Model model(make_bonded_specimen(both), model_settings(both));
  EXPECT_EQ(model.bonds->size(), 2u);
  EXPECT_EQ(model.bonds->strength_factor, nullptr);
  // Without ids rows are counted.
  put(folder_ / "spheres.csv", "nr" + std::string(spheres).substr(2));
  const dem::ModelSettings rows = settings("a b\n2 1\n");
  EXPECT_EQ(rows.bond_choice.given->front().first, 2);
  EXPECT_EQ(rows.bond_choice.given->front().second, 1);
}

TEST_F(BondFile, is_refused_with_line_and_what_is_allowed) {
  expect_refused("a,c\n10,20\n", ":1: error: the header names no column b");
  expect_refused("a,b\n10,20\n10,15\n",
                 ":3: error: column b: there is no sphere 15. Allowed: ids from 10 to 40.");
  expect_refused("a,b\n10,10\n", ":2: error: bonds sphere 10 to itself");
  expect_refused("a,b\n10,20\n\n20,10\n", ":4: error: bonds 20 and 10, as line 2 does");
  expect_refused("a,b\n30,40\n",
                 ":2: error: spheres 30 and 40 are 0.0015 m apart, which no bond spans. Allowed: up "
                 "to 0.001 m");
  expect_refused("a,b,strength_factor\n10,20,0\n", ":2: error: strength_factor 0 is out of range");
  expect_refused("a,b,strength_factor\n10,20,1001\n", ":2: error: strength_factor 1001 is out of range");
  expect_refused("a,b,broken\n10,20,2\n", ":2: error: broken is 2. Allowed: 0, 1.");
  expect_refused("a,b,broken\n10,20,1\n", ":2: error: the file holds no bond that is not broken");
  expect_refused("a,b\n10,zwanzig\n", ":2: error: column b: \"zwanzig\"");
  put(folder_ / "spheres.csv", std::string(spheres) + "20,0,0,12,1\n");
  expect_refused("a,b\n10,20\n", ": error: names spheres by ids, and two in their file have the id 20");
}

TEST_F(BondFile, needs_spheres_of_a_file_and_a_bond_law) {
  put(folder_ / "bonds.csv", "a,b\n10,20\n");
  for (const Words &entries : {Words{"Effects/Bond = none", "Effects/Contact = linear"},
                               Words{"Specimen/Packing = advancing front", "Specimen/Radius = 8 mm",
                                     "Specimen/Height = 20 mm", "Specimen/Sphere radius = 1 mm"}}) {
    const Scene other = scene(entries);
    EXPECT_FALSE(model_settings(other).bond_choice.given.has_value());
    EXPECT_TRUE(std::any_of(other.notes.begin(), other.notes.end(), [](const std::string &note) {
      return contains(note, "note: Specimen/Bond file = bonds.csv has no effect");
    }));
  }
}

TEST(Flaws, are_read_in_any_order_of_their_words) {
  const dem::Flaw disc = *read_flaw("disc at 1 mm, -2 mm, 50 mm normal 0, 3, 4 radius 10 mm cut");
  EXPECT_EQ(disc.form, Form::disc);
  EXPECT_DOUBLE_EQ(disc.centre.y, -0.002);
  EXPECT_DOUBLE_EQ(disc.normal.y, 0.6);
  EXPECT_DOUBLE_EQ(disc.normal.z, 0.8);
  EXPECT_EQ(disc.radius, 0.01);
  EXPECT_EQ(disc.strength_factor, 0);
  const dem::Flaw plane = *read_flaw("plane  strength 30 % normal 0, 0, -1 at 0, 0, 5 cm");
  EXPECT_EQ(plane.form, Form::plane);
  EXPECT_EQ(plane.strength_factor, 0.3);
  EXPECT_DOUBLE_EQ(plane.centre.z, 0.05);
  const dem::Flaw sheet = *read_flaw("rectangle at 0, 0, 0.05 normal 1, 0, 0 widths 20 mm, 10 mm cut");
  EXPECT_EQ(sheet.form, Form::rectangle);
  EXPECT_EQ(sheet.width, 0.02);
  EXPECT_EQ(sheet.breadth, 0.01);
  EXPECT_FALSE(read_flaw("").has_value());
}

TEST(Flaws, are_refused_with_what_is_wrong) {
  const std::string placed = " at 0, 0, 50 mm normal 0, 0, 1";
  const std::pair<std::string, const char *> faults[] = {
      {"disk" + placed + " radius 1 mm cut", "is not known. Did you mean \"disc\"?"},
      {"disc" + placed + " cut", "has no \"radius\""},
      {"disc" + placed + " radius 1 mm", "needs either \"cut\" or \"strength\""},
      {"disc" + placed + " radius 1 mm cut strength 0.5", "needs either \"cut\" or \"strength\""},
      {"disc" + placed + " radius 0 mm cut", "after \"radius\" holds an item, \""},
      {"disc" + placed + " radius 1 kg cut", "after \"radius\" holds an item, \""},
      {"disc" + placed + " radius 1 mm cut off", "has \"off\" after cut"},
      {"disc" + placed + " radius 1 mm radius 2 mm cut", "says \"radius\" twice"},
      {"plane" + placed + " radius 1 mm cut", "has \"radius\", which a plane has not"},
      {"plane at 0, 0 normal 0, 0, 1 cut", "needs 3 numbers after \"at\""},
      {"plane at 0, 0, 1 mm normal 0, 0, 0 cut", "has a normal without a direction"},
      {"plane normal 0, 0, 1 cut", "has no \"at\""},
      {"plane" + placed + " strength 0", "after \"strength\" holds an item, \"0\""},
      {"plane there" + placed + " cut", "has \"there\" after its form"},
      {"rectangle" + placed + " widths 1 mm cut", "needs 2 numbers after \"widths\""}};
  for (const auto &[text, says] : faults)
    EXPECT_TRUE(contains(message_of<ValueError>([&] { read_flaw(text); }), says)) << text;
}

TEST_F(BondFile, and_flaws_of_a_scene_act_together) {
  put(folder_ / "bonds.csv", "a,b\n20,30\n10,20\n");
  const auto bonds_of = [&](const Words &entries) {
    const Scene one = scene(entries);
    const dem::Model model(make_bonded_specimen(one), model_settings(one));
    return model.bonds->size();
  };
  EXPECT_EQ(bonds_of({"Specimen/Flaw 1 = plane at 0, 0, 2 mm normal 0, 0, 1 cut"}), 1u);
  EXPECT_EQ(bonds_of({"Specimen/Flaw 3 = disc at 0, 0, 2 mm normal 0, 0, 1 radius 1 mm cut",
                      "Specimen/Flaw 8 = disc at 9 mm, 0, 4 mm normal 0, 0, 1 radius 8 mm cut"}),
            1u);
  EXPECT_TRUE(contains(
      message_of<InputError>([&] { scene({"Specimen/Flaw 2 = disc at 0, 0, 2 mm cut"}); }),
      "--set 1: error: Specimen/Flaw 2 = disc at 0, 0, 2 mm cut has no \"normal\". Allowed: \"disc at"));
  // What is written is read as the same; a packing is that without it.
  const Scene third = scene({"Specimen/Flaw 3 = plane at 0, 0, 2 mm normal 0, 0, 1 strength 0.5"});
  put(folder_ / "again.prm", scene_text(third, folder_));
  const Scene again = read_scene((folder_ / "again.prm").string(), {}, program("compress"));
  ASSERT_TRUE(again.specimen.flaws[2].has_value());
  EXPECT_FALSE(again.specimen.flaws[0].has_value());
  EXPECT_EQ(again.specimen.flaws[2]->strength_factor, 0.5);
  const Words packed{"Specimen/Packing = advancing front", "Specimen/Radius = 8 mm",
                     "Specimen/Height = 20 mm", "Specimen/Sphere radius = 1 mm"};
  const auto recipe = [&](Words entries) {
    entries.insert(entries.end(), packed.begin(), packed.end());
    return packing_recipe(scene(entries), 1);
  };
  EXPECT_EQ(recipe({}), recipe({"Specimen/Flaw 1 = plane at 0, 0, 2 mm normal 0, 0, 1 cut"}));
  EXPECT_NE(recipe({}), recipe({"Specimen/Radius spread = 0.3"}));
  EXPECT_THROW(scene({"Specimen/Flaw 9 = plane at 0, 0, 2 mm normal 0, 0, 1 cut"}), InputError);
}

} // namespace
} // namespace platen::apps::testing::bond_choice
