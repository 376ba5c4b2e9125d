#include "apps/study/plan_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <sstream>

#include "apps/output/csv_writer.h"
#include "apps/output/file.h"
#include "apps/output/sha256.h"
#include "apps/programs.h"
#include "apps/run/app_output.h"
#include "apps/run/changed_scene.h"
#include "apps/run/needs.h"
#include "apps/scene/scene_writer.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> columns{"run",
                                       "name",
                                       "folder",
                                       "specimen_of_run",
                                       "estimated_spheres",
                                       "estimated_bytes",
                                       "estimated_seconds",
                                       "overrides"};

// Three digits: they are no sharper, and a last bit that another machine rounds otherwise does not
// show.
double rounded(double value) {
  return std::isfinite(value) ? std::stod(fmt::format("{:.3g}", value)) : not_given;
}

// Resident memory of platen-compress on a hundred spheres (apps/run/needs.cc), most of it libraries.
constexpr double bytes_of_libraries = 1.7e8;

CountedCosts with_libraries(CountedCosts costs) {
  costs.bytes += bytes_of_libraries;
  return costs;
}

// Of the first run of a case.
CountedCosts costs_of_run(const TestRun &run) {
  try {
    return with_libraries(counted_costs(read_scene(run.scene, run.overrides, program("compress"))));
  } catch (const std::exception &) { // which its run will tell
    return {not_given, not_given, not_given};
  }
}

std::string line_of(const std::vector<CsvCell> &cells) {
  std::string line;
  for (const CsvCell &cell : cells) {
    if (!line.empty()) line += ',';
    cell.append_to(line);
  }
  return line + '\n';
}

// What runs are called and what they change: no path, no machine.
std::string sum_of_runs(const PlannedStudy &study) {
  std::string text;
  for (const TestRun &run : study.runs)
    text +=
        fmt::format("{}\n{}\n{}\n", run.name, fmt::join(study.plan.cases[run.of].overrides, "\n"), run.seed);
  return sha256_of(text);
}

Json identity(const PlannedStudy &study) {
  Json of;
  of["kind"] = word(study.plan.kind);
  of["version"] = version_line();
  of["scene_sha256"] = sha256_of(scene_text(study.scene, study.paths.folder));
  of["inputs_sha256"] = input_sums(study.scene);
  of["runs"] = study.runs.size();
  of["runs_sha256"] = sum_of_runs(study);
  return of;
}

std::string change_of_scene(const PlannedStudy &study) {
  std::error_code none;
  const std::string another = "is of another scene";
  if (!fs::is_regular_file(study.paths.scene(), none)) return another;
  const std::vector<SceneChange> changes = changes_of_scene(study.scene, study.paths);
  if (changes.empty()) return another;
  return fmt::format("{}: {} was \"{}\", now \"{}\"", another, changes[0].entry, changes[0].was,
                     changes[0].now);
}

// Why a plan that is there is another; "" where it is the same.
std::string difference(const Json &was, const Json &now, const PlannedStudy &study) {
  if (text_in(was, "kind") != text_in(now, "kind")) return "is of a study of " + text_in(was, "kind");
  if (text_in(was, "version") != text_in(now, "version"))
    return fmt::format("was made by {}, this is {}", text_in(was, "version"), text_in(now, "version"));
  if (text_in(was, "scene_sha256") != text_in(now, "scene_sha256")) return change_of_scene(study);
  for (const auto &[entry, sum] : now["inputs_sha256"].items())
    if (text_in(was.value("inputs_sha256", Json::object()), entry) != sum)
      return fmt::format("was made with another file: what {} names has changed", entry);
  for (const char *key : {"inputs_sha256", "runs", "runs_sha256"})
    if (was.value(key, Json()) != now[key]) return "has other runs";
  return "";
}

