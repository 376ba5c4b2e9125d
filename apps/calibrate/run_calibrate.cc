#include "apps/calibrate/run_calibrate.h"

#include <fmt/format.h>

#include <optional>
#include <sstream>

#include "apps/calibrate/abacus.h"
#include "apps/calibrate/expected_tests.h"
#include "apps/calibrate/found_report.h"
#include "apps/calibrate/trials.h"
#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/stop_signal.h"
#include "apps/run/app_output.h"
#include "apps/run/needs.h"
#include "apps/run/problem_setup.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/shell.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

std::string description(const Scene &scene, const CommandLine &command, const std::optional<Goals> &goals) {
  const Calibrate &c = calibrate_of(scene);
  return title_of(scene) +
         fmt::format("\n  {}: {} seeds to calibrate on, {} to judge by\n", word_of(calibrate_modes, c.mode),
                     c.seeds, goals ? c.verification_seeds : 0) +
         (goals ? wishes(*goals) + expected_tests(scene, command, *goals) : "");
}

void tell_bounds(const Scene &scene, Trials &trials, RunLog &log, Json &s) {
  const dem::Specimen &first = trials.packing(scene.general.seed);
  const dem::NetworkModuli b = network_bounds(scene, first);
  log.info(
      "  of the bonds alone, as the scene has them: E at most {:.5g} GPa (Voigt, nu {:.4f}), "
      "about {:.5g} GPa (Reuss, nu {:.4f})",
      1e-9 * b.young_voigt, b.poisson_voigt, 1e-9 * b.young_reuss, b.poisson_reuss);
  s["particles"] = first.size();
  s["bounds"] = {{"young_voigt_pa", b.young_voigt},
                 {"poisson_voigt", b.poisson_voigt},
                 {"young_reuss_pa", b.young_reuss},
                 {"poisson_reuss", b.poisson_reuss}};
}

// All tests of the goals on all packings, choice after choice.
std::vector<Measured> measure(const Goals &goals, const std::vector<unsigned long> &seeds,
                              const std::vector<Choice> &choices, bool elastic_alone, Trials &trials,
                              RunLog &log) {
  std::vector<Trial> asked;
  for (const Choice &choice : choices)
    for (const unsigned long seed : seeds)
      for (std::size_t k = elastic_alone ? goals.elastic_test() : 0; k < goals.tests().size(); ++k)
        asked.push_back({goals.tests()[k], seed, choice});
  const std::vector<TrialResult> results = trials(asked);
  for (std::size_t k = 0; k < asked.size(); ++k)
    if (!results[k].good())
      log.warning("seed {}, {}: {}", asked[k].seed, asked[k].test.name, results[k].status);
  std::vector<Measured> all;
  const auto stride = static_cast<std::ptrdiff_t>(choices.empty() ? 0 : results.size() / choices.size());
  for (auto from = results.begin(); from != results.end(); from += stride)
    all.push_back(goals.measured({from, from + stride}, elastic_alone));
  return all;
}

// One trial a line: what was changed, what came of it.
void tell_trial(const Goals &goals, const std::vector<ParameterFacts> &free, const Choice &choice,
                const Measured &m, bool elastic, int trial, RunLog &log) {
  std::string text = elastic ? "  static solve:" : fmt::format("  trial {}:", trial);
  for (const ParameterFacts &parameter : free)
    if (!elastic || parameter.elastic) text += " " + text_of(parameter, choice[parameter.parameter]) + ",";
  text.back() = ':';
  for (const std::size_t k : goals.wanted(elastic))
    text += fmt::format(" {} {};", goals.all()[k].words(), measured_text(goals, k, m));
  text.back() = '.';
  log.info("{}", text);
}

