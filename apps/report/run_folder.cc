#include "apps/report/run_folder.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Title in the section Scene of a .prm; empty where there is none.
std::string scene_title(const fs::path &scene) {
  std::ifstream stream(scene);
  std::vector<std::string> sections;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string first, second, rest;
    words >> first;
    if (first == "subsection") {
      std::getline(words >> std::ws, second);
      sections.push_back(second.substr(0, second.find_last_not_of(" \t\r") + 1));
    } else if (first == "end" && !sections.empty()) {
      sections.pop_back();
    } else if (first == "set" && sections == std::vector<std::string>{"Scene"}) {
      words >> second;
      std::getline(words >> std::ws, rest);
      if (second == "Title" && rest.rfind('=', 0) == 0) {
        const auto begin = rest.find_first_not_of(" \t", 1);
        return begin == std::string::npos ? ""
                                          : rest.substr(begin, rest.find_last_not_of(" \t\r") - begin + 1);
      }
    }
  }
  return "";
}

nlohmann::json read_summary(const fs::path &file) {
  std::ifstream stream(file);
  try {
    return nlohmann::json::parse(stream);
  } catch (const nlohmann::json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

// The list of frames, or a remark that there is none.
FrameSeries optional_series(Run &run, const char *name, const std::string &consequence) {
  const fs::path file = run.folder / name;
  FrameSeries series;
  if (fs::exists(file)) series = read_pvd(file);
  if (series.empty())
    run.remarks.push_back(std::string(name) + (fs::exists(file) ? " lists no frame: " : " is not there: ") +
                          consequence);
  return series;
}

} // namespace

std::string Run::pattern_words() const {
  return moments.post_peak_time ? "the fall to 0.8 of the peak" : "the end";
}

Run read_run(const fs::path &folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string() + ": no such folder");
  if (!fs::exists(folder / "history.csv"))
    throw InputError(folder.string() + ": no output folder of a run, it has no history.csv");
  Run run;
  run.folder = folder;
  const fs::path whole = fs::weakly_canonical(folder);
  run.name = whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
  run.title = scene_title(folder / "scene.prm");
  if (run.title.empty()) run.title = run.name;
  run.history = read_csv(folder / "history.csv");
  run.moments = moments_of(run.history);
  if (!run.moments.post_peak_time)
    run.remarks.push_back("the stress did not fall to 0.8 of the peak: crack patterns are shown at the end");

  if (fs::exists(folder / "summary.json"))
    run.summary = read_summary(folder / "summary.json");
  else
    run.remarks.push_back("summary.json is not there (the run has not finished): its figures are left out");
  if (fs::exists(folder / "cracks.csv"))
    run.cracks = read_csv(folder / "cracks.csv", {"mode"});
  else
    run.remarks.push_back("cracks.csv is not there: no pictures of broken bonds");
  if (fs::exists(folder / "events.csv")) run.events = read_csv(folder / "events.csv");
  run.specimen = optional_series(run, "specimen.pvd", "no pictures of the specimen");
  run.bonds =
      optional_series(run, "bonds.pvd", "crack density is given per volume, not as a share of the bonds");
  run.platens = optional_series(run, "platens.pvd", "pictures are drawn without platens");
  run.contacts = optional_series(run, "contacts.pvd", "no pictures of what presses on the platens");
  return run;
}

} // namespace platen::apps::report
