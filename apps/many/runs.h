// Many runs, of a study or a calibration: a program each, several at a time, taken up again where they are
// whole.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/many/process.h"
#include "apps/output/output_folder.h"
#include "apps/output/run_log.h"
#include "apps/output/summary.h"

namespace platen::apps {

struct TestRun {
  std::string program = "compress"; // or "brazilian"
  std::size_t of = 0;               // the case that it is of
  unsigned long seed = 0;
  std::string name; // of its folder below runs/: "sphere_radius_1_mm_seed_2"
  std::filesystem::path folder;
  std::size_t specimen_of = 0; // the first run that has the same packing: itself, or one before
  double seconds = 0;          // expected; 0 where nothing is known
  std::string scene;           // that its entries change
  std::vector<std::string> overrides = {};
  std::vector<std::string> command; // the program and what it is given, but for overwrite or resume
  bool of_this_version = false;     // else a result of any version of the program is kept
  bool may_go_on = true;            // from checkpoints that are there
};

struct RunOutcome {
  bool done = false;
  bool kept = false;    // was there before
  std::string reason;   // why not done
  Json summary;         // of a run that is done
  int status = 0;       // of one that failed: exit status, or minus the number of the signal
  bool missing = false; // has not come to its end, nor failed
};
const char *word(const RunOutcome &outcome); // "done", "failed", "missing"

// What a run has left.
struct Left {
  std::optional<Json> summary; // of one that came to its end and can be kept
  std::string fault;           // why not; "" where it had not come to its end, or had not begun
  bool of_this = true;         // else its checkpoints are of no use either
  std::string status = "";     // what its summary says, where that is whole: "done", "stopped", "failed"
};
Left left_by(const TestRun &run);

// Fills the command of a run whose scene, entries and folder are known: with so many threads, and with
// packings that it shares with others in a folder; "": none.
void start_as(TestRun &run, int threads, const std::filesystem::path &packings = {});

// The run as a process of its own, with further options. This program holds the code of all programs: where
// it can, a copy of this process runs it, and no libraries are loaded anew, a quarter of a second each.
Process start(const TestRun &run, const std::vector<std::string> &further, Process::Output output);

// Removes, with `overwrite`, what runs of an earlier study have left, and nothing of the user's. Throws
// FolderError where there is any and it may not.
void clear_runs(const OutputPaths &paths, bool overwrite, const std::vector<std::filesystem::path> &inputs);

// Numbers of runs in the order in which they are best started where several run at a time, so that the last
// ones end together: the longest first, but one of each packing before all others of it, which would wait for
// it to be packed. One at a time: as they are.
std::vector<std::size_t> order_of_start(const std::vector<TestRun> &runs, int at_a_time);

// Of a run that has ended, and how many have by then.
using RunTold = std::function<void(std::size_t run, const RunOutcome &, std::size_t ended)>;

// Carries out all runs, at most `at_a_time` at once, in the order of their start; `tell` is called for each
// when it has ended, `keep` for each in their own order as soon as it and all before it have ended. A run
// whose summary says done is kept where the summary is as it was written, of this scene and of the files that
// it names now; else the reason is told and it is made again. One with checkpoints goes on from the newest;
// any other is made anew. A run that fails is an outcome, no exception; but where one cannot write, no other
// could: those under way are stopped with their checkpoints, and OutputError is thrown. A signal that asks
// this program to stop is passed on; when the runs have written their checkpoints, Stopped is thrown.
void carry_out(const std::vector<TestRun> &runs, int at_a_time, RunLog &log,
               const std::function<void(std::size_t, const RunOutcome &)> &keep, const RunTold &tell = {});

} // namespace platen::apps
