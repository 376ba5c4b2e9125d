// Scenes that came with the programs or the Python package: beside them where they were built, in
// share/platen where they were installed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace platen::apps {

struct ShippedScene {
  std::string name, title; // "demo_dry" without its ending; Scene/Title of the file, "" where it has none
};

// Their folder; the place where they should be if there is none.
std::filesystem::path shipped_scenes();
// In the order of their names; none where the folder cannot be read.
std::vector<ShippedScene> shipped_scene_list();

} // namespace platen::apps
