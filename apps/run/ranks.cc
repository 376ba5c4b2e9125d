#include "apps/run/ranks.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/io/sha256.h"
#include "apps/scene/rank.h"
#include "base/parallel.h"
#include "dist/ranks.h"
#include "dist/session.h"

namespace platen::apps {

int run_app_on_ranks(int argc, char **argv, const AppDescription &app, const AppBody &body) {
  const dist::Session session;
  this_rank() = {session.rank(), session.ranks(), session.ranks_here(), dist::Session::end_all};
  AppDescription on_ranks = app;
  on_ranks.runs_on_ranks = true;
  return run_app(argc, argv, on_ranks, body);
}

std::unique_ptr<dem::Exchange> exchange_of_ranks() {
  if (this_rank().of == 1) return nullptr;
  return std::make_unique<dist::Ranks>(MPI_COMM_WORLD);
}

std::string words_of_cut(const dem::Exchange &exchange) {
  return dist::describe(dynamic_cast<const dist::Ranks &>(exchange).partition());
}

std::string words_of_idle_ranks(const dem::Exchange &exchange) {
  const auto &ranks = dynamic_cast<const dist::Ranks &>(exchange);
  const int useful = ranks.partition().useful_ranks;
  if (useful >= ranks.size()) return "";
  return fmt::format(
      "{} of {} ranks have nothing to do: the specimen has {} blocks of {} spheres. Useful: {} "
      "ranks, each with threads of its own (-t)",
      ranks.size() - useful, ranks.size(), ranks.partition().rank.size(), block_rows, useful);
}

dem::InstructionSet common_instruction_set(dem::InstructionSet own, dem::Exchange *exchange) {
  if (exchange == nullptr) return own;
  return static_cast<dem::InstructionSet>(-exchange->largest(-static_cast<long>(own)));
}

void require_one_scene(const std::string &text_of_scene, dem::Exchange *exchange) {
  if (exchange == nullptr) return;
  Sha256 sum;
  sum.update(text_of_scene);
  const long own = std::stol(sum.text().substr(0, 15), nullptr, 16);
  if (exchange->largest(own) != -exchange->largest(-own))
    throw InputError(
        "error: ranks were started with different scenes or entries. Allowed: one command line, "
        "mpirun -n N platen-compress SCENE.prm.");
}

} // namespace platen::apps
