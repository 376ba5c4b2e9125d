// Scenes as programs read them: a good one with entries of its own, or a file.
#pragma once

#include <string>
#include <vector>

#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/scene.h"

namespace platen::apps {

using Entries = std::vector<std::string>;

// A small cylinder with which nothing is wrong.
inline const std::string good = std::string(PLATEN_TEST_DATA) + "/fragment/good.prm";

inline Scene scene_with(const Entries &entries, const std::string &app = "compress") {
  return read_scene(good, entries, program(app));
}

// What is said of a scene that is refused; "" where it is read.
inline std::string said_of(const std::string &path, const Entries &entries = {},
                           const std::string &app = "compress") {
  try {
    read_scene(path, entries, program(app));
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}
inline std::string said_with(const Entries &entries, const std::string &app = "compress") {
  return said_of(good, entries, app);
}

} // namespace platen::apps
