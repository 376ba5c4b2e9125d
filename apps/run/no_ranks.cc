// Where the library was built without MPI: one rank.
#include "apps/run/ranks.h"

namespace platen::apps {

int run_app_on_ranks(int argc, char **argv, const AppDescription &app, const AppBody &body) {
  return run_app(argc, argv, app, body);
}

std::unique_ptr<dem::Exchange> exchange_of_ranks() {
  return nullptr;
}

std::string words_of_cut(const dem::Exchange &) {
  return "";
}

std::string words_of_idle_ranks(const dem::Exchange &) {
  return "";
}

dem::InstructionSet common_instruction_set(dem::InstructionSet own, dem::Exchange *) {
  return own;
}

void require_one_scene(const std::string &, dem::Exchange *) {}

} // namespace platen::apps
