#include "apps/report/run_folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <regex>

#include "apps/report/head.h"
#include "apps/report/letters.h"
#include "apps/report/stages.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"
#include "apps/scene/units.h"
#include "dem/measure/acoustic_emission.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Where the stress has fallen to this share of the peak, the crack pattern is judged: later the ends are
// eaten too.
constexpr double post_peak_share = 0.8;

Json read_summary_of(const Run &run) {
  const ReadSummary read = read_summary(run.folder / "summary.json");
  if (!read.summary.is_object()) throw InputError((run.folder / "summary.json").string() + ": " + read.fault);
  return read.summary;
}

constexpr std::array<std::array<const char *, 2>, 3> stress_columns{
    {{"stress_left_pa", "stress_right_pa"},
     {"stress_front_pa", "stress_back_pa"},
     {"axial_stress_bottom_pa", "axial_stress_top_pa"}}};

int loaded_axis(const Json &summary) {
  const auto told = summary.find("loaded_axis");
  if (told == summary.end() || !told->is_string()) return 2;
  return *told == "x" ? 0 : *told == "y" ? 1 : 2;
}

// The list of frames, or a remark that there is none.
FrameSeries optional_series(Run &run, const char *name, const std::string &consequence) {
  const fs::path file = run.folder / name;
  FrameSeries series;
  if (is_pipe_or_device(file)) throw InputError(file.string() + ": is a pipe or a device, no file");
  if (fs::exists(file)) series = read_pvd(file);
  if (series.empty())
    run.remarks.push_back(std::string(name) + (fs::exists(file) ? " lists no frame: " : " is not there: ") +
                          consequence);
  return series;
}

// Rows up to a time, the last of them.
std::size_t row_at(const CsvTable &history, double end) {
  constexpr double nearly = 1e-9; // of the time
  const std::vector<double> &time = history.column("time_s");
  std::size_t row = 0;
  while (row + 1 < time.size() && time[row + 1] <= end * (1 + nearly))
    ++row;
  return row;
}

// In summaries that do not say when the consolidation ended: from their strain at the peak, which counts from
// there.
std::size_t zero_told_by_strain(const Run &run) {
  constexpr double nearly = 1e-9; // of a strain, as the summary prints it
  const double told = number_in(run.summary, "strain_at_peak_platen");
  if (std::isnan(told) || !run.history.has("axial_strain_platen") || run.axis != 2) return 0;
  const std::vector<double> &strain = run.history.column("axial_strain_platen");
  const double sign = run.moments.peak_stress < 0 ? -1 : 1,
               start = strain[run.moments.peak_row] - sign * told;
  for (std::size_t row = run.moments.peak_row; row > 0; --row)
    if (std::abs(strain[row] - start) < nearly) return row;
  return 0;
}

std::size_t zero_row(const Run &run) {
  const double told = number_in(run.summary, "consolidation_end_time_s");
  if (!std::isnan(told)) return row_at(run.history, told);
  const std::size_t row = end_of_consolidation(run);
  return row > 0 || run.summary.contains("consolidation_end_time_s") ? row : zero_told_by_strain(run);
}

// b-values of older summaries are of all events from a limit on, whether or not they follow a power law.
void fit_anew(Run &run) {
  const auto acoustic = run.summary.find("acoustic");
  if (!run.events || !run.events->has("magnitude") || acoustic == run.summary.end() ||
      !acoustic->is_object() || acoustic->contains("b_before_reason"))
    return;
  const std::vector<double> &time = run.events->column("time_s"), &all = run.events->column("magnitude");
  std::vector<double> before, after;
  for (std::size_t k = 0; k < time.size(); ++k)
    (time[k] > run.moments.peak_time ? after : before).push_back(all[k]);
  acoustic->update(json_of_b(dem::b_value(before), "b_before"));
  acoustic->update(json_of_b(dem::b_value(after), "b_after"));
  run.remarks.push_back("b-values are fitted anew to events.csv: the summary is of an earlier version");
}

// Of stresses that are not finite, as older versions could write them; "" where all are.
std::string words_of_gaps(const CsvTable &history, int axis) {
  const std::vector<double> stress = platen_stress(history, axis);
  const auto finite = [](double value) { return std::isfinite(value); };
  const auto first = std::find_if_not(stress.begin(), stress.end(), finite);
  if (first == stress.end()) return "";
  return fmt::format(
      "history.csv has {} of {} rows without a stress, the first at the time {:.6g} s: the largest may be "
      "one of them",
      std::count_if(stress.begin(), stress.end(), [&](double value) { return !finite(value); }),
      stress.size(), history.column("time_s")[static_cast<std::size_t>(first - stress.begin())]);
}

} // namespace

std::string scene_entry(const fs::path &scene, const std::string &path) {
  static const std::regex form(R"(\s*(subsection\b|end\b|set\b)\s*([^#=]*?)\s*(=\s*([^#]*?)\s*)?(#.*)?)");
  std::ifstream stream = open_file(scene);
  std::vector<std::string> sections;
  std::smatch found;
  for (std::string line; std::getline(stream, line);) {
    if (!std::regex_match(line, found, form)) continue;
    if (found[1] == "subsection")
      sections.push_back(found[2]);
    else if (found[1] == "set" && fmt::format("{}/{}", fmt::join(sections, "/"), found[2].str()) == path)
      return found[4];
    else if (found[1] == "end" && !sections.empty())
      sections.pop_back();
  }
  return "";
}

