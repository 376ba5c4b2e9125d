// The scenes of studies as they are given: each leads to cases that can all be run, by the command in its
// head.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/study/cases.h"
#include "apps/study/study_section.h"

namespace platen::apps {
namespace {

// Of "Run: platen-study KIND ..." in the head of a scene.
std::string kind_in(const std::filesystem::path &scene) {
  std::ifstream file(scene);
  const std::regex run("platen-study ([a-z]+) scenes/" + scene.filename().string());
  std::smatch found;
  for (std::string line; std::getline(file, line);)
    if (std::regex_search(line, found, run)) return found[1];
  ADD_FAILURE() << scene << " does not say by which platen-study it is run";
  return study_words.front();
}

TEST(StudyScenes, lead_to_cases_that_can_be_run) {
  int scenes = 0;
  for (const auto &file : std::filesystem::directory_iterator(PLATEN_SCENES)) {
    if (file.path().filename().string().rfind("study_", 0) != 0) continue;
    SCOPED_TRACE(file.path());
    ++scenes;
    try {
      const Scene scene = read_scene(file.path().string(), {}, program("study"));
      EXPECT_GT(plan_study(study_kind(kind_in(file.path())), scene, {}).cases.size(), 1u);
    } catch (const InputError &error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(scenes, 10);
}

} // namespace
} // namespace platen::apps
