#include "apps/run/ranks.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "apps/output/errors.h"
#include "apps/output/rank_checkpoint.h"
#include "apps/scene/rank.h"
#include "base/parallel.h"
#include "dist/agree.h"
#include "dist/ranks.h"
#include "dist/session.h"

namespace platen::apps {

int run_app_on_ranks(int argc, char **argv, const Program &program, const AppBody &body) {
  constexpr std::chrono::milliseconds to_leave{300}; // for the other ranks
  int status = status_done;
  {
    const dist::Session session;
    this_rank() = {session.rank(), session.ranks(), session.ranks_here(), dist::Session::end_all};
    status = run_app(argc, argv, program, body, require_same_on_ranks);
  }
  // All have come to the end. A launcher ends a job of which one process reports a failure, and may wait for
  // ever where others leave at that moment: the first one alone reports it, as the last to leave.
  if (this_rank().is_silent()) return status_done;
  if (this_rank().of > 1 && status != status_done) std::this_thread::sleep_for(to_leave);
  return status;
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

CommonSet common_instruction_set(dem::InstructionSet own, dem::Exchange *exchange, bool resumes) {
  if (exchange == nullptr) return {own, ""};
  const auto weakest = static_cast<dem::InstructionSet>(-exchange->largest(-static_cast<long>(own))),
             best = static_cast<dem::InstructionSet>(exchange->largest(static_cast<long>(own)));
  if (weakest == best) return {weakest, ""};
  return {weakest,
          fmt::format("machines of this run have the instruction sets {} and {}: all go {} {}{}",
                      dem::name(best), dem::name(weakest), resumes ? "on with" : "by", dem::name(weakest),
                      resumes ? ", and the last digits are no longer those of the part before" : "")};
}

void require_same_on_ranks(const std::string &text) {
  if (this_rank().of > 1 && !dist::same_on_all(MPI_COMM_WORLD, text))
    throw InputError(
        "error: ranks were started with different scenes or entries. Allowed: one command line, "
        "mpirun -n N platen-compress SCENE.prm.");
}

void write_checkpoint_of_ranks(dem::Model &specimen, const std::string &part,
                               const std::filesystem::path &folder, std::uint64_t step,
                               const std::function<void(StateSink &)> &fill) {
  const auto &ranks = dynamic_cast<const dist::Ranks &>(*specimen.exchange());
  write_rank_checkpoint(ranks.communicator(), dist::SpreadState(ranks, specimen, part), folder, step, fill);
}

} // namespace platen::apps
