#include "apps/study/study_results.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/output/sha256.h"
#include "apps/run/app_output.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/expect.h"
#include "apps/scene/values.h"
#include "apps/study/comparisons.h"
#include "apps/study/failure_envelope.h"

namespace platen::apps {

namespace {

Json named(const std::string &run, const Json &expectations) {
  Json list = Json::array();
  for (const Json &one : expectations) {
    list.push_back({{"run", run}});
    list.back().update(one);
  }
  return list;
}

} // namespace

std::vector<std::string> missed_in(const Json &expectations) {
  std::vector<std::string> missed;
  for (const Json &one : expectations)
    if (one.at("met") == false)
      missed.push_back(one.at("run").get<std::string>() + ": " + one.at("reason").get<std::string>());
  return missed;
}

Json tell_outcome(const Scene &scene, StudyKind kind, const std::string &head, const TestRun &run,
                  const RunOutcome &outcome, RunLog &log) {
  if (!outcome.done) {
    log.warning("{}: {}, {}", head, word(outcome), outcome.reason);
    return named(run.name, unchecked_expectations(scene, std::string("the run is ") + word(outcome)));
  }
  const double strength = number_in(outcome.summary, "strength_pa");
  log.info("{}: {}, {:.0f} s{}", head,
           std::isnan(strength) ? "no strength" : fmt::format("{:.4g} MPa", 1e-6 * strength),
           number_in(outcome.summary, "wall_seconds"), outcome.kept ? ", kept" : "");
  const bool compared = of_platens(kind) || kind == StudyKind::accuracy || kind == StudyKind::target;
  if (compared && !StudyTables::peaked(outcome.summary))
    log.warning("{}: it reached no peak up to Loading/Target strain: it has no strength to compare",
                run.name);
  Json expectations = named(run.name, check_expectations(scene, outcome.summary));
  for (const std::string &line : missed_in(expectations))
    log.error("expected: {}", line);
  return expectations;
}

StudyResults::StudyResults(const Scene &scene, const StudyPlan &plan, const std::vector<TestRun> &runs,
                           const OutputPaths &paths, RunLog &log)
    : scene_(scene),
      plan_(plan),
      runs_(runs),
      paths_(paths),
      log_(log),
      tables_(plan, paths),
      accuracy_(plan),
      expectations_(runs.size()) {}

void StudyResults::tell(std::size_t k, const RunOutcome &outcome, std::size_t ended) {
  const std::string head = fmt::format("  {} of {}  {}", ended, runs_.size(), runs_[k].name);
  expectations_[k] = tell_outcome(scene_, plan_.kind, head, runs_[k], outcome, log_);
}

void StudyResults::keep(std::size_t k, const RunOutcome &outcome) {
  tables_.add(runs_[k], outcome);
  accuracy_.add(runs_[k], outcome);
}

std::string StudyResults::compare(Json &study) const {
  std::string text;
  const std::vector<std::vector<double>> strengths = tables_.strengths();
  if (of_platens(plan_.kind)) {
    const std::vector<Comparison> comparisons = apps::compare(plan_, strengths, scene_.bond.calibrated);
    write_comparisons(paths_.comparisons(), plan_, comparisons);
    study["comparisons"] = json_of(plan_, comparisons);
    study["laboratory"] = laboratory_figures();
    text = text_of(plan_, comparisons);
  }
  if (const auto envelopes = failure_envelopes(plan_, strengths); !envelopes.empty()) {
    write_envelopes(paths_.envelope(), plan_, envelopes);
    study["envelopes"] = json_of(plan_, envelopes);
    text += text_of(envelopes);
  }
  if (plan_.kind != StudyKind::accuracy) return text;
  accuracy_.write_rows(paths_.accuracy());
  const std::vector<ParameterErrors> errors = accuracy_.errors();
  study["accuracy"] = json_of(plan_, errors);
  study["costs"] = costs_of(plan_, errors);
  return text_of(plan_, errors);
}

std::string StudyResults::status() const {
  if (tables_.missing() > 0) return "stopped";
  return tables_.failed() < static_cast<int>(runs_.size()) ? "done" : "failed";
}

Json StudyResults::study_json() const {
  Json study;
  study["kind"] = word(plan_.kind);
  study["status"] = status();
  study["varied"] = plan_.varied;
  study["seeds"] = plan_.seeds;
  study["runs"] = runs_.size();
  study["failed_runs"] = tables_.failed();
  if (tables_.missing() > 0) study["missing_runs"] = tables_.missing();
  study["cases"] = tables_.cases();
  return study;
}

int StudyResults::finish(const Json &costs) {
  Json study = study_json();
  const std::string compared = compare(study);
  write_summary(paths_.study_json(), study);
  Json s = summary_head(scene_, "platen-study", study["status"], effects_on(scene_));
  s.update(study);
  s["expectations"] = Json::array();
  for (const Json &of_run : expectations_)
    for (const Json &one : of_run)
      s["expectations"].push_back(one);
  const std::vector<std::string> missed = missed_in(s["expectations"]);
  s["missed"] = missed;
  s.update(costs);
  s["scene_sha256"] = sha256_of_file(paths_.scene()).value_or("");
  s["inputs_sha256"] = input_sums(scene_);
  write_summary(paths_.summary(), s);
  log_.info("{}{}", tables_.text(), compared);
  if (tables_.failed() > 0) log_.warning("{} of {} runs failed", tables_.failed(), runs_.size());
  log_.info("results are in {}", paths_.folder.string());
  if (tables_.missing() > 0) return status_numerics;
  if (status() == "failed") {
    log_.error("no run came to its end");
    return status_numerics;
  }
  return missed.empty() ? status_done : status_check_failed;
}

} // namespace platen::apps
