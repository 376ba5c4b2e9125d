#include "apps/study/study_results.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/output/sha256.h"
#include "apps/run/app_output.h"
#include "apps/run/problem_setup.h"
#include "apps/scene/expect.h"
#include "apps/study/accuracy.h"
#include "apps/study/comparisons.h"
#include "apps/study/failure_envelope.h"

namespace platen::apps {
namespace {

// What the scene expects of a run, as its summary would have it (apps/scene/expect.h), each with the name of
// the `run`.
Json expectations_of(const StudySetup &study, const TestRun &run, const RunOutcome &outcome) {
  Json list = Json::array();
  if (!study.plan.cases[run.of].is_expected) return list;
  const Json checked = outcome.done
                           ? check_expectations(study.scene, outcome.summary)
                           : unchecked_expectations(study.scene, std::string("the run is ") + word(outcome));
  for (const Json &one : checked) {
    list.push_back({{"run", run.name}});
    list.back().update(one);
  }
  return list;
}

// "NAME: why" of each of them that is not met.
std::vector<std::string> missed_in(const Json &expectations) {
  std::vector<std::string> missed;
  for (const Json &one : expectations)
    if (one.at("met") == false)
      missed.push_back(one.at("run").get<std::string>() + ": " + one.at("reason").get<std::string>());
  return missed;
}

} // namespace

bool tell_outcome(const StudySetup &study, const std::string &head, const TestRun &run,
                  const RunOutcome &outcome, RunLog &log) {
  if (!outcome.done) {
    log.warning("{}: {}, {}", head, word(outcome), outcome.reason);
    return true;
  }
  const double strength = number_in(outcome.summary, "strength_pa");
  log.info("{}: {}, {:.0f} s{}", head,
           std::isnan(strength) ? "no strength" : fmt::format("{:.4g} MPa", 1e-6 * strength),
           number_in(outcome.summary, "wall_seconds"), outcome.kept ? ", kept" : "");
  const StudyKind kind = study.plan.kind;
  const bool compared = of_platens(kind) || kind == StudyKind::accuracy || kind == StudyKind::target;
  if (compared && !has_peaked(outcome.summary))
    log.warning("{}: it reached no peak up to Loading/Target strain: it has no strength to compare",
                run.name);
  const std::vector<std::string> missed = missed_in(expectations_of(study, run, outcome));
  for (const std::string &line : missed)
    log.error("expected: {}", line);
  return missed.empty();
}

void StudyResults::keep(const TestRun &run, const RunOutcome &outcome) {
  tables.add(run, outcome);
  for (const Json &one : expectations_of(study_, run, outcome))
    expectations_.push_back(one);
}

int StudyResults::write(const std::string &status, const std::vector<unsigned long> &seeds,
                        const Analysis &analysis, const Json &costs) const {
  const std::size_t failed = tables.count("failed"), missing = tables.count("missing"),
                    all = tables.count("done") + failed + missing;
  Json study{{"kind", word(study_.plan.kind)}, {"status", status}};
  study["varied"] = study_.plan.varied;
  study["seeds"] = seeds;
  study["runs"] = all;
  study["failed_runs"] = failed;
  if (missing > 0) study["missing_runs"] = missing;
  study["cases"] = tables.cases();
  const std::string told = analysis(study);
  write_summary(study_.paths.study_json(), study);
  Json s = summary_head(study_.scene, "platen-study", status, effects_on(study_.scene));
  s.update(study);
  s["expectations"] = expectations_;
  const std::vector<std::string> missed = missed_in(expectations_);
  s["missed"] = missed;
  s.update(costs);
  s["scene_sha256"] = sha256_of_file(study_.paths.scene()).value_or("");
  s["inputs_sha256"] = input_sums(study_.scene);
  write_summary(study_.paths.summary(), s);
  log_.info("{}{}", tables.text(), told);
  if (failed > 0) log_.warning("{} of {} runs failed", failed, all);
  log_.info("results are in {}", study_.paths.folder.string());
  return missed.empty() ? status_done : status_check_failed;
}

std::string StudyResults::analyse(Json &study) const {
  const StudyPlan &plan = study_.plan;
  std::string text;
  const std::vector<std::vector<double>> strengths = strengths_of(tables.outcomes());
  if (of_platens(plan.kind)) {
    const std::vector<Comparison> comparisons = compare(plan, strengths, study_.scene.bond.calibrated);
    study["comparisons"] = json_of(plan, comparisons);
    study["laboratory"] = laboratory_figures();
    write_comparisons(study_.paths.comparisons(), study["comparisons"]);
    text = text_of(plan, comparisons);
  }
  if (const auto envelopes = failure_envelopes(plan, strengths); !envelopes.empty()) {
    study["envelopes"] = json_of(plan, envelopes);
    write_envelopes(study_.paths.envelope(), plan, study["envelopes"]);
    text += text_of(envelopes);
  }
  if (plan.kind != StudyKind::accuracy) return text;
  write_errors(study_.paths.accuracy(), plan, tables.outcomes());
  const std::vector<ParameterErrors> errors = errors_of(plan, tables.outcomes());
  study["accuracy"] = json_of(plan, errors);
  study["costs"] = costs_of(plan, errors);
  return text_of(plan, errors);
}

int StudyResults::finish(const Json &costs) const {
  const bool missing = tables.count("missing") > 0, failed = tables.count("failed") == study_.runs.size();
  const int status = write(
      missing  ? "stopped"
      : failed ? "failed"
               : "done",
      study_.plan.seeds, [&](Json &study) { return analyse(study); }, costs);
  if (failed) log_.error("no run came to its end");
  return missing || failed ? status_numerics : status;
}

} // namespace platen::apps
