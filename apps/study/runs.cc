#include "apps/study/runs.h"

#include <algorithm>

namespace platen::apps {

TestRun run_of(const StudyPlan &plan, std::size_t of, unsigned long seed, const std::string &scene,
               const std::vector<std::string> &overrides, const OutputPaths &paths, int threads,
               const std::filesystem::path &packings) {
  const StudyCase &one = plan.cases[of];
  TestRun run;
  run.of = of;
  run.seed = seed;
  run.name = one.name + "_seed_" + std::to_string(seed);
  run.folder = paths.runs() / run.name;
  run.scene = one.scene.empty() ? scene : one.scene;
  run.overrides = overrides_of(one, seed, overrides);
  run.seconds = one.seconds;
  start_as(run, threads, packings);
  return run;
}

std::vector<TestRun> runs_of(const StudyPlan &plan, const std::string &scene,
                             const std::vector<std::string> &overrides, const OutputPaths &paths, int threads,
                             bool one_by_one) {
  const int count = static_cast<int>(plan.cases.size() * plan.seeds.size());
  const int share = one_by_one ? threads : std::max(1, threads / count);
  std::vector<std::string> packings;
  for (const StudyCase &one : plan.cases)
    packings.insert(packings.end(), one.packings.begin(), one.packings.end());
  std::vector<TestRun> runs;
  for (std::size_t of = 0; of < plan.cases.size(); ++of)
    for (const unsigned long seed : plan.seeds) {
      const std::string &packing = packings[runs.size()];
      // A packing that one run alone has is not worth a file.
      const bool shared = !packing.empty() && std::count(packings.begin(), packings.end(), packing) > 1;
      TestRun run = run_of(plan, of, seed, scene, overrides, paths, share, shared ? paths.packings() : "");
      run.of_this_version = one_by_one;
      const auto first = std::find(packings.begin(), packings.end(), packing);
      run.specimen_of = shared ? static_cast<std::size_t>(first - packings.begin()) : runs.size();
      runs.push_back(std::move(run));
    }
  return runs;
}

} // namespace platen::apps
