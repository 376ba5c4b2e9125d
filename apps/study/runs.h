// The runs of a study: one platen-compress each, several at a time, taken up again where they are whole.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "apps/io/output_folder.h"
#include "apps/io/run_log.h"
#include "apps/io/summary.h"
#include "apps/study/cases.h"
#include "apps/study/process.h"

namespace platen::apps {

struct StudyRun {
  std::size_t of = 0; // StudyPlan::cases
  unsigned long seed = 0;
  std::string name; // of its folder below runs/: "sphere_radius_0.001_seed_2"
  std::filesystem::path folder;
  std::size_t specimen_of = 0; // the first run that has the same packing: itself, or one before
  std::string scene;           // that its entries change
  std::vector<std::string> overrides = {};
  std::vector<std::string> command; // platen-compress and what it is given, but for overwrite or resume
};

struct RunOutcome {
  bool done = false;
  bool kept = false;  // was there before
  std::string reason; // why not done
  Json summary;       // of a run that is done
};

// The program beside this one. Throws InputError where it is not there.
std::filesystem::path compress_program();

// Every case on every seed, case by case; `overrides` are those of the command line. Of `threads` each run
// gets one, or its share where there are fewer runs.
std::vector<StudyRun> runs_of(const StudyPlan &plan, const std::string &scene,
                              const std::vector<std::string> &overrides, const OutputPaths &paths,
                              int threads);

// Carries out all runs, at most `at_a_time` at once, started in their order; `keep` is called for each in
// that order as soon as it and all before it have ended. A run whose summary says done is kept where the
// summary is as it was written, of this scene and of the files that it names now; else the reason is told and
// it is made again. One with checkpoints goes on from the newest; any other is made anew. A run that fails is
// an outcome, no exception; but where one cannot write, no other could: those under way are stopped with
// their checkpoints, and OutputError is thrown. A signal that asks this program to stop is passed on; when
// the runs have written their checkpoints, Stopped is thrown.
void carry_out(const std::vector<StudyRun> &runs, int at_a_time, RunLog &log,
               const std::function<void(std::size_t, const RunOutcome &)> &keep);

} // namespace platen::apps
