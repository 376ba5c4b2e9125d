// Which tests a standard takes (what it refuses: faulty.txt, Standards), and that it is nothing but a word.
#include "apps/read_scenes.h"
#include "apps/scene/standards.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class SceneStandards : public ScratchFolder {
protected:
  std::string said(const std::string &word, Entries entries, const std::string &app = "compress") const {
    entries.push_back("Scene/Standard = " + word);
    return said_with(entries, app);
  }
};

Entries in_stages(Entries entries) {
  entries.insert(entries.end(), {"Loading/Stage 1/Axial = rate", "Loading/Stage 1/Until = strain 1 %"});
  return entries;
}

TEST_F(SceneStandards, each_takes_a_cylinder_that_is_compressed) {
  const Entries high{"Specimen/Radius = 5 mm", "Specimen/Height = 20 mm"};
  for (const TestStandard &one : test_standards())
    EXPECT_EQ(said(one.word, one.presses == Presses::discs ? Entries{} : in_stages(high),
                   one.presses == Presses::discs ? "brazilian" : "compress"),
              "");
  const Entries cell{"Loading/Confinement = particles", "Loading/Confining pressure = 1 MPa"};
  EXPECT_EQ(said("ISRM", cell) + said("ASTM D7012", cell), "");
}

TEST_F(SceneStandards, the_modulus_of_concrete_takes_prisms_two_to_four_times_as_high_as_wide) {
  for (const std::string height : {"20 mm", "40 mm"}) {
    const Entries box{"Specimen/Shape = box", "Specimen/Radius =", "Specimen/Width x = 12 mm",
                      "Specimen/Width y = 10 mm", "Specimen/Height = " + height};
    EXPECT_EQ(said("EN 12390-13", in_stages(box)), "");
  }
}

// They have no test that it could be of.
TEST_F(SceneStandards, programs_that_load_nothing_and_trials_pass_over_it) {
  EXPECT_EQ(said("EN 12390-6", {}, "pack"), "");
  EXPECT_EQ(said("EN 12390-6", {"Calibrate/Target 1 = strength_pa: 40 MPa"}, "calibrate"), "");
}

TEST_F(SceneStandards, it_is_a_line_of_the_scene_and_nothing_else) {
  const std::string without = scene_text(scene_with({}), folder_);
  std::string with = scene_text(scene_with({"Scene/Standard = ASTM C39"}), folder_);
  const std::string word = "Standard = ASTM C39";
  const std::size_t at = with.find(word);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(with.replace(at, word.size(), "Standard = none"), without);
}

} // namespace
} // namespace platen::apps
