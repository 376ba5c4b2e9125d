#include "apps/scene/shipped.h"

#include <dlfcn.h>

#include <algorithm>
#include <fstream>

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// Value of the first `set Title = ` in the file.
std::string title_in(const fs::path &file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::string key = "set Title";
    const std::size_t found = line.find(key), equals = line.find('=');
    if (found == std::string::npos || equals == std::string::npos) continue;
    const std::size_t first = line.find_first_not_of(' ', equals + 1);
    return first == std::string::npos ? "" : line.substr(first);
  }
  return "";
}

// Of the file that holds this code: a program, or the module that a Python has loaded.
fs::path own_folder() {
  std::error_code none;
  Dl_info own{};
  if (dladdr(reinterpret_cast<const void *>(&shipped_scenes), &own) != 0 && own.dli_fname != nullptr) {
    const fs::path file = own.dli_fname;
    if (file.extension() == ".so") return fs::absolute(file, none).parent_path();
  }
  return fs::read_symlink("/proc/self/exe", none).parent_path();
}

} // namespace

fs::path shipped_scenes() {
  std::error_code none;
  const fs::path here = own_folder(), scenes = fs::path("share") / "platen" / "scenes";
  // A program's prefix is one folder above it, an engine's two, the Python package's up to four.
  for (fs::path up = here.parent_path(); up.has_relative_path(); up = up.parent_path())
    if (fs::is_directory(up / scenes, none)) return up / scenes;
  return here.parent_path() / scenes;
}

std::vector<ShippedScene> shipped_scene_list() {
  std::vector<ShippedScene> list;
  std::error_code none;
  for (const fs::directory_entry &file : fs::directory_iterator(shipped_scenes(), none))
    if (file.path().extension() == ".prm")
      list.push_back({file.path().stem().string(), title_in(file.path())});
  std::sort(list.begin(), list.end(),
            [](const ShippedScene &a, const ShippedScene &b) { return a.name < b.name; });
  return list;
}

} // namespace platen::apps
