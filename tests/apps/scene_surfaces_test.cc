// What a word for a platen's face stands for, and what stays with the scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "apps/programs.h"
#include "apps/scene/command_line.h"
#include "apps/scene/parameters.h"
#include "apps/scene/scene.h"
#include "apps/scene/surfaces.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

const std::string good = (fs::path(PLATEN_TEST_DATA) / "fragment" / "good.prm").string();

Scene scene_with(const std::vector<std::string> &entries) {
  return read_scene(good, entries, program("compress"));
}

// Besides the entries that the word stands for.
std::vector<std::string> needs_of(SurfaceKind kind) {
  if (kind == SurfaceKind::rubber_sheet)
    return {"Platens/Pad thickness = 0.2 mm", "Platens/Pad modulus = 100 MPa",
            "Platens/Pad Poisson ratio = 0.45", "Platens/Pad density = 1200 kg/m3"};
  if (kind == SurfaceKind::brush) // any file will do where nothing is run
    return {"Platens/Top/Mesh file = " + good, "Platens/Bottom/Mesh file = " + good};
  return {};
}

TEST(Surfaces, every_word_sets_its_entries_says_its_source_and_can_be_written_back) {
  for (const Surface &one : surfaces()) {
    std::vector<std::string> entries{"Platens/Surface = " + one.word};
    for (const std::string &need : needs_of(one.kind))
      entries.push_back(need);
    const Scene scene = scene_with(entries);
    for (const auto &[key, text] : one.entries)
      EXPECT_EQ(scene.parameters->at("Platens/" + key).text, text) << one.word << ", " << key;
    std::ostringstream told;
    print_parameters(scene, "", true, told);
    EXPECT_NE(told.str().find(one.source), std::string::npos) << one.word;
    EXPECT_NE(text_of(scene.platens).find(one.word), std::string::npos);

    const fs::path written = fs::temp_directory_path() / "platen_surface_written.prm";
    const std::string text = scene_text(scene, written.parent_path());
    std::ofstream(written) << text;
    EXPECT_EQ(scene_text(read_scene(written.string(), {}, program("compress")), written.parent_path()), text)
        << one.word;
    fs::remove(written);
  }
}

// The thickness that a plate has by default says nothing of a mesh.
TEST(Surfaces, a_pad_of_meshes_may_be_as_thick_as_they_are) {
  std::vector<std::string> entries = needs_of(SurfaceKind::rubber_sheet);
  entries.insert(entries.end(), {"Platens/Kind = deformable", "Platens/Pad thickness = 1 m",
                                 "Platens/Top/Mesh file = " + good});
  EXPECT_THROW(scene_with(entries), InputError);
  entries.push_back("Platens/Bottom/Mesh file = " + good);
  EXPECT_NO_THROW(scene_with(entries));
}

TEST(Surfaces, the_figures_are_those_of_their_sources) {
  const auto friction = [](const char *word) {
    const Scene scene = scene_with({std::string("Platens/Surface = ") + word});
    EXPECT_EQ(scene.platens.bottom.friction_static, scene.platens.top.friction_static);
    EXPECT_EQ(scene.platens.top.friction_dynamic, scene.platens.top.friction_static);
    return scene.platens.top.friction_static;
  };
  EXPECT_EQ(friction("dry steel"), 0.57); // Rabbat and Russell 1985
  EXPECT_EQ(friction("thesis"), 0.3);     // Tannu 2017
  EXPECT_EQ(friction("teflon"), 0.03);    // EN 1337-2, the least
  EXPECT_EQ(friction("grease"), 0.0048);  // Bocklenberg et al. 2016
  EXPECT_EQ(friction("custom"), 0.3);     // the default of Friction static
  EXPECT_EQ(scene_with({"Platens/Surface = glued"}).platens.glued, true);
}

TEST(Surfaces, the_nearer_figure_wins) {
  const Platens own = scene_with({"Platens/Surface = dry steel", "Platens/Friction dynamic = 0.4",
                                  "Platens/Top/Friction static = 0.5"})
                          .platens;
  EXPECT_EQ(own.top.friction_static, 0.5);
  EXPECT_EQ(own.bottom.friction_static, 0.57);
  EXPECT_EQ(own.bottom.friction_dynamic, 0.4);

  const Platens mixed = scene_with({"Platens/Friction static = 0.2", "Platens/Friction dynamic = 0.1",
                                    "Platens/Friction law = slip weakening", "Platens/Slip length = 1 mm",
                                    "Platens/Top/Surface = grease", "Platens/Bottom/Slip length = 2 mm"})
                            .platens;
  EXPECT_EQ(mixed.top.friction_static, 0.0048);
  EXPECT_EQ(mixed.top.friction_dynamic, 0.0048);
  EXPECT_EQ(mixed.top.weakening.by, dem::Weakening::By::nothing); // nothing of the common law
  EXPECT_EQ(mixed.bottom.weakening.by, dem::Weakening::By::slip);
  EXPECT_EQ(mixed.bottom.weakening.slip_length, 0.002);

  const Platens kept = scene_with({"Platens/Surface = dry steel", "Platens/Friction law = velocity weakening",
                                   "Platens/Friction dynamic = 0.2", "Platens/Slip velocity = 1 mm/s"})
                           .platens;
  EXPECT_EQ(kept.top.weakening.by, dem::Weakening::By::velocity);
  EXPECT_EQ(kept.top.weakening.slip_velocity, 0.001);
}

// A word on the command line, or in a file that includes another, is nearer than figures of the scene there.
class SurfaceFiles : public testing::ScratchFolder {};

TEST_F(SurfaceFiles, a_word_wins_over_figures_of_files_that_are_included) {
  testing::put(folder_ / "inner.prm",
               "include " + good + "\nsubsection Platens\n  set Friction static = 0.57\nend\n");
  const auto with = [&](const std::string &word, const std::vector<std::string> &entries) {
    const fs::path outer = folder_ / "outer.prm";
    testing::put(outer, "include inner.prm\nsubsection Platens\n" + word + "end\n");
    return read_scene(outer.string(), entries, program("compress")).platens;
  };
  EXPECT_EQ(with("  set Surface = grease\n", {}).top.friction_static, 0.0048);
  EXPECT_EQ(with("  set Surface = grease\n  set Friction static = 0.01\n", {}).top.friction_static, 0.01);
  EXPECT_EQ(with("", {"Platens/Surface = teflon"}).top.friction_static, 0.03);
  EXPECT_EQ(with("  set Friction static = 0.2\n", {"Platens/Surface = teflon"}).top.friction_static, 0.03);
  EXPECT_EQ(with("", {"Platens/Surface = teflon", "Platens/Friction static = 0.1"}).top.friction_static, 0.1);
  EXPECT_EQ(with("", {"Platens/Top/Surface = grease"}).bottom.friction_static, 0.57);
}

TEST(Surfaces, an_entry_that_only_a_word_has_set_is_not_noted) {
  EXPECT_TRUE(scene_with({"Platens/Surface = grease"}).notes.empty());
  const Scene noted = scene_with({"Platens/Slip length = 1 mm"});
  ASSERT_EQ(noted.notes.size(), 1u);
  EXPECT_NE(noted.notes[0].find("no Friction law is slip weakening"), std::string::npos);
}

} // namespace
} // namespace platen::apps
