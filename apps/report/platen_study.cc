#include "apps/report/platen_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>

#include "apps/report/chart.h"
#include "apps/report/envelope.h"
#include "apps/report/head.h"
#include "apps/report/run_folder.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;
constexpr const char *effects[] = {"gain over free ends", "strength over that at slenderness 2",
                                   "cube over prism"};

StudiedCase case_of(const Json &from) {
  StudiedCase one;
  one.name = from.at("name");
  one.surface = from.at("surface");
  one.friction = number_or_nan(from.at("friction_static"));
  one.slenderness = number_or_nan(from.at("slenderness"));
  one.sphere_radius = number_or_nan(from.at("sphere_radius_m"));
  one.pressure = number_or_nan(from.at("confining_pressure_pa"));
  one.strength = over_seeds(from.at("strength_pa"), pa_per_mpa);
  one.without_peak = from.at("without_peak");
  one.runs = from.at("strength_pa").at("runs");
  one.plain = one.surface != "brush" && one.surface != "rubber sheet" && !std::isnan(one.friction);
  return one;
}

std::string laboratory_words(const Json &from) {
  if (from.is_null()) return "-";
  const double mean = number_or_nan(from.at("mean")), low = number_or_nan(from.at("low")),
               high = number_or_nan(from.at("high"));
  return fmt::format("{:.2f}", mean) + (low < high ? fmt::format(" ({:.2f} to {:.2f})", low, high) : "");
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

// Ratios outside what laboratories measured, and those that the bonds are not calibrated for: the first
// remarks.
void add_verdicts(const Json &comparisons, StudyResults &results) {
  for (std::size_t k = 0; k < results.ratios.size(); ++k) {
    const StudiedRatio &ratio = results.ratios[k];
    const StudiedCase &of = results.cases[ratio.of];
    const std::string what =
        fmt::format("{}, {}, height/width {:.3g}", ratio.effect, of.surface, of.slenderness);
    if (ratio.outside)
      results.remarks.push_back(fmt::format("outside the laboratory's range: {}: {}, laboratory {}, {}", what,
                                            words(ratio.ratio, 3), ratio.laboratory,
                                            comparisons[k].at("laboratory").at("source").get<std::string>()));
    if (!ratio.reason.empty()) results.remarks.push_back(what + ": none: " + ratio.reason);
  }
}

StudyResults results_of(const Json &study, const fs::path &folder) {
  StudyResults results;
  results.title = title_of_study(folder);
  results.folder = folder;
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
                              over_seeds(one, 1), laboratory_words(one.at("laboratory")),
                              one.value("verdict", "") == "outside", one.value("reason", "")});
  add_verdicts(study.at("comparisons"), results);
  for (const Json &one : study.at("laboratory"))
    results.laboratory.push_back(
        {one.at("effect"),
         one.at("source"),
         one.at("platens") == "free ends",
         number_or_nan(one.at("slenderness")),
         {number_or_nan(one.at("mean")), number_or_nan(one.at("low")), number_or_nan(one.at("high"))}});
  for (const StudiedCase &one : results.cases)
    if (one.without_peak > 0)
      results.remarks.push_back(
          fmt::format("{}, height/width {:.3g}: {} of {} runs bore ever more up to the target strain: no "
                      "strength is drawn",
                      one.surface, one.slenderness, one.without_peak, one.runs));
  for (const StudiedCase &one : results.cases) {
    if (!std::isnan(one.strength.mean) && one.without_peak == 0) continue;
    if (const std::string reasons = reasons_in_runs(folder, one.name, "strength_pa"); !reasons.empty())
      results.remarks.push_back(one.name + ": strength, " + reasons);
    else if (std::isnan(one.strength.mean) && one.without_peak == 0)
      results.remarks.push_back(one.name + ": no run has a strength; a gap in the picture");
  }
  for (const std::string &line : sources_in(study.at("comparisons")))
    results.remarks.push_back(line);
  add_failed_runs(study, results.remarks);
  return results;
}

// Cases that differ in platens and slenderness alone, by sphere radius and pressure.
std::map<std::pair<double, double>, std::vector<std::size_t>> groups_of(const StudyResults &study) {
  std::map<std::pair<double, double>, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < study.cases.size(); ++k)
    groups[{study.cases[k].sphere_radius, study.cases[k].pressure}].push_back(k);
  return groups;
}

} // namespace

