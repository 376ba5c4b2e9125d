// The engine: what the programs do once a command line and a scene are accepted, with finite elements,
// solvers and VTK. The program loads it only for this (apps/platen.cc).
#include "apps/engine.h"

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
