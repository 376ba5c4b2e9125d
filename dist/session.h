// MPI in a program: started only where a launcher has started several processes of it.
#pragma once

namespace platen::dist {

// Calls MPI_Init where mpirun (or srun with PMIx) reports more than one process, and MPI_Finalize at the end.
// Without a launcher it does not use MPI.
class Session {
public:
  Session();
  ~Session();
  Session(const Session &) = delete;
  Session &operator=(const Session &) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }           // 1: no launcher
  int ranks_here() const { return ranks_here_; } // on this machine
  // Ends all ranks at once with this exit status.
  [[noreturn]] static void end_all(int status);

private:
  int rank_ = 0, ranks_ = 1, ranks_here_ = 1;
};

// Number of processes by the launcher's environment variables; 1 without a launcher. Does not start MPI.
int launched_processes();

} // namespace platen::dist
