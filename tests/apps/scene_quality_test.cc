// What a word of quality stands for, and what stays with the scene.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/scene.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

const std::string good = (fs::path(PLATEN_TEST_DATA) / "fragment" / "good.prm").string();

Scene scene_with(std::vector<std::string> entries, const apps::Program &app = program("compress")) {
  return read_scene(good, entries, app);
}

TEST(Quality, words_go_from_coarse_to_fine_and_leave_no_rate_to_be_given) {
  double safety = 1, crossings = 0;
  for (const char *word : {"fast", "standard", "reference"}) {
    const Scene scene = scene_with({std::string("Scene/Quality = ") + word, "Loading/Axial rate ="});
    EXPECT_LT(scene.time_step.safety, safety) << word;
    EXPECT_GT(scene.loading.wave_transits, crossings) << word;
    safety = scene.time_step.safety, crossings = scene.loading.wave_transits;
    EXPECT_NE(text_of(scene.general.quality, *scene.parameters).find(word), std::string::npos);
  }
}

TEST(Quality, what_the_scene_says_stays_and_is_told_apart) {
  const Scene scene = scene_with({"Scene/Quality = fast", "Integration/Safety = 0.3"});
  EXPECT_EQ(scene.time_step.safety, 0.3);
  EXPECT_TRUE(std::isnan(scene.loading.wave_transits)); // good.prm has its rate
  const std::string told = text_of(scene.general.quality, *scene.parameters);
  EXPECT_NE(told.find("the scene's own: Integration/Safety, Loading/Wave crossings"), std::string::npos)
      << told;
}

TEST(Quality, without_a_word_nothing_is_set_and_the_rate_has_to_be_given) {
  EXPECT_EQ(scene_with({}).general.quality, Quality::custom);
  EXPECT_EQ(scene_with({"Scene/Quality = standard"}).time_step.safety, scene_with({}).time_step.safety);
  EXPECT_EQ(text_of(Quality::custom, *scene_with({}).parameters), "");
  EXPECT_THROW(scene_with({"Loading/Axial rate ="}), InputError);
  // Discs are split at a speed of their own.
  EXPECT_THROW(scene_with({"Loading/Axial rate =", "Scene/Quality = fast", "Specimen/Shape = disc"},
                          program("brazilian")),
               InputError);
}

TEST(Quality, a_scene_written_with_it_reads_back_to_the_same) {
  const Scene scene = scene_with({"Scene/Quality = reference", "Loading/Axial rate ="});
  const fs::path copy = fs::temp_directory_path() / "platen_quality_copy.prm";
  std::ofstream(copy) << scene_text(scene, copy.parent_path());
  const Scene again = read_scene(copy.string(), {}, program("compress"));
  fs::remove(copy);
  EXPECT_EQ(again.time_step.safety, scene.time_step.safety);
  EXPECT_EQ(again.loading.wave_transits, scene.loading.wave_transits);
  EXPECT_TRUE(std::isnan(again.loading.rate));
}

} // namespace
} // namespace platen::apps