// Where packings that the search has not seen miss a target, it goes on by the mean over these too, and is
// judged on others.
Judged find(const Scene &scene, const Goals &goals, Trials &trials, RunLog &log) {
  constexpr std::size_t most_rounds = 3;
  const std::vector<unsigned long> seeds = training_seeds(scene);
  const std::vector<ParameterFacts> free = parameters_of(scene);
  const bool elastic = goals.wanted(true) == goals.wanted();
  int trial = 0;
  const Measurement test = [&](const std::vector<Choice> &choices, bool elastic_alone) {
    std::vector<Measured> all = measure(goals, seeds, choices, elastic_alone, trials, log);
    for (std::size_t k = 0; k < all.size(); ++k)
      tell_trial(goals, free, choices[k], all[k], elastic_alone, elastic_alone ? 0 : ++trial, log);
    return all;
  };
  std::vector<Measured> trained, unseen;
  const Judge judge = [&](const Found &found) -> std::optional<Correction> {
    trained.push_back(measure(goals, seeds, {found.choice}, elastic, trials, log).front());
    const std::vector<unsigned long> others = unseen_seeds(scene, unseen.size());
    if (others.empty()) return std::nullopt;
    unseen.push_back(measure(goals, others, {found.choice}, elastic, trials, log).front());
    std::string missed;
    for (const std::size_t k : goals.wanted())
      if (!goals.met(k, unseen.back())) missed += (missed.empty() ? "" : ", ") + goals.all()[k].words();
    if (missed.empty() || unseen.size() >= most_rounds) return std::nullopt;
    log.info("  on {} packings that were not searched on {} missed: the search goes on by their mean too",
             others.size(), missed + (missed.find(',') == std::string::npos ? " is" : " are"));
    return goals.correction(trained, unseen);
  };
  Judged judged;
  judged.found = search(scene, goals, test, judge);
  if (trained.empty()) judge(judged.found); // static solves alone
  judged.analysis = analyse(goals, judged.found);
  judged.training = trained.back();
  if (!unseen.empty()) judged.unseen = unseen.back();
  return judged;
}

// found.prm: the scene itself with what was found in it.
void write_found(const CommandLine &command, const Scene &scene, const Goals &goals, const Judged &judged,
                 const AppOutput &output) {
  std::vector<std::string> overrides = command.overrides;
  for (const std::string &one : overrides_of(scene, judged.found.choice))
    overrides.push_back(one);
  if (!scene.bond.calibrated.figures.empty())
    overrides.emplace_back("Bond/Calibrated figures="); // of other bonds
  const Scene found = read_scene(command.scene, overrides, *scene.program);
  const std::string comment = fmt::format("Found by platen-calibrate from {} ({}).\n{}{}", found.name,
                                          version_line(), table_of(goals, judged), findings(goals, judged));
  std::string text;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);)
    text += "# " + line + "\n";
  write_text_aside(output.paths.folder / "found.prm", text + scene_text(found, output.paths.folder));
}

} // namespace

int run_calibrate(const CommandLine &command, const Scene &scene) {
  std::optional<Goals> goals; // a curve that is none is found before anything is written
  if (calibrate_of(scene).mode == CalibrateMode::search) goals.emplace(scene);
  const std::string said = description(scene, command, goals);
  if (command.dry_run) {
    fmt::print("{}", said);
    return status_done;
  }
  require_memory(scene, specimen_shape(scene));
  AppOutput output(command, scene);
  catch_stop_signals();
  if (!command.resume) clear_runs(output.paths, command.overwrite, input_files(scene));
  output.open();
  output.log.info("{}", said);
  const CalibrateMode mode = calibrate_of(scene).mode;
  Json s = summary_head(scene, "platen-calibrate", "done", effects_on(scene));
  s["mode"] = word_of(calibrate_modes, mode);
  s["threads"] = output.threads();
  std::vector<std::string> unmet;
  try {
    Trials trials(command, scene, output.paths, output.threads(), output.log);
    tell_bounds(scene, trials, output.log, s);
    if (mode == CalibrateMode::abacus) s["abacus"] = make_abacus(scene, output.paths, trials, output.log);
    if (goals) {
      const Judged judged = find(scene, *goals, trials, output.log);
      tell_found(*goals, judged, s);
      unmet = gaps(*goals, judged);
      write_curves(*goals, judged, output.paths);
      write_found(command, scene, *goals, judged, output);
      std::string found = "calibrated:";
      for (const ParameterFacts &parameter : parameters_of(scene))
        found += " " + text_of(parameter, judged.found.choice[parameter.parameter]) + ",";
      found.back() = '\n';
      output.log.info("{}{}{}", found, table_of(*goals, judged), findings(*goals, judged));
    }
    s["trials"] = trials.made();
    s["failed_trials"] = trials.failed();
  } catch (const Stopped &stopped) {
    output.log.info("stopped by a signal; go on with: {} --resume",
                    shell_command("platen-calibrate", command));
    return exit_status_of_signal(stopped.signal);
  }
  s["wall_seconds"] = output.seconds();
  s["peak_memory_bytes"] = peak_memory_bytes();
  const int status = output.finish(s, fmt::format("results are in {}", output.paths.folder.string()));
  for (const std::string &gap : unmet)
    output.log.error("target missed: {}", gap);
  return unmet.empty() ? status : status_check_failed;
}

} // namespace platen::apps
