// What a user starts of an app. It answers --help, --version and --print-parameters and refuses command lines
// and scenes by itself, in some milliseconds; for all else it becomes the engine, the program with finite
// elements, solvers and VTK in it, whose hundreds of libraries take a fifth of a second to load.
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>

#include "apps/scene/apps.h"

namespace {

namespace fs = std::filesystem;

// Beside this program where it was built, or where it was installed.
fs::path engine(const std::string &name) {
  std::error_code none;
  const fs::path here = fs::read_symlink("/proc/self/exe", none).parent_path();
  const fs::path built = here / "engine" / name;
  return fs::exists(built, none) ? built : here / PLATEN_ENGINES / name;
}

// What comes while the engine is loaded waits until it can obey (run_app).
void hold_signals_back() {
  sigset_t wait;
  sigemptyset(&wait);
  sigaddset(&wait, SIGINT);
  sigaddset(&wait, SIGTERM);
  sigprocmask(SIG_BLOCK, &wait, nullptr);
}

// The engine has threads of its own (-t); those of the library for dense matrices would take a tenth of a
// second to start and end, and could add in another order on a machine with more cores.
void keep_one_thread_for_dense_matrices() {
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
}

} // namespace

int main(int argc, char **argv) {
  using namespace platen::apps;
  const AppDescription app = description_of(AppKind::PLATEN_APP);
  if (const std::optional<int> status = answer_at_once(argc, argv, app)) return *status;
  const fs::path program = engine(app.name);
  hold_signals_back();
  keep_one_thread_for_dense_matrices();
  ::execv(program.c_str(), argv);
  std::cerr << "error: " << program.string() << " cannot be started: " << std::strerror(errno)
            << ". It belongs to " << app.name << ": install both anew\n";
  return status_numerics;
}
