#include "apps/report/head.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/report/chart.h"
#include "apps/report/fields.h"
#include "apps/report/friction.h"
#include "apps/scene/units.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Sections whose entries change nothing of the specimen and its test.
constexpr std::array aside{"Output/", "Checkpoint/", "Expect/", "Scene/Title"};

const Json &list_in(const Json &summary, const char *key) {
  static const Json none = Json::array();
  const auto found = summary.is_object() ? summary.find(key) : summary.end();
  return found != summary.end() && found->is_array() ? *found : none;
}

bool changes_the_test(const Json &overridden) {
  const std::string entry = text_in(overridden, "entry");
  return std::none_of(aside.begin(), aside.end(),
                      [&](const char *start) { return entry.rfind(start, 0) == 0; });
}

std::string counted(std::size_t count, const char *what) {
  return fmt::format("{} {}", count, count == 1 ? what : std::string(what) + "s");
}

// Of a key of summary.json, by its ending.
std::string unit_of_key(const std::string &key) {
  constexpr std::array<std::array<const char *, 2>, 6> endings{
      {{"_pa", "Pa"}, {"_kg_m3", "kg/m3"}, {"_m", "m"}, {"_n", "N"}, {"_s", "s"}, {"_deg", "degree"}}};
  for (const auto &[ending, unit] : endings) {
    const std::string end = ending;
    if (key.size() > end.size() && key.compare(key.size() - end.size(), end.size(), end) == 0) return unit;
  }
  return key.rfind("side_stress_at_peak_pa/", 0) == 0 ? "Pa" : "1";
}

// In the unit of the range, as far as that has one: "38.55 MPa".
std::string found_words(const Json &expectation, const std::string &key) {
  const Json &value = expectation.at("value");
  if (value.is_string()) return value.get<std::string>();
  if (!value.is_number()) return "-";
  const double number = value.get<double>();
  const std::string range = text_in(expectation, "range"), unit = unit_of_key(key);
  const std::size_t dots = range.find("...");
  for (std::string end : {range.substr(0, dots), range.substr(std::min(range.size(), dots + 3))}) {
    end.erase(0, end.find_first_not_of(' '));
    end.erase(end.find_last_not_of(' ') + 1);
    try {
      const NumberWithUnit limit = split_number(end);
      if (limit.unit.empty()) continue;
      return fmt::format("{:.4g} {}", number / to_si(NumberWithUnit{1, limit.unit}, unit), limit.unit);
    } catch (const ValueError &) { // no end of a range on this side
    }
  }
  return fmt::format("{:.4g}{}", number, unit == "1" ? "" : " " + unit);
}

enum class Met { no, not_checked, yes };

Met verdict_of(const Json &expectation) {
  const auto met = expectation.find("met");
  if (met == expectation.end() || !met->is_boolean()) return Met::not_checked;
  return met->get<bool>() ? Met::yes : Met::no;
}

std::size_t count_of(const std::vector<Results> &all, Met verdict) {
  std::size_t count = 0;
  for (const Results &one : all)
    for (const Json &expectation : list_in(one.summary, "expectations"))
      count += verdict_of(expectation) == verdict;
  return count;
}

void add_expectations(TableOfFigures &table, const Results &of, const std::string &name, Met verdict) {
  for (const Json &one : list_in(of.summary, "expectations")) {
    if (verdict_of(one) != verdict) continue;
    if (verdict == Met::yes && one.contains("run")) continue; // of a study: the sentence counts them
    const std::string entry = text_in(one, "entry"), key = entry.substr(entry.find('/') + 1);
    const bool measured = one.contains("value") && !one.at("value").is_null();
    const std::string run = text_in(one, "run");
    std::string words = verdict == Met::yes ? "met" : verdict == Met::no ? "not met" : "not checked";
    if (!measured && !text_in(one, "reason").empty()) words += ": " + text_in(one, "reason");
    table.rows.push_back({name + (run.empty() ? "" : run + ": ") + key, text_in(one, "range"),
                          measured ? found_words(one, key) : "-", words});
  }
}

