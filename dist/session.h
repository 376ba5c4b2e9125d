// MPI in a program: started only where a launcher has started several processes of it.
#pragma once

namespace platen::dist {

// Begins with MPI_Init where mpirun (or srun with PMIx) says that there are more processes than this one, and
// ends with MPI_Finalize. A program without a launcher does nothing of MPI here.
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

// Processes that a launcher says to have started, by its environment; 1 without one. Starts nothing.
int launched_processes();

} // namespace platen::dist
