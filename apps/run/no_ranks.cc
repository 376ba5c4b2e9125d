// Where the library was built without MPI: one rank.
#include "apps/run/ranks.h"

#include <stdexcept>

namespace platen::apps {

int run_app_on_ranks(int argc, char **argv, const Program &program, const AppBody &body) {
  return run_app(argc, argv, program, body);
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

CommonSet common_instruction_set(dem::InstructionSet own, dem::Exchange *, bool) {
  return {own, ""};
}

void require_same_on_ranks(const std::string &) {}

void write_checkpoint_of_ranks(dem::Model &, const std::string &, const std::filesystem::path &,
                               std::uint64_t, const std::function<void(StateSink &)> &) {
  throw std::logic_error("a specimen is cut, but there are no ranks");
}

} // namespace platen::apps