Spread over_seeds(const Json &statistics, double unit) {
  const double mean = number_or_nan(statistics.at("mean")) / unit,
               deviation = number_or_nan(statistics.at("deviation")) / unit;
  const int packings = statistics.value(statistics.contains("seeds") ? "seeds" : "runs", 0);
  const bool few = static_cast<std::size_t>(packings) < fewest_for_deviation;
  double low = mean - deviation, high = mean + deviation;
  if (few && statistics.contains("low")) {
    low = number_or_nan(statistics.at("low")) / unit, high = number_or_nan(statistics.at("high")) / unit;
  } else if (few) { // of an earlier version: two packings lie to both sides of their mean, of more nobody
                    // knows
    const double half = packings == 2 ? deviation / std::sqrt(2.0) : 0;
    low = mean - half, high = mean + half;
  }
  return {mean, std::isnan(low) ? mean : low, std::isnan(high) ? mean : high, packings};
}

Spread spread_of(const SeedStatistics &s) {
  const bool few = s.count() < fewest_for_deviation;
  const double mean = s.mean();
  return {mean, few ? s.least() : mean - s.deviation(), few ? s.largest() : mean + s.deviation(),
          static_cast<int>(s.count())};
}

std::string words(const Spread &s, int digits) {
  if (std::isnan(s.mean)) return "-";
  const std::string mean = fmt::format("{:.{}f}", s.mean, digits);
  if (s.packings == 0) return mean;
  if (static_cast<std::size_t>(s.packings) >= fewest_for_deviation)
    return mean + fmt::format(" +- {:.{}f}", s.high - s.mean, digits);
  if (s.packings == 1) return mean + ", 1 packing";
  const std::string range =
      s.high > s.low ? fmt::format("{:.{}f} ... {:.{}f}", s.low, digits, s.high, digits) : mean;
  return range + fmt::format(", {} packings", s.packings);
}

std::string words_of_scatter(int packings) {
  if (packings <= 1) return "; one packing: no scatter known";
  if (static_cast<std::size_t>(packings) < fewest_for_deviation) return "; bars: range of the packings";
  return "; bars: standard deviation over the packings, of fewer than five their range";
}

// Folders of runs are named by case and seed.
std::string reasons_in_runs(const fs::path &folder, const std::string &name, const std::string &figure) {
  std::map<std::string, int> reasons;
  int runs = 0;
  std::error_code none;
  const std::string start = name + "_seed_";
  for (const auto &entry : fs::directory_iterator(folder / "runs", none)) {
    if (entry.path().filename().string().rfind(start, 0) != 0) continue;
    std::ifstream stream = open_file(entry.path() / "summary.json");
    const Json summary = Json::parse(stream, nullptr, false);
    if (!summary.is_object()) continue;
    ++runs;
    const auto validity = summary.find("validity");
    if (validity == summary.end() || !validity->is_object()) continue;
    const auto verdict = validity->find(figure);
    if (verdict == validity->end() || !verdict->is_array()) continue;
    for (const Json &reason : *verdict)
      if (reason.is_string()) ++reasons[reason.get<std::string>()];
  }
  std::string text;
  for (const auto &[reason, count] : reasons)
    text += fmt::format("{}{} of {} runs: {}", text.empty() ? "" : "; ", count, runs, reason);
  return text;
}

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
  std::ifstream stream = open_file(folder / "summary.json");
  const Json summary = Json::parse(stream, nullptr, false);
  if (summary.is_object())
    return true_title(summary.value("scene", folder.filename().string()), folder, summary);
  return folder.filename().string();
}

Json finished_study(const fs::path &folder) {
  const fs::path file = folder / "study.json";
  std::ifstream stream = open_file(file);
  Json study = Json::parse(stream, nullptr, false);
  if (!study.is_object()) throw InputError(file.string() + ": cannot be read as JSON");
  const std::string status = study.value("status", "");
  if (status == "running" || status == "planned")
    throw InputError(file.string() + ": the study has not ended; go on with it by platen-study " +
                     study.value("kind", "") +
                     (status == "planned" ? " --run, then --collect" : " --resume"));
  return study;
}