// What speaks against a file of the plan; "" where it holds what it should.
std::string fault_of(const fs::path &file, const std::string &sum) {
  std::error_code none;
  if (!fs::exists(fs::symlink_status(file, none))) return "is missing";
  return sha256_of_file(file).value_or("") == sum ? "" : "is not as it was planned";
}

std::string first_fault(const PlannedStudy &study, const Json &plan) {
  for (const auto &[file, key] :
       {std::pair{study.paths.plan(), "plan_sha256"}, {study.paths.scene(), "scene_sha256"}})
    if (const std::string fault = fault_of(file, text_in(plan, key)); !fault.empty())
      return file.string() + ": " + fault;
  return "";
}

} // namespace

std::string plan_text(const PlannedStudy &study) {
  std::string text = line_of({columns.begin(), columns.end()});
  CountedCosts costs;
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const TestRun &run = study.runs[k];
    if (k == 0 || run.of != study.runs[k - 1].of) costs = costs_of_run(run);
    const std::string folder = run.folder.lexically_relative(study.paths.folder).string(),
                      overrides = fmt::format("{}", fmt::join(run.overrides, "; "));
    text += line_of({k + 1, run.name, folder, run.specimen_of + 1, rounded(costs.spheres),
                     rounded(costs.bytes), rounded(costs.seconds), overrides});
  }
  return text;
}

bool has_plan(const PlannedStudy &study, RunLog &log) {
  std::error_code none;
  const fs::path file = study.paths.plan_json();
  if (!fs::exists(fs::symlink_status(file, none))) return false;
  const ReadSummary read = read_summary(file);
  if (!read.fault.empty()) {
    const std::string other = change_of_scene(study);
    if (fault_of(study.paths.scene(), text_in(identity(study), "scene_sha256")).empty()) {
      log.warning("{}: {}, the plan is written anew", file.string(), read.fault);
      return false;
    }
    throw InputError(
        fmt::format("{}: error: {}, and what is left {}. Allowed: another folder by --output, or to "
                    "begin anew with --overwrite.",
                    file.string(), read.fault, other));
  }
  if (const std::string other = difference(read.summary, identity(study), study); !other.empty())
    throw InputError(
        fmt::format("{}: error: the plan that is there {}. Allowed: another folder by --output, or "
                    "to begin anew with --overwrite, which removes its runs too.",
                    file.string(), other));
  const std::string fault = first_fault(study, read.summary);
  if (!fault.empty()) log.warning("{}, the plan is written anew", fault);
  return fault.empty();
}

void write_plan(const PlannedStudy &study) {
  const std::string text = plan_text(study);
  Json plan = identity(study);
  plan["plan_sha256"] = sha256_of(text);
  create_folder(study.paths.runs());
  write_summary(study.paths.plan_json(), plan);
  write_text_aside(study.paths.scene(), scene_text(study.scene, study.paths.folder));
  write_text_aside(study.paths.plan(), text);
  std::error_code none;
  if (!fs::exists(study.paths.study_json(), none))
    write_summary(study.paths.study_json(), Json{{"kind", word(study.plan.kind)}, {"status", "planned"}});
}

void require_plan(const PlannedStudy &study) {
  std::error_code none;
  const fs::path file = study.paths.plan_json();
  const std::string plan = study.command + " --plan";
  if (!fs::exists(fs::symlink_status(file, none)))
    throw InputError(
        fmt::format("{}: error: is missing: the study has no plan. Make one with: {}", file.string(), plan));
  const ReadSummary read = read_summary(file);
  if (!read.fault.empty())
    throw InputError(fmt::format("{}: error: {}. Write it anew with: {}", file.string(), read.fault, plan));
  if (const std::string other = difference(read.summary, identity(study), study); !other.empty())
    throw InputError(
        fmt::format("{}: error: the plan {}. Allowed: the study as it was planned, or a new plan.",
                    file.string(), other));
  if (const std::string fault = first_fault(study, read.summary); !fault.empty())
    throw InputError(fmt::format("{}. Write it anew with: {}", fault, plan));
}

} // namespace platen::apps