// Of a run that is not done, or was too fast.
void add_doubts(TableOfFigures &table, const Results &of, const std::string &name) {
  if (const std::string status = text_in(of.summary, "status"); !status.empty() && status != "done")
    table.rows.push_back({name + "status", "done", status, "not whole: figures are of what ran"});
  std::vector<std::string> signs;
  for (const Json &sign : list_in(of.summary, "signs_of_haste"))
    if (sign.is_string()) signs.push_back(sign.get<std::string>());
  if (!signs.empty())
    table.rows.push_back({name + "quasi-static", "yes", "no", fmt::format("{}", fmt::join(signs, "; "))});
  for (const Json &target : list_in(of.summary, "targets_missed"))
    if (target.is_string())
      table.rows.push_back({name + "target", "-", "-", "not met: " + target.get<std::string>()});
}

// A row where any of the results tells something.
void add_row(TableOfFigures &table, const std::string &title, const std::vector<std::string> &fields) {
  if (std::all_of(fields.begin(), fields.end(), [](const std::string &one) { return one == "-"; })) return;
  table.rows.push_back({title});
  table.rows.back().insert(table.rows.back().end(), fields.begin(), fields.end());
}

std::string number_words(double value, const char *form) {
  return std::isnan(value) ? "-" : fmt::format(fmt::runtime(form), value);
}

std::string entry_of(const Results &of, const char *entry) {
  const fs::path scene = of.folder / "scene.prm";
  const std::string text = fs::is_regular_file(scene) ? scene_entry(scene, entry) : "";
  return text.empty() ? "-" : text;
}

const Json *override_of(const Results &of, const std::string &entry) {
  for (const Json &one : list_in(of.summary, "overridden"))
    if (text_in(one, "entry") == entry) return &one;
  return nullptr;
}

void add_overridden(TableOfFigures &table, const std::vector<Results> &all) {
  std::vector<std::string> entries;
  for (const Results &of : all)
    for (const Json &one : list_in(of.summary, "overridden"))
      if (std::find(entries.begin(), entries.end(), text_in(one, "entry")) == entries.end())
        entries.push_back(text_in(one, "entry"));
  for (const std::string &entry : entries) {
    std::vector<std::string> fields;
    for (const Results &of : all) {
      const Json *one = override_of(of, entry);
      const std::string was = one == nullptr ? "" : text_in(*one, "in_scene_file");
      fields.push_back(one == nullptr ? "-"
                                      : fmt::format("{}, in the scene file {}", text_in(*one, "value"),
                                                    was.empty() ? "empty" : was));
    }
    add_row(table, "overridden: " + entry, fields);
  }
}

} // namespace

Results results_in(const fs::path &folder) {
  Results results;
  const fs::path whole = fs::weakly_canonical(folder);
  results.name = whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
  results.folder = folder;
  if (fs::is_regular_file(folder / "summary.json"))
    results.summary = read_summary(folder / "summary.json").summary;
  results.mean_radius = number_in(results.summary, "mean_radius_m");
  return results;
}

Results results_of(const Run &run) {
  Results results;
  results.name = run.name, results.folder = run.folder, results.summary = run.summary;
  results.mean_radius = number_in(run.summary, "mean_radius_m");
  if (std::isnan(results.mean_radius) && !run.specimen.empty()) // of an earlier version
    results.mean_radius = mean_radius(read_spheres(run.specimen.front()));
  if (is_glued(run)) {
    results.friction = {"glued"};
    return results;
  }
  for (const Side side : sides_of(run)) {
    const FrictionLimits limits = friction_limits(run, side);
    if (std::isnan(limits.at_rest)) continue;
    std::string words = fmt::format("{} {:.4g}", coupling::name_of(side), limits.at_rest);
    if (limits.sliding != limits.at_rest) words += fmt::format(", sliding {:.4g}", limits.sliding);
    results.friction.push_back(words);
  }
  return results;
}

