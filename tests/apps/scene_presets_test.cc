// What a word of quality or for a face of a platen stands for, and what stays with the scene.
#include <cmath>
#include <sstream>

#include "apps/read_scenes.h"
#include "apps/scene/command_line.h"
#include "apps/scene/parameters.h"
#include "apps/scene/surfaces.h"
#include "apps/scratch_folder.h"

namespace platen::apps {
namespace {

using namespace testing;

class SceneQuality : public ScratchFolder {};

TEST_F(SceneQuality, words_go_from_coarse_to_fine_and_leave_no_rate_to_be_given) {
  double safety = 1, crossings = 0;
  for (const char *word : {"fast", "standard", "reference"}) {
    const Scene scene = scene_with({std::string("Scene/Quality = ") + word, "Loading/Axial rate ="});
    EXPECT_LT(scene.time_step.safety, safety) << word;
    EXPECT_GT(scene.loading.wave_transits, crossings) << word;
    safety = scene.time_step.safety, crossings = scene.loading.wave_transits;
    EXPECT_TRUE(contains(text_of(scene.general.quality, *scene.parameters), word));
  }
}

TEST_F(SceneQuality, what_the_scene_says_stays_and_is_told_apart) {
  const Scene scene = scene_with({"Scene/Quality = fast", "Integration/Safety = 0.3"});
  EXPECT_EQ(scene.time_step.safety, 0.3);
  EXPECT_TRUE(std::isnan(scene.loading.wave_transits)); // good.prm has its rate
  const std::string told = text_of(scene.general.quality, *scene.parameters);
  EXPECT_TRUE(contains(told, "the scene's own: Integration/Safety, Loading/Wave crossings"));
}

TEST_F(SceneQuality, without_a_word_nothing_is_set_and_the_rate_has_to_be_given) {
  EXPECT_EQ(scene_with({}).general.quality, Quality::custom);
  EXPECT_EQ(scene_with({"Scene/Quality = standard"}).time_step.safety, scene_with({}).time_step.safety);
  EXPECT_EQ(text_of(Quality::custom, *scene_with({}).parameters), "");
  EXPECT_THROW(scene_with({"Loading/Axial rate ="}), InputError);
  // Discs are split at a speed of their own.
  EXPECT_THROW(
      scene_with({"Loading/Axial rate =", "Scene/Quality = fast", "Specimen/Shape = disc"}, "brazilian"),
      InputError);
}

TEST_F(SceneQuality, a_scene_written_with_it_reads_back_to_the_same) {
  const Scene scene = scene_with({"Scene/Quality = reference", "Loading/Axial rate ="});
  put(folder_ / "copy.prm", scene_text(scene, folder_));
  const Scene again = read_scene(folder_ / "copy.prm", {}, program("compress"));
  EXPECT_EQ(again.time_step.safety, scene.time_step.safety);
  EXPECT_EQ(again.loading.wave_transits, scene.loading.wave_transits);
  EXPECT_TRUE(std::isnan(again.loading.rate));
}

// Besides the entries that the word stands for.
Entries needs_of(SurfaceKind kind) {
  if (kind == SurfaceKind::rubber_sheet)
    return {"Platens/Pad thickness = 0.2 mm", "Platens/Pad modulus = 100 MPa",
            "Platens/Pad Poisson ratio = 0.45", "Platens/Pad density = 1200 kg/m3"};
  if (kind == SurfaceKind::brush) // any file will do where nothing is run
    return {"Platens/Top/Mesh file = " + good, "Platens/Bottom/Mesh file = " + good};
  return {};
}

class Surfaces : public ScratchFolder {};

TEST_F(Surfaces, every_word_sets_its_entries_says_its_source_and_can_be_written_back) {
  for (const Surface &one : surfaces()) {
    Entries entries{"Platens/Surface = " + one.word};
    for (const std::string &need : needs_of(one.kind))
      entries.push_back(need);
    const Scene scene = scene_with(entries);
    for (const auto &[key, text] : one.entries)
      EXPECT_EQ(scene.parameters->at("Platens/" + key).text, text) << one.word << ", " << key;
    std::ostringstream told;
    print_parameters(scene, "", true, told);
    EXPECT_TRUE(contains(told.str(), one.source)) << one.word;
    EXPECT_TRUE(contains(text_of(scene.platens), one.word));

    const std::string text = scene_text(scene, folder_);
    put(folder_ / "written.prm", text);
    EXPECT_EQ(scene_text(read_scene(folder_ / "written.prm", {}, program("compress")), folder_), text)
        << one.word;
  }
}

// The thickness that a plate has by default says nothing of a mesh.
TEST_F(Surfaces, a_pad_of_meshes_may_be_as_thick_as_they_are) {
  Entries entries = needs_of(SurfaceKind::rubber_sheet);
  entries.insert(entries.end(), {"Platens/Kind = deformable", "Platens/Pad thickness = 1 m",
                                 "Platens/Top/Mesh file = " + good});
  EXPECT_THROW(scene_with(entries), InputError);
  entries.push_back("Platens/Bottom/Mesh file = " + good);
  EXPECT_NO_THROW(scene_with(entries));
}

TEST_F(Surfaces, the_figures_are_those_of_their_sources) {
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
  const dem::SurfaceFriction falling =
      scene_with({"Platens/Bottom/Surface = steel slip weakening"}).platens.bottom; // Cusatis et al. 2011
  EXPECT_EQ(falling.friction_static, 0.13);
  EXPECT_EQ(falling.friction_dynamic, 0.015);
  EXPECT_EQ(falling.weakening.by, dem::Weakening::By::slip);
  EXPECT_DOUBLE_EQ(falling.weakening.slip_length, 1.3e-3);
}

TEST_F(Surfaces, the_nearer_figure_wins) {
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
TEST_F(Surfaces, a_word_wins_over_figures_of_files_that_are_included) {
  put(folder_ / "inner.prm", "include " + good + "\nsubsection Platens\n  set Friction static = 0.57\nend\n");
  const auto with = [&](const std::string &word, const Entries &entries) {
    const fs::path outer = folder_ / "outer.prm";
    put(outer, "include inner.prm\nsubsection Platens\n" + word + "end\n");
    return read_scene(outer.string(), entries, program("compress")).platens;
  };
  EXPECT_EQ(with("  set Surface = grease\n", {}).top.friction_static, 0.0048);
  EXPECT_EQ(with("  set Surface = grease\n  set Friction static = 0.01\n", {}).top.friction_static, 0.01);
  EXPECT_EQ(with("", {"Platens/Surface = teflon"}).top.friction_static, 0.03);
  EXPECT_EQ(with("  set Friction static = 0.2\n", {"Platens/Surface = teflon"}).top.friction_static, 0.03);
  EXPECT_EQ(with("", {"Platens/Surface = teflon", "Platens/Friction static = 0.1"}).top.friction_static, 0.1);
  EXPECT_EQ(with("", {"Platens/Top/Surface = grease"}).bottom.friction_static, 0.57);
}

TEST_F(Surfaces, an_entry_that_only_a_word_has_set_is_not_noted) {
  EXPECT_TRUE(scene_with({"Platens/Surface = grease"}).notes.empty());
  const Scene noted = scene_with({"Platens/Slip length = 1 mm"});
  ASSERT_EQ(noted.notes.size(), 1u);
  EXPECT_TRUE(contains(noted.notes[0], "no Friction law is slip weakening"));
}

} // namespace
} // namespace platen::apps
