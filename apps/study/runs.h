// The runs of a study: every case on every seed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/many/runs.h"
#include "apps/study/cases.h"

namespace platen::apps {

// One case on one seed, with so many threads; `scene` is the study's, `overrides` those of the command line.
// `packings`: the folder of those that it shares with other runs; "": none.
TestRun run_of(const StudyPlan &plan, std::size_t of, unsigned long seed, const std::string &scene,
               const std::vector<std::string> &overrides, const OutputPaths &paths, int threads,
               const std::filesystem::path &packings = {});

// Every case on every seed, case by case; `overrides` are those of the command line. Of `threads` each run
// gets one, or its share where there are fewer runs; where runs are made `one_by_one`, each gets all.
std::vector<TestRun> runs_of(const StudyPlan &plan, const std::string &scene,
                             const std::vector<std::string> &overrides, const OutputPaths &paths, int threads,
                             bool one_by_one = false);

} // namespace platen::apps
