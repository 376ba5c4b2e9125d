#include "apps/report/study_results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double pa_per_mpa = 1e6;
constexpr const char *effects[] = {"gain over free ends", "strength over that at slenderness 2",
                                   "cube over prism"};

double number(const Json &value) {
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Spread over_seeds(const Json &statistics, double unit) {
  const double mean = number(statistics.at("mean")) / unit,
               deviation = number(statistics.at("deviation")) / unit,
               half = std::isnan(deviation) ? 0 : deviation;
  return {mean, mean - half, mean + half};
}

std::string words(const char *format, double a, double b = 0, double c = 0) {
  char text[96];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

std::string words(const Spread &s, const char *one, const char *scattered) {
  if (std::isnan(s.mean)) return "-";
  return s.high > s.low ? words(scattered, s.mean, s.high - s.mean) : words(one, s.mean);
}

StudiedCase case_of(const Json &from) {
  StudiedCase one;
  one.name = from.at("name");
  one.surface = from.at("surface");
  one.friction = number(from.at("friction_static"));
  one.slenderness = number(from.at("slenderness"));
  one.sphere_radius = number(from.at("sphere_radius_m"));
  one.pressure = number(from.at("confining_pressure_pa"));
  one.strength = over_seeds(from.at("strength_pa"), pa_per_mpa);
  one.without_peak = from.at("without_peak");
  one.runs = from.at("strength_pa").at("runs");
  one.plain = one.surface != "brush" && one.surface != "rubber sheet" && !std::isnan(one.friction);
  return one;
}

std::string laboratory_words(const Json &from) {
  if (from.is_null()) return "-";
  const double low = number(from.at("low")), high = number(from.at("high"));
  return low < high ? words("%.2f (%.2f to %.2f)", number(from.at("mean")), low, high)
                    : words("%.2f", number(from.at("mean")));
}

// Whose figures stand in the table, a line each.
std::vector<std::string> sources_in(const Json &comparisons) {
  std::vector<std::string> lines;
  for (const Json &one : comparisons) {
    const Json &figure = one.at("laboratory");
    if (figure.is_null()) continue;
    const std::string line = "laboratory, " + one.at("effect").get<std::string>() + ", " +
                             figure.at("platens").get<std::string>() + ": " +
                             figure.at("source").get<std::string>();
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  return lines;
}

StudyResults results_of(const Json &study, const std::string &title) {
  StudyResults results;
  results.title = title;
  results.kind = study.at("kind");
  for (const Json &one : study.at("cases"))
    results.cases.push_back(case_of(one));
  const auto place = [&](const std::string &name) {
    const auto found = std::find_if(results.cases.begin(), results.cases.end(),
                                    [&](const StudiedCase &one) { return one.name == name; });
    if (found == results.cases.end()) throw std::out_of_range("no case " + name);
    return static_cast<std::size_t>(found - results.cases.begin());
  };
  for (const Json &one : study.at("comparisons"))
    results.ratios.push_back({one.at("effect"), place(one.at("case")), place(one.at("over")),
                              over_seeds(one, 1), laboratory_words(one.at("laboratory"))});
  for (const Json &one : study.at("laboratory"))
    results.laboratory.push_back({one.at("effect"),
                                  one.at("source"),
                                  one.at("platens") == "free ends",
                                  number(one.at("slenderness")),
                                  {number(one.at("mean")), number(one.at("low")), number(one.at("high"))}});
  for (const StudiedCase &one : results.cases)
    if (one.without_peak > 0)
      results.remarks.push_back(
          one.surface + words(", height/width %.3g: ", one.slenderness) +
          words("%.0f of %.0f runs bore ever more up to the target strain: no strength is drawn",
                one.without_peak, one.runs));
  for (const std::string &line : sources_in(study.at("comparisons")))
    results.remarks.push_back(line);
  const int failed = study.at("failed_runs"), runs = study.at("runs");
  if (failed > 0)
    results.remarks.push_back(std::to_string(failed) + " of " + std::to_string(runs) +
                              " runs failed and count in no mean");
  return results;
}

} // namespace

const StudiedRatio *StudyResults::ratio_of(std::size_t of, const std::string &effect) const {
  const auto found = std::find_if(ratios.begin(), ratios.end(), [&](const StudiedRatio &one) {
    return one.of == of && one.effect == effect;
  });
  return found == ratios.end() ? nullptr : &*found;
}

bool holds_study(const fs::path &folder) {
  return fs::exists(folder / "study.json");
}

std::string title_of_study(const fs::path &folder) {
  std::ifstream stream(folder / "summary.json");
  const Json summary = Json::parse(stream, nullptr, false);
  if (summary.is_object()) return summary.value("scene", folder.filename().string());
  return folder.filename().string();
}

Json finished_study(const fs::path &folder) {
  const fs::path file = folder / "study.json";
  std::ifstream stream(file);
  Json study = Json::parse(stream, nullptr, false);
  if (!study.is_object()) throw InputError(file.string() + ": cannot be read as JSON");
  if (study.value("status", "") == "running")
    throw InputError(file.string() + ": the study has not ended; go on with it by platen-study " +
                     study.value("kind", "") + " --resume");
  return study;
}

StudyResults read_study(const fs::path &folder) {
  const fs::path file = folder / "study.json";
  const Json study = finished_study(folder);
  const std::string kind = study.value("kind", "");
  if (kind != "friction" && kind != "slenderness")
    throw InputError(file.string() + ": is of a study of " + (kind.empty() ? "nothing" : kind) +
                     "; pictures are drawn of studies of friction, slenderness and accuracy, and of single "
                     "runs (" +
                     (folder / "runs").string() + ")");
  try {
    return results_of(study, title_of_study(folder));
  } catch (const Json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  } catch (const std::out_of_range &error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

TableOfFigures table_of_study(const StudyResults &study) {
  TableOfFigures table;
  const auto varies = [&](double StudiedCase::*of) {
    return std::any_of(study.cases.begin(), study.cases.end(),
                       [&](const StudiedCase &one) { return one.*of != study.cases.front().*of; });
  };
  const bool radii = varies(&StudiedCase::sphere_radius), pressures = varies(&StudiedCase::pressure);
  table.header = {"platens", "height/width"};
  if (radii) table.header.emplace_back("sphere (mm)");
  if (pressures) table.header.emplace_back("cell (MPa)");
  table.header.insert(table.header.end(), {"runs", "strength (MPa)"});
  for (const char *effect : effects)
    table.header.insert(table.header.end(), {effect, "laboratory"});
  for (std::size_t k = 0; k < study.cases.size(); ++k) {
    const StudiedCase &one = study.cases[k];
    std::vector<std::string> row{one.surface, words("%.3g", one.slenderness)};
    if (radii) row.push_back(words("%.3g", 1e3 * one.sphere_radius));
    if (pressures) row.push_back(words("%.3g", one.pressure / pa_per_mpa));
    row.push_back(std::to_string(one.runs));
    row.push_back((one.without_peak > 0 ? "> " : "") + words(one.strength, "%.1f", "%.1f +- %.1f"));
    for (const char *effect : effects) {
      const StudiedRatio *ratio = study.ratio_of(k, effect);
      row.push_back(ratio == nullptr ? "-" : words(ratio->ratio, "%.3f", "%.3f +- %.3f"));
      row.push_back(ratio == nullptr ? "-" : ratio->laboratory);
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

} // namespace platen::apps::report
