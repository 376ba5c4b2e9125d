// platen: one word for all programs. `platen compress SCENE.prm` becomes `platen-compress SCENE.prm`; by
// itself it names the programs, the version and the scenes that came with them.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <vector>

#include "apps/scene/apps.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/shipped.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"

namespace {

using namespace platen::apps;
namespace fs = std::filesystem;

struct Program {
  std::string word, purpose;
};

std::vector<Program> programs() {
  std::vector<Program> all;
  const std::string prefix = "platen-";
  for (const AppKind kind : {AppKind::pack, AppKind::bonds, AppKind::bar, AppKind::compress,
                             AppKind::brazilian, AppKind::calibrate, AppKind::study}) {
    const AppDescription app = description_of(kind);
    all.push_back({app.name.substr(prefix.size()), app.purpose});
  }
  all.push_back({"report", report_purpose});
  return all;
}

// In lines of at most 80 characters, all but the first behind `indent` blanks.
std::string wrapped(const std::string &text, std::size_t indent) {
  constexpr std::size_t width = 80;
  std::string lines;
  std::size_t column = indent;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    if (column + end - at > width && column > indent) {
      lines += '\n' + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      lines += ' ';
      ++column;
    }
    lines += text.substr(at, end - at);
    column += end - at;
    at = end + 1;
  }
  return lines;
}

std::string help() {
  std::string text =
      "Platen crushes and pulls specimens of bonded spheres between the platens of a testing machine.\n\n"
      "Usage: platen PROGRAM [ARGUMENTS]     the same as platen-PROGRAM [ARGUMENTS]\n"
      "       platen scenes [NAME]           the scenes that came with it; the path of one\n"
      "       platen --version [--json]\n"
      "       platen --help\n\nPrograms, each with --help and a man page:\n";
  for (const Program &program : programs())
    text += "  " + program.word + std::string(12 - program.word.size(), ' ') + wrapped(program.purpose, 14) +
            '\n';
  return text;
}

int refuse(const std::string &what) {
  std::cerr << "command line: error: " << what << '\n';
  return status_bad_input;
}

int list_scenes(const std::vector<std::string> &names) {
  if (names.size() > 1) return refuse("one argument too many. Allowed: platen scenes [NAME].");
  if (names.empty()) {
    std::cout << shipped_scenes().string() << '\n';
    for (const ShippedScene &scene : shipped_scene_list())
      std::cout << "  " << scene.name << std::string(scene.name.size() < 30 ? 30 - scene.name.size() : 1, ' ')
                << scene.title << '\n';
    return status_done;
  }
  std::vector<std::string> known;
  for (const ShippedScene &scene : shipped_scene_list()) {
    if (scene.name == names[0] || scene.name + ".prm" == names[0]) {
      std::cout << (shipped_scenes() / (scene.name + ".prm")).string() << '\n';
      return status_done;
    }
    known.push_back(scene.name);
  }
  const std::string nearest = nearest_word(names[0], known);
  return refuse("NAME = " + names[0] + " is no scene in " + shipped_scenes().string() + "." +
                (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") + " platen scenes lists them.");
}

int tell_version(const std::vector<std::string> &words) {
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  for (const std::string &word : words)
    if (word != "--json" && word != "--version") return refuse(word + " does not go with --version.");
  std::cout << (json ? version_json() : version_text()) << '\n';
  return status_done;
}

// Becomes the program; comes back only where it cannot.
int become(const Program &program, char **argv) {
  std::error_code none;
  const std::string name = "platen-" + program.word;
  const fs::path path = fs::read_symlink("/proc/self/exe", none).parent_path() / name;
  std::string first = name;
  argv[1] = first.data();
  ::execv(path.c_str(), argv + 1);
  std::cerr << "error: " << path.string() << " cannot be started: " << std::strerror(errno)
            << ". It belongs to platen: install both anew\n";
  return status_numerics;
}

} // namespace

int main(int argc, char **argv) {
  if (argc < 2) {
    std::cerr << help();
    return status_bad_input;
  }
  const std::string word = argv[1];
  const std::vector<std::string> rest(argv + 2, argv + argc);
  if (word == "-h" || word == "--help" || word == "help") {
    std::cout << help();
    return status_done;
  }
  if (word == "--version" || (word == "--json" && !rest.empty())) return tell_version(rest);
  if (word == "scenes") return list_scenes(rest);
  std::vector<std::string> known{"scenes", "--help", "--version"};
  for (const Program &program : programs()) {
    if (program.word == word) return become(program, argv);
    known.push_back(program.word);
  }
  const std::string nearest = nearest_word(word, known);
  return refuse("PROGRAM = " + word + " is not known." +
                (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") + " Allowed: " + joined(known) +
                ".");
}
