#include "apps/calibrate/trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/output/csv_writer.h"
#include "apps/output/stop_signal.h"
#include "apps/programs.h"
#include "apps/run/packing_cache.h"
#include "apps/run/problem_setup.h"
#include "apps/run/specimen_setup.h"
#include "apps/scene/errors.h"
#include "apps/scene/parameters.h"
#include "base/parallel.h"
#include "coupling/static_press.h"

namespace platen::apps {
namespace {

// What decides the result; static solves do not ask for strengths.
Choice deciding(const Scene &scene, const Trial &t) {
  Choice c = t.choice;
  const Choice own = choice_of(scene);
  for (const ParameterFacts &parameter : parameter_facts(calibrate_of(scene)))
    if (!t.test.loads() && !parameter.elastic) c[parameter.parameter] = own[parameter.parameter];
  return c;
}

// Without what would break a row in two.
std::string one_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == '\n' || c == '"'; }, ';');
  return text;
}

std::vector<unsigned long> seeds_from(unsigned long first, int count) {
  std::vector<unsigned long> seeds(static_cast<std::size_t>(count));
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

} // namespace

const std::vector<std::string> usual_figures{"youngs_modulus_gauge_pa", "youngs_modulus_platen_pa",
                                             "poisson_ratio", "strength_pa", "strain_at_peak_platen"};

TrialResult solve_statically(const Scene &scene, const dem::Specimen &specimen) {
  TrialResult result;
  try {
    coupling::PlatenTest problem(specimen, problem_settings(scene));
    const coupling::StaticPress p = coupling::press_statically(problem, calibrate_of(scene).strain);
    result.summary = {{"youngs_modulus_gauge_pa", p.youngs_modulus()},
                      {"youngs_modulus_platen_pa", p.platen_modulus()},
                      {"poisson_ratio", p.poisson_ratio()}};
  } catch (const coupling::NumericsStopped &e) {
    result.status = scene.parameters->with_entries(e.what());
  }
  return result;
}

dem::NetworkModuli network_bounds(const Scene &scene, const dem::Specimen &specimen) {
  const dem::ModelSettings settings = problem_settings(scene).model;
  const dem::Particles particles(specimen, settings.density, settings.rotation);
  const dem::Bonds bonds(particles, settings.bond_layout, *settings.bond);
  return dem::network_moduli(bonds, specimen.shape.volume());
}

std::vector<std::string> entries_of_trials(const Scene &scene, const SpecimenTest &test) {
  std::vector<std::string> entries{"Output/Fields = off", "Checkpoint/Every = 0"};
  if (!scene.bond.calibrated.figures.empty())
    entries.emplace_back("Bond/Calibrated figures ="); // what is calibrated now
  if (scene.general.standard != "none")
    entries.emplace_back("Scene/Standard = none"); // a trial has no report
  const bool usual = std::all_of(test.figures.begin(), test.figures.end(),
                                 [](const std::string &key) { return holds(usual_figures, key); });
  if (usual) entries.insert(entries.end(), {"Effects/Energy ledger = off", "Effects/Crack log = off"});
  if (usual && test.curve_strain == 0) entries.emplace_back("Loading/Stop at residual = 0.8");
  if (!sets(test.entries, "Loading/Target strain") && test.curve_strain > scene.loading.target_strain)
    entries.push_back("Loading/Target strain = " + shortest_text(test.curve_strain));
  return entries;
}

TrialResult result_of(const SpecimenTest &test, const Json &summary, const std::filesystem::path &folder) {
  TrialResult result;
  if (summary.value("quasi_static", Json()) == false && summary.value("peak_reached", Json()) == true) {
    result.status = fmt::format("{}: {}", TrialResult::too_fast_words,
                                fmt::join(summary["signs_of_haste"].get<std::vector<std::string>>(), "; "));
    return result;
  }
  result.summary = summary;
  if (test.curve_strain > 0) {
    const Curve curve = curve_of_run(OutputPaths(folder).history(), summary, test.curve_of_gauge);
    if (!curve.strain.empty()) result.curve = curve.sampled(test.curve_strain);
  }
  for (const std::string &key : test.figures) {
    if (!std::isnan(result.number(key))) continue;
    const Json validity = summary.value("validity", Json::object()).value(key, Json());
    result.status =
        validity.is_array() && !validity.empty() ? validity[0].get<std::string>() : key + " was not measured";
    break;
  }
  return result;
}

std::vector<unsigned long> training_seeds(const Scene &scene) {
  return seeds_from(scene.general.seed, calibrate_of(scene).seeds);
}

std::vector<unsigned long> unseen_seeds(const Scene &scene, std::size_t round) {
  const Calibrate &c = calibrate_of(scene);
  const auto others = static_cast<unsigned long>(c.verification_seeds);
  return seeds_from(scene.general.seed + static_cast<unsigned long>(c.seeds) + round * others,
                    c.verification_seeds);
}

std::vector<std::string> entries_of(const Scene &scene, const CommandLine &command, const SpecimenTest &test,
                                    const Choice &choice, unsigned long seed) {
  std::vector<std::string> all = command.overrides, of_trials;
  if (test.loads()) of_trials = entries_of_trials(scene, test);
  for (const auto &part : {overrides_of(scene, choice), test.entries, of_trials})
    all.insert(all.end(), part.begin(), part.end());
  all.push_back("Scene/Seed = " + std::to_string(seed));
  return all;
}

