#include "apps/report/target_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "apps/report/bars.h"
#include "apps/report/chart.h"
#include "apps/report/head.h"
#include "apps/report/platen_study.h"
#include "apps/report/run_folder.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

constexpr std::pair<const char *, const char *> parts[] = {{"packing", "packings"},
                                                           {"chaos", "chaos of crushing"},
                                                           {"speed", "law of speed"},
                                                           {"step", "time step"}};

struct Unit {
  const char *word;
  double size;
};

// Of a figure in SI.
Unit unit_of(const Json &target) {
  const std::string figure = target.at("figure");
  if (figure.rfind("gain", 0) == 0) return {"", 1};
  return figure == "strength" ? Unit{"MPa", 1e6} : Unit{"GPa", 1e9};
}

TargetLook look_of(const Json &from, double seconds, const Unit &unit) {
  TargetLook look;
  look.runs = from.at("runs");
  look.seconds = seconds;
  look.mean = from.at("mean").get<double>() / unit.size;
  look.half = from.at("half_interval");
  for (const auto &[key, name] : parts)
    look.parts.push_back(number_or_nan(from.at("parts").at(key)));
  return look;
}

std::string figure_words(const TargetResults &study, const TargetLook &look) {
  return fmt::format("{:.4g}{}{} +- {:.2g} %", look.mean, study.unit.empty() ? "" : " ", study.unit,
                     100 * look.half);
}

void add_remarks(TargetResults &results, const Json &target, const Json &costs) {
  if (results.looks.empty()) {
    results.remarks.emplace_back("too few runs gave the figure: there is no interval");
    return;
  }
  const TargetLook &last = results.looks.back();
  results.remarks.push_back(
      fmt::format("{} of slow loading: {} with {:g} % confidence; {:.2g} % were ordered: {}", results.figure,
                  figure_words(results, last), 100 * results.confidence, 100 * results.accuracy,
                  target.at("verdict").get<std::string>()));
  const Json &slow = target.at("one_slow_speed");
  const double seconds = number_or_nan(costs.value("one_slow_speed_core_seconds", Json()));
  if (seconds > 0)
    results.remarks.push_back(fmt::format(
        "{:.0f} s of one core; one slow speed would have taken {:.0f} s ({:.0f} wave crossings, {} packings)",
        last.seconds, seconds, number_or_nan(slow.at("wave_crossings")), slow.at("packings").get<int>()));
  const double change = number_or_nan(target.at("sphere_size").at("change"));
  results.remarks.push_back(fmt::format(
      "spheres 1.25 times as large change it by {:+.2g} %: beyond that more accuracy is wasted on one "
      "sphere size",
      100 * change));
}

Chart chart_of(const TargetResults &study) {
  Chart chart =
      chart_with_axes("Seconds of one core",
                      study.unit.empty() ? study.figure : fmt::format("{} ({})", study.figure, study.unit));
  Curve means{"estimate and interval", {}, {}, colours::blue};
  double low = study.looks.front().mean, high = low;
  const double last = study.looks.back().seconds;
  for (const TargetLook &look : study.looks) {
    means.x.push_back(look.seconds), means.y.push_back(look.mean);
    const double bottom = look.mean * std::exp(-look.half), top = look.mean * std::exp(look.half);
    add_bar(chart, look.seconds, bottom, top, 0.01 * last, colours::blue);
    chart.marks.push_back({look.seconds, look.mean, "", colours::blue});
    low = std::min(low, bottom), high = std::max(high, top);
  }
  chart.curves.push_back(std::move(means));
  const double mean = study.looks.back().mean;
  for (const double edge : {-study.accuracy, study.accuracy})
    chart.curves.push_back({edge < 0 ? "as accurate as was ordered" : "",
                            {0, 1.05 * last},
                            {mean * (1 + edge), mean * (1 + edge)},
                            colours::black,
                            Stroke::dashed,
                            2});
  low = std::min(low, mean * (1 - study.accuracy)), high = std::max(high, mean * (1 + study.accuracy));
  chart.x_range = {0, 1.05 * last};
  chart.y_range = snug_range(low, high);
  return chart;
}

std::vector<Bar> bars_of(const TargetResults &study) {
  const TargetLook &last = study.looks.back();
  std::vector<Bar> bars;
  for (std::size_t k = 0; k < study.part_names.size(); ++k)
    bars.push_back({study.part_names[k], fmt::format("{:.2g} %", 100 * last.parts[k]), 100 * last.parts[k]});
  bars.push_back(
      {"all, in squares", fmt::format("{:.2g} %", 100 * last.half), 100 * last.half, colours::black});
  return bars;
}

} // namespace

TargetResults read_target(const std::filesystem::path &folder) {
  const std::filesystem::path file = folder / "study.json";
  const Json study = finished_study(folder);
  TargetResults results;
  results.title = title_of_study(folder);
  results.folder = folder;
  try {
    const Json &target = study.at("target"), &costs = study.at("costs");
    const Unit unit = unit_of(target);
    results.figure = target.at("figure"), results.unit = unit.word;
    results.accuracy = target.at("accuracy"), results.confidence = target.at("confidence");
    for (const auto &[key, name] : parts)
      results.part_names.emplace_back(name);
    const Json looks = target.value("looks", Json::array());
    for (std::size_t k = 0; k < looks.size(); ++k)
      results.looks.push_back(look_of(looks[k], number_or_nan(costs.at("looks_core_seconds").at(k)), unit));
    add_remarks(results, target, costs);
    add_failed_runs(study, results.remarks);
  } catch (const Json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  }
  return results;
}

TableOfFigures table_of_target(const TargetResults &study) {
  TableOfFigures table;
  table.header = {"", "seconds", study.unit.empty() ? study.figure : study.figure + " (" + study.unit + ")",
                  "interval, +- %"};
  for (const std::string &name : study.part_names)
    table.header.push_back(name + " (%)");
  for (const TargetLook &look : study.looks) {
    std::vector<std::string> row{fmt::format("{} runs", look.runs), fmt::format("{:.0f}", look.seconds),
                                 fmt::format("{:.4g}", look.mean), fmt::format("{:.2g}", 100 * look.half)};
    for (const double part : look.parts)
      row.push_back(fmt::format("{:.2g}", 100 * part));
    table.rows.push_back(std::move(row));
  }
  return table;
}

void write_target_report(const TargetResults &study, const std::filesystem::path &folder, std::ostream &out) {
  Album album(folder);
  add_head(study.folder, album);
  album.begin("");
  if (!study.looks.empty()) {
    album.add(
        "target.png",
        "The figure of slow loading and its interval after each batch of runs; dashed: as accurate as was "
        "ordered.",
        save_charts, study.title, "What the runs tell, against what they cost",
        std::vector<Chart>{chart_of(study)}, std::vector<int>{700});
    album.add("target_parts.png",
              "Parts of half the interval at the end, which add up in squares; the line is what was ordered.",
              save_bars, study.title, "What is not known, in % of the figure", bars_of(study),
              100 * study.accuracy);
  }
  for (const std::string &remark : study.remarks)
    out << remark << '\n';
  album.finish(study.title, table_of_target(study), study.remarks, out);
}

} // namespace platen::apps::report
