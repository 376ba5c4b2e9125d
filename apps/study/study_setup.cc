#include "apps/study/study_setup.h"

#include <algorithm>
#include <cmath>

#include "apps/output/machine.h"

namespace platen::apps {
namespace {

// Where runs are made one by one, each has all threads and is of the plan's version alone.
std::vector<TestRun> runs_of(const StudySetup &study) {
  const bool one_by_one = study.command.run > 0 || study.command.plan || study.command.collect;
  std::vector<std::string> packings;
  for (const StudyCase &one : study.plan.cases)
    packings.insert(packings.end(), one.packings.begin(), one.packings.end());
  const int share =
      one_by_one ? study.threads : std::max(1, study.threads / static_cast<int>(packings.size()));
  std::vector<TestRun> runs;
  for (std::size_t of = 0; of < study.plan.cases.size(); ++of)
    for (const unsigned long seed : study.plan.seeds) {
      const std::string &packing = packings[runs.size()];
      // A packing that one run alone has is not worth a file.
      const bool shared = !packing.empty() && std::count(packings.begin(), packings.end(), packing) > 1;
      TestRun run = run_of(study, of, seed, share, shared ? study.paths.packings() : "");
      run.of_this_version = one_by_one;
      const auto first = std::find(packings.begin(), packings.end(), packing);
      run.specimen_of = shared ? static_cast<std::size_t>(first - packings.begin()) : runs.size();
      runs.push_back(std::move(run));
    }
  return runs;
}

} // namespace

StudySetup::StudySetup(const CommandLine &command_line, const Scene &of)
    : command(command_line),
      scene(of),
      plan(plan_study(study_kind(command.kind), scene, command.overrides)),
      paths(command.output),
      threads(command.threads > 0 ? command.threads : this_machine().cores),
      again(shell_command("platen-study", command)) {
  if (plan.kind != StudyKind::target) runs = runs_of(*this);
}

TestRun run_of(const StudySetup &study, std::size_t of, unsigned long seed, int threads,
               const std::filesystem::path &packings) {
  const StudyCase &one = study.plan.cases[of];
  TestRun run;
  run.of = of;
  run.seed = seed;
  run.name = one.name + "_seed_" + std::to_string(seed);
  run.folder = study.paths.runs() / run.name;
  run.scene = one.scene.empty() ? study.command.scene : one.scene;
  run.overrides = overrides_of(one, seed, study.command.overrides);
  if (std::isfinite(one.costs.seconds)) run.seconds = one.costs.seconds;
  start_as(run, threads, packings);
  return run;
}

} // namespace platen::apps
