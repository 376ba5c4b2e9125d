// A study as this program, this scene and these files make it, and its runs: every case on every seed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/output/output_folder.h"
#include "apps/scene/command_line.h"
#include "apps/study/cases.h"

namespace platen::apps {

struct StudySetup {
  StudySetup(const CommandLine &command, const Scene &scene);

  const CommandLine &command;
  const Scene &scene;
  StudyPlan plan;
  OutputPaths paths;
  int threads;               // of which each run gets one, or more where there are fewer runs
  std::string again;         // "platen-study friction a.prm -o results/a", for what can be done next
  std::vector<TestRun> runs; // case by case; none of a target, whose runs follow from those that are there
};

// One case on one seed, with so many threads. `packings`: the folder of those that it shares with other runs;
// "": none.
TestRun run_of(const StudySetup &study, std::size_t of, unsigned long seed, int threads,
               const std::filesystem::path &packings);

} // namespace platen::apps
