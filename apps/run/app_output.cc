#include "apps/run/app_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/output/file.h"
#include "apps/output/machine.h"
#include "apps/output/sha256.h"
#include "apps/run/figures.h"
#include "apps/scene/expect.h"
#include "apps/scene/parameters.h"
#include "apps/scene/rank.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

// What options of the command line have set to another text than the scene file has.
Json overridden(const Scene &scene) {
  Json list = Json::array();
  for (const Entry &entry : scene.parameters->entries())
    if (entry.overridden())
      list.push_back({{"entry", entry.path}, {"value", entry.text}, {"in_scene_file", entry.of_file}});
  return list;
}

} // namespace

int threads_of(const CommandLine &command) {
  const int cores = this_machine().cores;
  return command.threads > 0 ? std::min(command.threads, cores) : std::max(1, cores / this_rank().here);
}

Loudness loudness_of(const CommandLine &command) {
  return command.quiet ? Loudness::quiet : (command.verbose ? Loudness::verbose : Loudness::normal);
}

std::string title_of(const Scene &scene) {
  return scene.general.title.empty() ? scene.name : scene.general.title;
}

std::vector<std::filesystem::path> input_files(const Scene &scene) {
  const std::vector<std::string> &sources = scene.parameters->sources();
  std::vector<std::filesystem::path> files(sources.begin(), sources.end());
  for (const Entry &entry : scene.parameters->entries())
    if (entry.is_file && !entry.text.empty()) files.emplace_back(resolved_path(entry));
  return files;
}

Json input_sums(const Scene &scene) {
  Json sums = Json::object();
  for (const Entry &entry : scene.parameters->entries())
    if (entry.is_file && !entry.text.empty())
      if (const std::optional<std::string> sum = sha256_of_file(resolved_path(entry)))
        sums[entry.path] = *sum;
  return sums;
}

AppOutput::AppOutput(const CommandLine &command, const Scene &scene, bool from_checkpoint)
    : paths(command.output),
      log(loudness_of(command)),
      command_(command),
      scene_(scene),
      inputs_(input_files(scene)),
      use_(command.resume      ? FolderUse::resume
           : command.overwrite ? FolderUse::overwrite
                               : FolderUse::fresh),
      limit_(threads_of(command)) {
  if (command.dry_run) return;
  input_sums_ = input_sums(scene);
  if (!command.resume || from_checkpoint) check_output_folder(paths.folder, use_, inputs_);
  std::error_code none;
  if (std::filesystem::exists(paths.log(), none)) lock_ = lock_folder(paths.folder, patience_of_run, log);
  if (!command.resume) return;
  if (from_checkpoint)
    changes_ = require_same_physics(scene, paths);
  else
    require_same_scene(scene, paths);
}

double AppOutput::seconds() const {
  return seconds_since(start_);
}

void AppOutput::open(int working_threads) {
  std::error_code none;
  const bool was_there = std::filesystem::exists(paths.folder, none);
  try {
    if (!command_.resume) {
      open_locked(lock_, paths.folder, use_, inputs_, log);
      write_text_aside(paths.scene(), scene_text(scene_, paths.folder));
    }
    log.open(paths.log(), command_.resume, {version_text(), command_.text, working_threads});
    if (command_.threads > this_machine().cores)
      log.info("{} threads were asked for, {} are used: more than there are cores only wait for each other",
               command_.threads, threads_of(command_));
  } catch (const OutputError &) { // a full disk: no folder is left in which nothing is
    if (!was_there)
      for (const std::filesystem::path &made : {paths.log(), paths.scene(), paths.folder})
        std::filesystem::remove(made, none);
    throw;
  }
  scene_sum_ = sha256_of_file(paths.scene()).value_or("");
}

void AppOutput::keep_changes() {
  if (changes_.empty()) return;
  for (const SceneChange &change : changes_)
    log.info("led on with another {}: {}, it was {}", change.entry, change.now.empty() ? "none" : change.now,
             change.was.empty() ? "none" : change.was);
  write_text_aside(paths.scene(), scene_text(scene_, paths.folder));
  scene_sum_ = sha256_of_file(paths.scene()).value_or("");
}

void AppOutput::save(Json summary) const {
  summary["scene_sha256"] = scene_sum_;
  summary["inputs_sha256"] = input_sums_;
  write_summary(paths.summary(), summary);
}

int AppOutput::finish(Json summary, const std::string &report) {
  summary["expectations"] = check_expectations(scene_, summary);
  save(summary);
  log.info("{}", report);
  return report_expectations(summary);
}

int AppOutput::report_expectations(const Json &summary) {
  bool all_met = true;
  std::vector<std::string> unchecked;
  for (const Json &one : summary.at("expectations")) {
    if (one.at("met").is_null())
      unchecked.push_back(one.at("entry").get<std::string>().substr(std::string("Expect/").size()));
    else if (!one.at("met").get<bool>()) {
      log.error("expected: {}", one.at("reason").get<std::string>());
      all_met = false;
    }
  }
  if (!unchecked.empty())
    log.info("expected, but measured by another app and not checked here: {}", fmt::join(unchecked, ", "));
  return all_met ? status_done : status_check_failed;
}

Json summary_head(const Scene &scene, const std::string &app, const std::string &status,
                  const std::vector<std::string> &effects) {
  Json s;
  s["status"] = status;
  s["app"] = app;
  s["scene"] = title_of(scene);
  s["scene_file"] = scene.path;
  s["overridden"] = overridden(scene);
  s["version"] = version_line();
  s["effects"] = effects;
  return s;
}

void TestFigures::add(const dem::Model &model, long steps_made) {
  steps += steps_made;
  broken_tension += model.broken_tension;
  broken_shear += model.broken_shear;
  for (std::size_t k = 0; k < stage_seconds.size(); ++k)
    stage_seconds[k] += model.clock.seconds(static_cast<dem::Stage>(k));
}

void add_figures(Json &s, const TestFigures &f) {
  const double particles = static_cast<double>(f.particles);
  Json measured{{"particles", f.particles},
                {"bonds", f.bonds},
                {"coordination_number", 2.0 * static_cast<double>(f.bonds) / particles},
                {"packing_fraction", f.packing_fraction},
                {"steps", f.steps},
                {"time_step_s", f.time_step},
                {"time_step_reason", f.time_step_reason},
                {"threads", f.threads},
                {"wall_seconds", f.wall_seconds},
                {"setup_seconds", f.setup_seconds},
                {"particle_steps_per_second", particles * static_cast<double>(f.steps) / f.wall_seconds},
                {"peak_memory_bytes", peak_memory_bytes()},
                {"youngs_modulus_gauge_pa", f.youngs_modulus},
                {"poisson_ratio", f.poisson_ratio},
                {"broken_tension", f.broken_tension},
                {"broken_shear", f.broken_shear},
                {"energy_residual_relative", f.energy_residual.value()}};
  for (std::size_t k = 0; k < f.stage_seconds.size(); ++k)
    measured["stage_seconds"][dem::stage_names[k]] = f.stage_seconds[k];
  for (const Figure &figure : figures())
    if ((figure.needs & of_every_test) != 0) s[figure.key] = measured.value(figure.key, Json());
}

} // namespace platen::apps