double number_of_scene(const fs::path &folder, const std::string &path, const std::string &si_unit) {
  const fs::path scene = folder / "scene.prm";
  const std::string text = fs::exists(scene) ? scene_entry(scene, path) : "";
  if (text.empty()) return std::nan("");
  try {
    return to_si(text, si_unit);
  } catch (const ValueError &error) {
    throw InputError(scene.string() + ": " + path + " = " + text + " " + error.what());
  }
}

std::vector<double> platen_stress(const CsvTable &history, int axis) {
  const auto &[low, high] = stress_columns[static_cast<std::size_t>(axis)];
  const std::vector<double> &top = history.column(high), &bottom = history.column(low);
  std::vector<double> stress(top.size());
  for (std::size_t k = 0; k < stress.size(); ++k)
    stress[k] = 0.5 * (top[k] + bottom[k]);
  return stress;
}

Moments moments_of(const CsvTable &history, int axis) {
  const std::vector<double> stress = platen_stress(history, axis);
  const std::vector<double> &time = history.column("time_s");
  Moments moments;
  bool found = false;
  for (std::size_t k = 0; k < stress.size(); ++k)
    if (std::isfinite(stress[k]) && (!found || std::abs(stress[k]) > std::abs(moments.peak_stress))) {
      moments.peak_row = k;
      moments.peak_stress = stress[k];
      found = true;
    }
  if (!found) throw InputError(history.file.string() + ": no sample with a stress along " + "xyz"[axis]);
  moments.peak_time = time[moments.peak_row];
  moments.end_time = time.back();

  const double size = std::abs(moments.peak_stress), fallen = post_peak_share * size;
  const double sign = moments.peak_stress < 0 ? -1 : 1;
  for (std::size_t k = moments.peak_row + 1; k < stress.size(); ++k) {
    const double before = sign * stress[k - 1], now = sign * stress[k];
    if (now > fallen || before <= fallen) continue;
    moments.post_peak_time = time[k - 1] + (time[k] - time[k - 1]) * (before - fallen) / (before - now);
    break;
  }
  return moments;
}

// The summary's, of one sample: where pressures change or stages hold and unload, the peak is not the largest
// stress, and a stress that falls by command is no fall. Older summaries say neither.
void Run::take_moments() {
  moments = moments_of(history, axis);
  const double peak = number_in(summary, "peak_time_s");
  if (!std::isnan(peak)) {
    moments.peak_row = row_at(history, peak);
    moments.peak_stress = stress()[moments.peak_row];
    moments.peak_time = history.column("time_s")[moments.peak_row];
  }
  if (!summary.is_object() || !summary.contains("fall_time_s")) return;
  const double fall = number_in(summary, "fall_time_s");
  moments.post_peak_time = std::isnan(fall) ? std::nullopt : std::optional<double>(fall);
}

std::vector<double> Run::strain() const {
  return since_zero(axis == 0 ? "strain_x" : axis == 1 ? "strain_y" : "axial_strain_platen");
}

std::string Run::stress_title() const {
  return axis == 2 ? "Axial stress (MPa)" : fmt::format("Stress along {} (MPa)", "xyz"[axis]);
}

std::string Run::strain_origin() const {
  return zero > 0 ? " from the end of consolidation" : "";
}

std::string Run::strain_title() const {
  const std::string along = axis == 2 ? "Axial strain" : fmt::format("Strain along {}", "xyz"[axis]);
  return along + " between platens" + strain_origin() + " (mm/m)";
}

std::vector<double> Run::since_zero(const std::string &column) const {
  std::vector<double> values = history.column(column);
  const double start = values[zero];
  for (double &value : values)
    value -= start;
  return values;
}

std::vector<double> Run::from_zero(std::vector<double> values) const {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(zero));
  return values;
}

std::optional<bool> Run::peak_reached() const {
  const auto told = summary.find("peak_reached");
  if (told == summary.end() || !told->is_boolean()) return {};
  return told->get<bool>();
}

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
  run.history = read_csv(folder / "history.csv");
  if (fs::exists(folder / "summary.json")) run.summary = read_summary_of(run);
  run.title = scene_entry(folder / "scene.prm", "Scene/Title");
  run.title = valid_utf8(true_title(run.title.empty() ? run.name : run.title, folder, run.summary));
  run.axis = loaded_axis(run.summary);
  run.take_moments();
  run.zero = zero_row(run);
  if (const std::string gaps = words_of_gaps(run.history, run.axis); !gaps.empty())
    run.remarks.push_back(gaps);
  if (!run.moments.post_peak_time)
    run.remarks.push_back("the stress did not fall to 0.8 of the peak: crack patterns are shown at the end");
  if (run.summary.is_null())
    run.remarks.push_back("summary.json is not there (the run has not finished): its figures are left out");
  if (fs::exists(folder / "cracks.csv"))
    run.cracks = read_csv(folder / "cracks.csv", {"mode"});
  else
    run.remarks.push_back("cracks.csv is not there: no pictures of broken bonds");
  if (fs::exists(folder / "events.csv")) run.events = read_csv(folder / "events.csv");
  fit_anew(run);
  run.specimen = optional_series(run, "specimen.pvd", "no pictures of the specimen");
  run.bonds =
      optional_series(run, "bonds.pvd", "crack density is given per volume, not as a share of the bonds");
  run.platens = optional_series(run, "platens.pvd", "pictures are drawn without platens");
  if (fs::exists(folder / "sleeve.pvd")) // few runs have one
    run.sleeve = optional_series(run, "sleeve.pvd", "no pictures of the sleeve");
  run.contacts = optional_series(run, "contacts.pvd", "no pictures of what presses on the platens");
  return run;
}

} // namespace platen::apps::report
