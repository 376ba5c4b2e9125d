#include "apps/study/target_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/scene/shell.h"
#include "apps/study/study_results.h"
#include "apps/study/target_report.h"

namespace platen::apps {
namespace {

// No plan has more; 1 % of a figure that scatters by 10 % needs 270.
constexpr std::size_t most_packings = 1000;

std::size_t most_of(const Counts &counts) {
  return *std::max_element(counts.begin(), counts.end());
}

// What a run has left, nothing made.
std::optional<RunOutcome> found(const TestRun &run) {
  Left left = left_by(run);
  if (left.summary) return RunOutcome{true, true, "", std::move(*left.summary), 0, false};
  if (left.fault.empty() && left.status == "failed") return RunOutcome{};
  return std::nullopt;
}

} // namespace

TargetStudy::TargetStudy(const StudySetup &setup)
    : setup_(setup), cases_(target_cases(setup.scene)), figures_(setup.scene) {
  state_.runs.transits = target_transits(setup.scene);
  state_.made.assign(cases_.speeds, 0);
  state_.errors = expected_errors(target().figure, figures_.spheres());
  ask_for(within(pilot_of(state_, figures_.costs(), aim()), state_.made, most_per_scene()));
}

double TargetStudy::step_error() const {
  const auto measured = figures_.of_half_step();
  const bool tells = measured && measured->is_certain(target().confidence);
  return tells ? std::max(target().step_allowance, std::abs(measured->mean)) : target().step_allowance;
}

Aim TargetStudy::aim() const {
  return {target().accuracy, target().confidence, std::pow(step_error(), 2), most_packings,
          static_cast<std::size_t>(target().pilot_seeds)};
}

// Those with half the step and of coarser spheres are beside.
std::size_t TargetStudy::most_per_scene() const {
  const auto most = static_cast<std::size_t>(target().most_runs),
             beside = cases_.scenes * static_cast<std::size_t>(target().step_seeds + target().coarser_seeds);
  return (most - std::min(most, beside)) / cases_.scenes;
}

std::vector<unsigned long> TargetStudy::seeds() const {
  std::vector<unsigned long> all;
  for (std::size_t s = 0; s < most_of(state_.made); ++s)
    all.push_back(setup_.scene.general.seed + s);
  return all;
}

void TargetStudy::add_to_batch(std::size_t of_case, std::size_t packing) {
  TestRun run = run_of(setup_, of_case, setup_.scene.general.seed + packing, 1, setup_.paths.packings());
  run.specimen_of = batch_.size();
  batch_.push_back(std::move(run));
  packings_.push_back(packing);
}

// Fast runs first: what slow ones need is packed then.
void TargetStudy::ask_for(const Counts &next) {
  batch_.clear(), packings_.clear(), asked_ = next;
  for (std::size_t k = 0; k < cases_.speeds; ++k)
    for (std::size_t s = state_.made[k]; s < next[k]; ++s)
      for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
        add_to_batch(cases_.at(scene, k), s);
  if (most_of(state_.made) > 0) return;
  for (std::size_t s = 0; s < static_cast<std::size_t>(target().step_seeds); ++s)
    for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
      add_to_batch(cases_.of_half_step(scene), s);
  for (std::size_t s = 0; s < static_cast<std::size_t>(target().coarser_seeds); ++s)
    for (std::size_t scene = 0; scene < cases_.scenes; ++scene)
      add_to_batch(cases_.of_coarser(scene), s);
}

void TargetStudy::add(std::size_t k, const RunOutcome &outcome) {
  figures_.add(batch_[k], packings_[k], outcome);
}

const Decision &TargetStudy::decide() {
  state_.made = asked_;
  state_.runs = figures_.runs();
  state_.errors.prior = expected_spread(target().figure, figures_.spheres());
  decision_ = apps::decide(state_, figures_.costs(), aim(), most_per_scene(), figures_.curvature_of_scenes());
  if (decision_.estimate)
    looks_.push_back({figures_.made(), seeds().size(), figures_.work(), figures_.seconds(),
                      *decision_.estimate, decision_.half});
  if (decision_.verdict == Verdict::more) ask_for(decision_.next);
  return decision_;
}

bool may_change_on_resume(const std::string &entry) {
  constexpr std::array free{"Study/Target/Accuracy", "Study/Target/Confidence", "Study/Target/Most runs",
                            "Study/Target/Step allowance"};
  return std::find(free.begin(), free.end(), entry) != free.end();
}

int tell_target_plan(const StudySetup &setup) {
  TargetStudy study(setup);
  std::size_t there = 0, asked = 0;
  do {
    std::vector<std::optional<RunOutcome>> outcomes;
    for (const TestRun &run : study.batch())
      outcomes.push_back(found(run));
    asked = outcomes.size();
    there = asked - static_cast<std::size_t>(std::count(outcomes.begin(), outcomes.end(), std::nullopt));
    if (there < asked) break;
    for (std::size_t k = 0; k < asked; ++k)
      study.add(k, *outcomes[k]);
  } while (study.decide().verdict == Verdict::more);
  const Decision &decision = study.decision();
  if (study.figures().made() == 0) {
    fmt::print(
        "no plan can be made yet: {} of {} runs of the pilot are there. Make these alone with\n  {}{}\n"
        "and plan again with --dry-run.\n",
        there, asked, setup.again, shell_entry(fmt::format("Study/Target/Most runs = {}", asked)));
    for (const TestRun &run : study.batch())
      fmt::print("  {}\n", run.name);
    return status_done;
  }
  const bool more = decision.verdict == Verdict::more;
  fmt::print("by {} runs that are there:\n{}", study.figures().made(),
             more || !decision.estimate ? look_text(study) : text_of(study));
  if (more)
    fmt::print("  {} of the next {} runs are there; go on with {} --resume\n", there, asked, setup.again);
  return status_done;
}

int make_target(const StudySetup &setup, RunLog &log, const std::function<Json()> &summary_costs) {
  TargetStudy study(setup);
  StudyResults results(setup, log);
  do {
    const std::vector<TestRun> &batch = study.batch();
    carry_out(batch, setup.threads, log, [&](std::size_t k, const RunOutcome &outcome) {
      study.add(k, outcome);
      results.keep(batch[k], outcome);
      const std::string head = fmt::format("  {}  {}", study.figures().made(), batch[k].name);
      tell_outcome(setup, head, batch[k], outcome, log);
    });
    study.decide();
    log.info("{}", look_text(study));
  } while (study.decision().verdict == Verdict::more);
  const Decision &decision = study.decision();
  const auto tell = [&](Json &json) {
    json["target"] = json_of(study);
    json["costs"] = costs_of(study);
    return text_of(study);
  };
  const bool unknown = decision.verdict == Verdict::unknown;
  const int status = results.write(unknown ? "failed" : "done", study.seeds(), tell, summary_costs());
  if (unknown) log.error("too few runs gave the figure: no interval can be told");
  if (decision.verdict == Verdict::out_of_runs)
    log.error("the accuracy of {:.2g} % was not reached: {}", 100 * study.target().accuracy,
              estimate_text(study, *decision.estimate, decision.half));
  return unknown ? status_numerics : decision.verdict == Verdict::reached ? status : status_check_failed;
}

} // namespace platen::apps
