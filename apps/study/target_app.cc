#include "apps/study/target_app.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/output/sha256.h"
#include "apps/run/app_output.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/shell.h"
#include "apps/study/study_results.h"
#include "apps/study/study_section.h"
#include "apps/study/target_report.h"

namespace platen::apps {
namespace {

constexpr std::array free_entries{"Study/Target/Accuracy", "Study/Target/Confidence",
                                  "Study/Target/Most runs", "Study/Target/Step allowance"};

// Runs of a scene that is over another, and coarser ones, are not what the scene expects.
class Expecting {
public:
  Expecting(const Scene &scene, const TargetCases &cases) : scene_(scene), other_(scene), cases_(cases) {
    other_.expect.clear();
  }
  const Scene &of(const TestRun &run) const { return run.of < cases_.speeds ? scene_ : other_; }

private:
  const Scene &scene_;
  Scene other_;
  TargetCases cases_;
};

Json study_json(const TargetStudy &study, const StudyTables &tables, const std::string &status) {
  Json all;
  all["kind"] = word(study.setup().plan.kind);
  all["status"] = status;
  all["varied"] = study.setup().plan.varied;
  all["seeds"] = study.seeds();
  all["runs"] = study.figures().made();
  all["failed_runs"] = tables.failed();
  all["cases"] = tables.cases();
  all["target"] = json_of(study);
  all["costs"] = costs_of(study);
  return all;
}

int status_of(const TargetStudy &study, const std::vector<std::string> &missed) {
  switch (study.decision().verdict) {
    case Verdict::reached:
      return missed.empty() ? status_done : status_check_failed;
    case Verdict::unknown:
      return status_numerics;
    default:
      return status_check_failed;
  }
}

void write_results(const TargetStudy &study, const StudyTables &tables, const Json &expectations,
                   const Json &costs) {
  const Scene &scene = study.setup().scene;
  const OutputPaths &paths = study.setup().paths;
  const Json json =
      study_json(study, tables, study.decision().verdict == Verdict::unknown ? "failed" : "done");
  write_summary(paths.study_json(), json);
  Json s = summary_head(scene, "platen-study", json["status"], effects_on(scene));
  s.update(json);
  s["expectations"] = expectations;
  s["missed"] = missed_in(expectations);
  s.update(costs);
  s["scene_sha256"] = sha256_of_file(paths.scene()).value_or("");
  s["inputs_sha256"] = input_sums(scene);
  write_summary(paths.summary(), s);
}

// What a run has left, nothing made.
std::optional<RunOutcome> found(const TestRun &run) {
  Left left = left_by(run);
  if (left.summary) return RunOutcome{true, true, "", std::move(*left.summary), 0, false};
  if (left.fault.empty() && left.status == "failed") return RunOutcome{};
  return std::nullopt;
}

} // namespace

bool may_change_on_resume(const std::string &entry) {
  return std::find(free_entries.begin(), free_entries.end(), entry) != free_entries.end();
}

int tell_target_plan(const TargetSetup &setup) {
  TargetStudy study(setup);
  std::size_t there = 0, asked = 0;
  study.work(
      [&](const std::vector<TestRun> &batch) {
        std::vector<std::optional<RunOutcome>> outcomes;
        there = 0, asked = batch.size();
        for (const TestRun &run : batch) {
          outcomes.push_back(found(run));
          if (outcomes.back()) ++there;
        }
        for (std::size_t k = 0; there == asked && k < asked; ++k)
          study.add(k, *outcomes[k]);
        return there == asked;
      },
      [] {});
  if (study.looks().empty() && study.figures().made() == 0) {
    fmt::print(
        "no plan can be made yet: {} of {} runs of the pilot are there. Make these alone with\n  {}{}\n"
        "and plan again with --dry-run.\n",
        there, asked, setup.command, shell_entry(fmt::format("Study/Target/Most runs = {}", asked)));
    for (const TestRun &run : study.batch())
      fmt::print("  {}\n", run.name);
    return status_done;
  }
  fmt::print("by {} runs that are there:\n{}", study.figures().made(),
             study.decision().verdict == Verdict::more || !study.decision().estimate ? look_text(study)
                                                                                     : text_of(study));
  if (study.decision().verdict == Verdict::more)
    fmt::print("  {} of the next {} runs are there; go on with {} --resume\n", there, asked, setup.command);
  return status_done;
}

int make_target(const TargetSetup &setup, RunLog &log, const std::function<Json()> &summary_costs) {
  TargetStudy study(setup);
  StudyTables tables(setup.plan, setup.paths);
  const Expecting expecting(setup.scene, target_cases(setup.scene));
  Json expectations = Json::array();
  const auto carry = [&](const std::vector<TestRun> &batch) {
    carry_out(batch, setup.threads, log, [&](std::size_t k, const RunOutcome &outcome) {
      study.add(k, outcome);
      tables.add(batch[k], outcome);
      const std::string head = fmt::format("  {}  {}", study.figures().made(), batch[k].name);
      for (const Json &one :
           tell_outcome(expecting.of(batch[k]), setup.plan.kind, head, batch[k], outcome, log))
        expectations.push_back(one);
    });
    return true;
  };
  study.work(carry, [&] { log.info("{}", look_text(study)); });
  write_results(study, tables, expectations, summary_costs());
  log.info("{}{}", tables.text(), text_of(study));
  if (tables.failed() > 0) log.warning("{} of {} runs failed", tables.failed(), study.figures().made());
  log.info("results are in {}", setup.paths.folder.string());
  if (study.decision().verdict == Verdict::unknown)
    log.error("too few runs gave the figure: no interval can be told");
  if (study.decision().verdict == Verdict::out_of_runs)
    log.error("the accuracy of {:.2g} % was not reached: {}", 100 * study_of(setup.scene).target.accuracy,
              estimate_text(study, *study.decision().estimate, study.decision().half));
  return status_of(study, missed_in(expectations));
}

} // namespace platen::apps