void add_failed_runs(const Json &study, std::vector<std::string> &remarks) {
  if (const int failed = study.at("failed_runs"), runs = study.at("runs"); failed > 0)
    remarks.push_back(fmt::format("{} of {} runs failed and count in no mean", failed, runs));
  if (const int missing = study.value("missing_runs", 0); missing > 0)
    remarks.push_back(fmt::format("{} of {} runs were missing when the tables were made and count in no mean",
                                  missing, study.at("runs").get<int>()));
}

double number_or_nan(const Json &value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

StudyResults read_study(const fs::path &folder) {
  const fs::path file = folder / "study.json";
  const Json study = finished_study(folder);
  const std::string kind = study.value("kind", "");
  if (kind != "friction" && kind != "slenderness")
    throw InputError(file.string() + ": is of a study of " + (kind.empty() ? "nothing" : kind) +
                     "; pictures are drawn of studies of friction, slenderness, size, packing, rate, "
                     "accuracy and target, and of single runs (" +
                     (folder / "runs").string() + ")");
  try {
    return results_of(study, folder);
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
    std::vector<std::string> row{one.surface, fmt::format("{:.3g}", one.slenderness)};
    if (radii) row.push_back(fmt::format("{:.3g}", 1e3 * one.sphere_radius));
    if (pressures) row.push_back(fmt::format("{:.3g}", one.pressure / pa_per_mpa));
    row.push_back(std::to_string(one.runs));
    row.push_back((one.without_peak > 0 ? "> " : "") + words(one.strength, 1));
    for (const char *effect : effects) {
      const StudiedRatio *ratio = study.ratio_of(k, effect);
      row.push_back(ratio == nullptr ? "-" : words(ratio->ratio, 3));
      row.push_back(ratio == nullptr ? "-" : ratio->laboratory + (ratio->outside ? ": outside" : ""));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_study_report(const StudyResults &study, const fs::path &folder, std::ostream &out) {
  Album album(folder);
  add_head(study.folder, album);
  album.begin("");
  const auto groups = groups_of(study);
  for (const auto &[group, cases] : groups) {
    std::set<double> frictions, slendernesses;
    for (const std::size_t k : cases) {
      if (study.cases[k].plain) frictions.insert(study.cases[k].friction);
      slendernesses.insert(study.cases[k].slenderness);
    }
    const std::string number = album.size() == 0 ? "" : fmt::format("_{}", album.size()),
                      which = groups.size() == 1
                                  ? ""
                                  : fmt::format(" Spheres of {:.3g} mm, cell pressure {:.3g} MPa.",
                                                1e3 * group.first, 1e-6 * group.second);
    if (frictions.size() > 1)
      album.add("strength_friction" + number + ".png",
                "Strength against the friction of the platens, and its gain over free ends; bars: "
                "scatter of the packings, range of the laboratory." +
                    which,
                draw_friction, study, cases);
    if (slendernesses.size() > 1)
      album.add("strength_slenderness" + number + ".png",
                "Strength against height over width, and its ratio to that at 2; bars: scatter of the "
                "packings, range of the laboratory." +
                    which,
                draw_slenderness, study, cases);
  }
  std::vector<std::string> remarks = study.remarks;
  std::size_t count = 0;
  for (const Envelope &envelope : envelopes_of(study, study.folder, remarks)) {
    if (count == 0) album.begin("Failure under pressure");
    album.add_table(table_of(envelope));
    album.add_table(table_of_lines(envelope));
    album.add(count == 0 ? "failure_envelope.png" : fmt::format("failure_envelope_{}.png", count),
              envelope.label +
                  ": above, strength over the pressure on the sides, the line fitted to each packing "
                  "(their mean), and what EN 1998-3 and Richart give for the same unconfined "
                  "strength; below, Mohr's circles and the tangent of that line.",
              draw_envelope, study, envelope);
    ++count;
  }
  if (album.size() == 0) remarks.push_back("one friction and one slenderness: there is no curve to draw");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(study.title, table_of_study(study), remarks, out);
}

} // namespace platen::apps::report
