// The engine: what the programs do once a command line and a scene are accepted, with VTK and MPI. The
// program loads it only for this (apps/platen.cc), and it loads solids.so only for bodies that deform.
#include "apps/engine.h"

#include <dlfcn.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include "apps/bar/run_bar.h"
#include "apps/bonds/run_bonds.h"
#include "apps/calibrate/run_calibrate.h"
#include "apps/output/state_listing.h"
#include "apps/run/compression.h"
#include "apps/run/pack.h"
#include "apps/run/ranks.h"
#include "apps/study/run_study.h"
#include "fem/load_solids.h"

namespace {

using namespace platen::apps;

const std::map<std::string, AppBody> bodies{{"platen-pack", run_pack},
                                            {"platen-bonds", run_bonds},
                                            {"platen-bar", run_bar},
                                            {"platen-compress", run_compression},
                                            {"platen-brazilian", run_brazilian},
                                            {"platen-calibrate", run_calibrate},
                                            {"platen-study", run_study}};

} // namespace

// Functions of bodies that deform are bound at their first call, after this.
void platen::fem::load_solids() {
  static const std::filesystem::path own = [] {
    Dl_info engine{};
    ::dladdr(reinterpret_cast<const void *>(&platen_engine), &engine);
    return std::filesystem::path(engine.dli_fname).parent_path();
  }();
  static void *const solids = ::dlopen((own / "solids.so").c_str(), RTLD_LAZY | RTLD_GLOBAL);
  if (solids == nullptr)
    throw std::runtime_error(std::string(::dlerror()) + ". It belongs to platen: install both anew");
}

int platen_engine(int argc, char **argv, const Program &program, const CommandLine *line,
                  const Scene *scene) {
  const AppBody &body = bodies.at(program.name);
  if (line == nullptr) return run_app_on_ranks(argc, argv, program, body);
  return body(*line, *scene);
}

int platen_state(int argc, char **argv) {
  if (argc < 2 || argc > 3)
    throw std::invalid_argument("platen state takes one or two folders. Allowed: FOLDER [OTHER].");
  if (argc == 3) return compare_states(argv[1], argv[2], std::cout) ? status_done : status_check_failed;
  list_state(argv[1], std::cout);
  return status_done;
}