Trials::Trials(const CommandLine &command, const Scene &scene, const OutputPaths &paths, int threads,
               RunLog &log)
    : command_(command),
      scene_(scene),
      paths_(paths),
      shared_(packing_cache(scene.specimen.cache).empty() ? paths.packings().string() : ""),
      threads_(threads),
      log_(log) {}

Scene Trials::with(const Choice &choice, unsigned long seed) const {
  return read_scene(command_.scene, entries_of(scene_, command_, {}, choice, seed), *scene_.program);
}

std::string Trials::key_of(const Trial &t) const {
  return fmt::format("{} {}", t.test.name,
                     fmt::join(entries_of(scene_, command_, t.test, deciding(scene_, t), t.seed), "; "));
}

void Trials::keep(const Trial &t, TrialResult result) {
  if (known_.emplace(key_of(t), std::move(result)).second) asked_.push_back(t);
}

const dem::Specimen &Trials::packing(unsigned long seed) {
  if (packings_.count(seed) == 0) {
    const ThreadLimit one(1); // a copy of this process makes a run only where it has no other thread
    packings_[seed] = packed(with(choice_of(scene_), seed));
    log_.info("packing of seed {}: {} spheres", seed, packings_[seed].size());
  }
  return packings_.at(seed);
}

dem::Specimen Trials::packed(const Scene &scene) const {
  CommandLine shared = command_;
  shared.packings = shared_;
  RunLog silent(Loudness::quiet); // what is wrong with a kept packing is made good
  return make_bonded_specimen(scene, keep_packing(shared, scene, true, silent));
}

// deal.II starts threads that stay: each solve is made in a process of its own.
void Trials::solve(const std::vector<Trial> &trials) {
  const std::vector<std::string> solved = answers(trials.size(), threads_, [&](std::size_t k) {
    const ThreadLimit one(1);
    const Scene scene = with(deciding(scene_, trials[k]), trials[k].seed);
    const TrialResult result = solve_statically(scene, packed(scene));
    return Json{{"status", result.status}, {"summary", result.summary}}.dump();
  });
  for (std::size_t k = 0; k < trials.size(); ++k, ++made_) {
    const Json answer = Json::parse(solved[k]);
    keep(trials[k], {answer["status"], answer["summary"], {}});
  }
}

void Trials::run(const std::vector<Trial> &trials) {
  const int at_a_time = std::min(threads_, static_cast<int>(trials.size()));
  std::vector<TestRun> runs;
  for (const Trial &t : trials) {
    const std::string tried = fmt::format("{}", fmt::join(overrides_of(scene_, t.choice), "; "));
    auto choice = std::find(choices_.begin(), choices_.end(), tried);
    if (choice == choices_.end()) choice = choices_.insert(choices_.end(), tried);
    TestRun run;
    run.program = t.test.program;
    run.seed = t.seed;
    run.name = fmt::format("trial_{}_{}_seed_{}", choice - choices_.begin() + 1, t.test.name, t.seed);
    run.folder = paths_.runs() / run.name;
    run.specimen_of = runs.size();
    run.scene = command_.scene;
    run.overrides = entries_of(scene_, command_, t.test, t.choice, t.seed);
    run.of_this_version = true;
    start_as(run, std::max(1, threads_ / std::max(1, at_a_time)), shared_);
    runs.push_back(std::move(run));
  }
  carry_out(runs, threads_, log_, [&](std::size_t k, const RunOutcome &outcome) {
    keep(trials[k], outcome.done ? result_of(trials[k].test, outcome.summary, runs[k].folder)
                                 : TrialResult{outcome.reason, {}, {}});
    made_ += outcome.kept ? 0 : 1;
  });
}

std::vector<TrialResult> Trials::operator()(const std::vector<Trial> &trials) {
  std::vector<Trial> solves, runs;
  std::vector<std::string> open;
  for (const Trial &t : trials) {
    const std::string key = key_of(t);
    if (known_.count(key) > 0 || holds(open, key)) continue;
    open.push_back(key);
    (t.test.loads() ? runs : solves).push_back(t);
  }
  if (!solves.empty()) solve(solves);
  if (!runs.empty()) run(runs);
  if (!open.empty()) write();
  std::vector<TrialResult> all;
  for (const Trial &t : trials) {
    all.push_back(known_.at(key_of(t)));
    if (!all.back().good()) ++failed_;
  }
  return all;
}

void Trials::write() const {
  std::vector<std::string> figures = usual_figures, columns{"test", "seed"};
  for (const Trial &t : asked_)
    for (const std::string &key : t.test.figures)
      if (!holds(figures, key)) figures.push_back(key);
  for (const ParameterFacts &parameter : parameter_facts(calibrate_of(scene_)))
    columns.push_back(parameter.column);
  columns.emplace_back("status");
  columns.insert(columns.end(), figures.begin(), figures.end());
  WholeTable table(paths_.folder / "trials.csv", columns);
  for (const Trial &t : asked_) {
    const TrialResult &result = known_.at(key_of(t));
    const std::string status = one_cell(result.status);
    std::vector<CsvCell> cells{t.test.name, t.seed};
    for (const double number : deciding(scene_, t).numbers)
      cells.emplace_back(number);
    cells.emplace_back(status);
    for (const std::string &key : figures)
      cells.emplace_back(result.number(key));
    table.row(cells);
  }
  table.finish();
}

} // namespace platen::apps
