// Runs the apps on several ranks of this machine, as mpirun does for a user.
#pragma once

#include <string>
#include <vector>

#include "apps/program.h"
#include "apps/scratch_folder.h"

namespace platen::apps::testing {

class OnRanks : public ScratchFolder {
protected:
  OnRanks(); // sets what Open MPI needs to run more ranks than there are cores, by anybody

  // mpirun with so many ranks of `program`; delayed: each message waits for a random moment first.
  static std::vector<std::string> on(int ranks, const std::vector<std::string> &program,
                                     bool delayed = false);
  // platen-compress on the small scene, shortened to some 500 steps, into the folder `name`;
  // on one thread unless `more` says otherwise.
  static std::vector<std::string> crush(const std::string &name, const std::vector<std::string> &more = {});

  Outcome run(const std::vector<std::string> &command) const { return run_program(command, folder_); }
  // The run on one process that others are compared with, made once for all tests of this process; its
  // folder.
  std::filesystem::path whole(const std::vector<std::string> &more = {}) const;
  // On so many ranks; it must end well.
  void run_on(int ranks, const std::string &name, const std::vector<std::string> &more = {},
              bool delayed = false) const;
  // Starts a run on ranks and does `act` with it once history.csv has so many lines; its status.
  template <class Act>
  int disturb(const std::vector<std::string> &command, const std::string &name, long lines, const Act &act) {
    Program program(command, folder_);
    EXPECT_TRUE(program.wait_until([&] { return rows_in(name) >= lines; })) << said();
    act(program);
    return program.wait();
  }
  long rows_in(const std::string &name) const;
  std::string said() const; // on the error stream of the last run

  // Files and blocks of checkpoints in which two runs differ, but for what tells time and machine; "" where
  // they agree.
  std::string unlike(const std::filesystem::path &one, const std::string &other) const;
  // The same, but that the checkpoint before the last may be another one: that of a stop.
  std::string unlike_at_end(const std::filesystem::path &one, const std::string &other) const;
};

// Of the processes that mpirun has started; throws where there is none.
pid_t process_of_rank(pid_t mpirun, int rank);

// How often a part stands in a text.
long count_of(const std::string &text, const std::string &part);

} // namespace platen::apps::testing
