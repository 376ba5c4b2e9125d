#include "apps/scene/rank.h"

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "apps/scene/errors.h"

namespace platen::apps {
namespace {

// A number that a launcher leaves in the environment; `otherwise` where there is none.
int number_in_environment(const char *name, int otherwise) {
  const char *text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

// Of this program, as Open MPI's mpirun and MPICH's say. Tasks of srun may each be a run of their own.
Rank launched() {
  Rank rank;
  const bool of_hydra = std::getenv("MPI_LOCALNRANKS") != nullptr;
  rank.of =
      number_in_environment("OMPI_COMM_WORLD_SIZE", of_hydra ? number_in_environment("PMI_SIZE", 1) : 1);
  rank.number =
      number_in_environment("OMPI_COMM_WORLD_RANK", of_hydra ? number_in_environment("PMI_RANK", 0) : 0);
  return rank;
}

} // namespace

Rank &this_rank() {
  static Rank rank;
  return rank;
}

bool launched_with_others() {
  const bool of_srun =
      std::getenv("PMIX_RANK") != nullptr && number_in_environment("SLURM_STEP_NUM_TASKS", 1) > 1;
  return launched().of > 1 || of_srun;
}

void require_one_process(const std::string &app) {
  const Rank rank = launched();
  if (rank.of < 2) return;
  this_rank() = rank;
  throw InputError(
      "mpirun has started " + std::to_string(rank.of) + " processes of " + app +
      ", which runs in one. Allowed: without mpirun; platen-compress and platen-brazilian run on "
      "several ranks, where they were built with MPI.");
}

void before_reporting_a_failure() {
  constexpr std::chrono::seconds patience{5};
  if (!this_rank().is_silent()) return;
  std::this_thread::sleep_for(patience); // the first reports what fails on all
  std::cerr << "rank " << this_rank().number << ": ";
}

void after_reporting_a_failure(int status) {
  constexpr std::chrono::milliseconds head_start{
      200}; // before what a launcher says of it, which goes another way
  if (this_rank().of == 1) return;
  std::cout.flush();
  std::cerr.flush();
  std::this_thread::sleep_for(head_start);
  if (this_rank().end_all != nullptr) this_rank().end_all(status);
}

} // namespace platen::apps
