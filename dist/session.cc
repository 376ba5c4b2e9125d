#include "dist/session.h"

#include <mpi.h>

#include <algorithm>
#include <cstdlib>

namespace platen::dist {

// OpenMPI's mpirun; launchers of MPICH; srun with PMIx gives the number of tasks in the step.
int launched_processes() {
  const auto number = [](const char *name) {
    const char *text = std::getenv(name);
    return text == nullptr ? 0 : std::atoi(text);
  };
  int most = std::max({1, number("OMPI_COMM_WORLD_SIZE"), number("PMI_SIZE")});
  if (std::getenv("PMIX_RANK") != nullptr) most = std::max(most, number("SLURM_STEP_NUM_TASKS"));
  return most;
}

Session::Session() {
  if (launched_processes() < 2) return;
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  MPI_Comm here = MPI_COMM_NULL;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &here);
  MPI_Comm_size(here, &ranks_here_);
  MPI_Comm_free(&here);
}

Session::~Session() {
  if (ranks_ > 1) MPI_Finalize();
}

void Session::end_all(int status) {
  MPI_Abort(MPI_COMM_WORLD, status);
  std::_Exit(status);
}

} // namespace platen::dist
