// All programs that read scenes: platen-compress and the others are links to this one, and `platen compress`
// is the same. By itself it reads the command line and the scene, answers --help, --version and
// --print-parameters and refuses what is wrong, in some milliseconds; only for the work it loads the engine,
// whose libraries take a tenth of a second. `platen` alone lists programs, version and scenes.
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <vector>

#include "apps/engine.h"
#include "apps/programs.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "apps/scene/rank.h"
#include "apps/scene/shipped.h"
#include "apps/scene/values.h"
#include "apps/scene/version.h"

namespace {

using namespace platen::apps;
namespace fs = std::filesystem;

const std::string prefix = "platen-", report = "report";

fs::path own_folder() {
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path();
}

// Throws std::runtime_error if the library is not there or does not fit.
template <class Function>
Function in_engine(const char *name) {
  // A run has threads of its own (-t). Those of the library for dense matrices would take a tenth of a second
  // to start and end, and could add in another order on a machine with more cores.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
  std::error_code none;
  const fs::path built = own_folder() / "engine.so",
                 file = fs::exists(built, none) ? built : own_folder() / PLATEN_ENGINE;
  // Lazy: functions of solids.so are there only once it is loaded, and to bind all takes time.
  void *library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_GLOBAL); // global: plug-ins of MPI need its symbols
  void *entry = library == nullptr ? nullptr : ::dlsym(library, name);
  if (entry == nullptr)
    throw std::runtime_error(std::string(::dlerror()) + ". It belongs to platen: install both anew");
  return reinterpret_cast<Function>(entry);
}

decltype(&platen_engine) engine() {
  return in_engine<decltype(&platen_engine)>("platen_engine");
}

int start(const Program &program, int argc, char **argv) {
  if (program.on_ranks && launched_with_others()) return engine()(argc, argv, program, nullptr, nullptr);
  return run_app(argc, argv, program, [&](const CommandLine &line, const Scene &scene) {
    return engine()(argc, argv, program, &line, &scene);
  });
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
      "       platen state FOLDER [OTHER]    what the newest checkpoint of a run holds; where two differ\n"
      "       platen --version [--json]\n"
      "       platen --help\n\nPrograms, each with --help and a man page:\n";
  const auto add = [&](const std::string &word, const std::string &purpose) {
    text += "  " + word + std::string(12 - word.size(), ' ') + wrapped(purpose, 14) + '\n';
  };
  for (const Program &one : programs())
    add(one.name.substr(prefix.size()), one.purpose);
  add(report, report_purpose);
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

int print_version(const std::vector<std::string> &words) {
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  for (const std::string &word : words)
    if (word != "--json" && word != "--version") return refuse(word + " does not go with --version.");
  std::cout << (json ? version_json() : version_text()) << '\n';
  return status_done;
}

int list_state(int argc, char **argv) {
  try {
    return in_engine<decltype(&platen_state)>("platen_state")(argc, argv);
  } catch (const std::invalid_argument &error) {
    return refuse(error.what());
  } catch (const std::exception &error) {
    std::cout.flush();
    std::cerr << "error: " << error.what() << '\n';
    return dynamic_cast<const InputError *>(&error) != nullptr ? status_bad_input : status_output;
  }
}

// Becomes platen-report, a program of its own; returns only if that cannot be started.
int become_report(char **argv) {
  const fs::path path = own_folder() / (prefix + report);
  std::string name = prefix + report;
  argv[1] = name.data();
  ::execv(path.c_str(), argv + 1);
  std::cerr << "error: " << path.string() << " cannot be started: " << std::strerror(errno)
            << ". It belongs to platen: install both anew\n";
  return status_numerics;
}

int start_named(const std::string &word, int argc, char **argv) {
  std::vector<std::string> known{"scenes", "state", "--help", "--version", report};
  for (const Program &one : programs()) {
    if (one.name == prefix + word) {
      std::string name = one.name;
      argv[1] = name.data();
      return start(one, argc - 1, argv + 1);
    }
    known.push_back(one.name.substr(prefix.size()));
  }
  const std::string nearest = nearest_word(word, known);
  return refuse("PROGRAM = " + word + " is not known." +
                (nearest.empty() ? "" : " Did you mean \"" + nearest + "\"?") + " Allowed: " + joined(known) +
                ".");
}

} // namespace

int main(int argc, char **argv) {
  obey_early_signals();
  const std::string called = fs::path(argv[0]).filename().string();
  for (const Program &one : programs())
    if (one.name == called) return start(one, argc, argv);
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
  if (word == "--version" || (word == "--json" && !rest.empty())) return print_version(rest);
  if (word == "scenes") return list_scenes(rest);
  if (word == "state") return list_state(argc - 1, argv + 1);
  if (word == report) return become_report(argv);
  return start_named(word, argc, argv);
}
