#include "apps/study/plan_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "apps/output/csv_writer.h"
#include "apps/output/file.h"
#include "apps/output/sha256.h"
#include "apps/run/app_output.h"
#include "apps/run/changed_scene.h"
#include "apps/scene/scene_writer.h"
#include "apps/scene/version.h"

namespace platen::apps {
namespace {

namespace fs = std::filesystem;

// Three digits: they are no sharper, and a last bit that another machine rounds otherwise does not
// show.
double rounded(double value) {
  return std::isfinite(value) ? std::stod(fmt::format("{:.3g}", value)) : not_given;
}

// Resident memory of platen-compress on a hundred spheres (apps/run/needs.cc), most of it libraries.
constexpr double bytes_of_libraries = 1.7e8;

std::string line_of(const std::vector<CsvCell> &cells) {
  std::string line;
  for (const CsvCell &cell : cells) {
    if (!line.empty()) line += ',';
    cell.append_to(line);
  }
  return line + '\n';
}

// plan.csv: number from 1 on, name and folder of each run, the number of the first run with its packing, what
// it takes by counting (spheres, bytes of memory, seconds to the target strain on two threads; nan where that
// cannot be counted), and its entries over the scene.
std::string plan_text(const StudySetup &study) {
  std::string text = line_of({"run", "name", "folder", "specimen_of_run", "estimated_spheres",
                              "estimated_bytes", "estimated_seconds", "overrides"});
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const TestRun &run = study.runs[k];
    const CountedCosts &costs = study.plan.cases[run.of].costs;
    const std::string folder = run.folder.lexically_relative(study.paths.folder).string(),
                      overrides = fmt::format("{}", fmt::join(run.overrides, "; "));
    text += line_of({k + 1, run.name, folder, run.specimen_of + 1, rounded(costs.spheres),
                     rounded(costs.bytes + bytes_of_libraries), rounded(costs.seconds), overrides});
  }
  return text;
}

// What runs are called and what they change: no path, no machine.
std::string sum_of_runs(const StudySetup &study) {
  std::string text;
  for (const TestRun &run : study.runs)
    text +=
        fmt::format("{}\n{}\n{}\n", run.name, fmt::join(study.plan.cases[run.of].overrides, "\n"), run.seed);
  return sha256_of(text);
}

Json identity(const StudySetup &study) {
  return {{"kind", word(study.plan.kind)},
          {"version", version_line()},
          {"scene_sha256", sha256_of(scene_text(study.scene, study.paths.folder))},
          {"inputs_sha256", input_sums(study.scene)},
          {"runs", study.runs.size()},
          {"runs_sha256", sum_of_runs(study)}};
}

std::string change_of_scene(const StudySetup &study) {
  std::error_code none;
  const std::string another = "is of another scene";
  if (!fs::is_regular_file(study.paths.scene(), none)) return another;
  const std::vector<SceneChange> changes = changes_of_scene(study.scene, study.paths);
  if (changes.empty()) return another;
  return fmt::format("{}: {} was \"{}\", now \"{}\"", another, changes[0].entry, changes[0].was,
                     changes[0].now);
}

// Why a plan that is there is another; "" where it is the same.
std::string difference(const Json &was, const Json &now, const StudySetup &study) {
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

// What is in the folder: "" of both where it is a whole plan of this very study.
struct Found {
  bool is_there = true;   // else nothing is known of a plan
  std::string fault = {}; // what is damaged of it, file and all
  std::string other = {}; // why it is that of another study
};

Found found_plan(const StudySetup &study) {
  std::error_code none;
  const fs::path json = study.paths.plan_json();
  if (!fs::exists(fs::symlink_status(json, none))) return {false};
  const ReadSummary read = read_summary(json);
  const Json now = identity(study);
  const auto fault_of = [&](const fs::path &file, const std::string &sum) -> std::string {
    if (!fs::exists(fs::symlink_status(file, none))) return file.string() + ": is missing";
    return sha256_of_file(file).value_or("") == sum ? "" : file.string() + ": is not as it was planned";
  };
  if (!read.fault.empty()) {
    const bool of_this = fault_of(study.paths.scene(), text_in(now, "scene_sha256")).empty();
    return {true, json.string() + ": " + read.fault,
            of_this ? "" : read.fault + ", and what is left " + change_of_scene(study)};
  }
  const std::string of_csv = fault_of(study.paths.plan(), text_in(read.summary, "plan_sha256"));
  return {true,
          of_csv.empty() ? fault_of(study.paths.scene(), text_in(read.summary, "scene_sha256")) : of_csv,
          difference(read.summary, now, study)};
}

} // namespace

bool has_plan(const StudySetup &study, RunLog &log) {
  const Found found = found_plan(study);
  if (!found.other.empty())
    throw InputError(
        fmt::format("{}: error: the plan that is there {}. Allowed: another folder by --output, or to "
                    "begin anew with --overwrite, which removes its runs too.",
                    study.paths.plan_json().string(), found.other));
  if (!found.fault.empty()) log.warning("{}, the plan is written anew", found.fault);
  return found.is_there && found.fault.empty();
}

void write_plan(const StudySetup &study) {
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

void require_plan(const StudySetup &study) {
  const Found found = found_plan(study);
  const std::string file = study.paths.plan_json().string(), plan = study.again + " --plan";
  if (!found.is_there)
    throw InputError(
        fmt::format("{}: error: is missing: the study has no plan. Make one with: {}", file, plan));
  if (!found.other.empty())
    throw InputError(fmt::format(
        "{}: error: the plan {}. Allowed: the study as it was planned, or a new plan.", file, found.other));
  if (!found.fault.empty()) throw InputError(fmt::format("{}. Write it anew with: {}", found.fault, plan));
}

} // namespace platen::apps