std::string true_title(const std::string &title, const fs::path &folder, const Json &summary) {
  const Json &overridden = list_in(summary, "overridden");
  const auto changed =
      static_cast<std::size_t>(std::count_if(overridden.begin(), overridden.end(), changes_the_test));
  const bool own = std::any_of(overridden.begin(), overridden.end(),
                               [](const Json &one) { return text_in(one, "entry") == "Scene/Title"; });
  if (changed == 0 || own) return title;
  return fmt::format("{}: {} of its scene changed", results_in(folder).name,
                     changed == 1 ? "1 entry" : fmt::format("{} entries", changed));
}

std::string verdict_in_words(const std::vector<Results> &all) {
  const std::size_t missed = count_of(all, Met::no), open = count_of(all, Met::not_checked),
                    met = count_of(all, Met::yes), count = missed + open + met;
  std::size_t targets = 0;
  for (const Results &of : all)
    targets += list_in(of.summary, "targets_missed").size();
  if (targets > 0) return fmt::format("Not as wanted: {} not met.", counted(targets, "target"));
  if (count == 0) return "";
  const std::string expected = counted(count, "figure");
  if (missed == 0 && open == 0)
    return fmt::format("As expected: {} that the scene expects, all met.", expected);
  std::string words =
      missed > 0 ? fmt::format("Not as expected: {} of {} that the scene expects not met", missed, expected)
                 : fmt::format("{} of {} that the scene expects met", met, expected);
  if (open > 0) words += fmt::format(", {} not checked", open);
  return words + ".";
}

TableOfFigures table_of_verdict(const std::vector<Results> &all) {
  TableOfFigures table{{"verdict", "expected", "found", ""}, {}};
  const auto name = [&](const Results &of) { return all.size() > 1 ? of.name + ": " : ""; };
  for (const Results &of : all)
    add_doubts(table, of, name(of));
  for (const Met verdict : {Met::no, Met::not_checked, Met::yes})
    for (const Results &of : all)
      add_expectations(table, of, name(of), verdict);
  return table;
}

TableOfFigures table_of_facts(const std::vector<Results> &all) {
  TableOfFigures table;
  table.header = {"what was tested"};
  for (const Results &of : all)
    table.header.push_back(of.name);
  const auto row = [&](const char *title, const auto &words_of) {
    std::vector<std::string> fields;
    for (const Results &of : all)
      fields.push_back(words_of(of));
    add_row(table, title, fields);
  };
  row("spheres",
      [](const Results &of) { return number_words(number_in(of.summary, "particles"), "{:.0f}"); });
  row("bonds", [](const Results &of) { return number_words(number_in(of.summary, "bonds"), "{:.0f}"); });
  row("mean radius (mm)",
      [](const Results &of) { return number_words(mm_per_m * of.mean_radius, "{:.4g}"); });
  row("seed", [](const Results &of) { return entry_of(of, "Scene/Seed"); });
  row("friction of the platens", [](const Results &of) {
    return of.friction.empty() ? "-" : fmt::format("{}", fmt::join(of.friction, "; "));
  });
  row("title of the scene file", [](const Results &of) {
    const Json *one = override_of(of, "Scene/Title");
    return one != nullptr ? text_in(*one, "in_scene_file") : entry_of(of, "Scene/Title");
  });
  row("scene file", [](const Results &of) {
    const std::string file = text_in(of.summary, "scene_file");
    return file.empty() ? std::string("-") : file;
  });
  add_overridden(table, all);
  return table;
}

void add_head(const fs::path &folder, Album &album) {
  if (!folder.empty()) add_head(std::vector<Results>{results_in(folder)}, album);
}

void add_head(const std::vector<Results> &all, Album &album) {
  album.lead(verdict_in_words(all), table_of_verdict(all));
  album.lead("", table_of_facts(all));
}

} // namespace platen::apps::report
