// Which of several processes of one run this is. One unless mpirun has started more, and the app runs on
// them: then all do the same, and the first alone speaks and writes.
#pragma once

#include <string>

namespace platen::apps {

struct Rank {
  int number = 0, of = 1;
  int here = 1;                          // on this machine
  void (*end_all)(int status) = nullptr; // ends all of them; null: the launcher does
  bool is_silent() const { return number > 0; }
};

// Of this process; set once, at the start of main.
Rank &this_rank();

// Whether a launcher has started several processes of this program, which make one run if it runs on ranks.
bool launched_with_others();

// Throws InputError where mpirun has started several processes of an app that runs in one. The first of them
// reports it.
void require_one_process(const std::string &app);

// A failure of this rank alone, or of all of them: the first reports it, another one waits a moment for that;
// then all are ended with this status, for they may be waiting for each other. Nothing on one rank.
void before_reporting_a_failure();
void after_reporting_a_failure(int status);

} // namespace platen::apps
