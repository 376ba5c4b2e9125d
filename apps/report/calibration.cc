#include "apps/report/calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "apps/report/bars.h"
#include "apps/report/chart.h"
#include "apps/report/csv.h"
#include "apps/report/head.h"
#include "apps/report/platen_study.h"
#include "apps/report/report.h"
#include "apps/report/run_folder.h"
#include "apps/scene/errors.h"
#include "apps/scene/regular_file.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

Json summary_of(const fs::path &folder) {
  std::ifstream stream = open_file(folder / "summary.json");
  return Json::parse(stream, nullptr, false);
}

// curve.csv, curve_2.csv, ...
std::vector<fs::path> curves_of(const fs::path &folder) {
  std::vector<fs::path> files;
  for (int k = 1;; ++k) {
    const fs::path file = folder / (k == 1 ? "curve.csv" : fmt::format("curve_{}.csv", k));
    if (!fs::exists(file)) return files;
    files.push_back(file);
  }
}

bool is_curve(const Json &target) {
  return text_in(target, "kind") == "curve";
}

// "0.981 +- 0.02", "0.96 ... 1.01, 3 packings"; in multiples of a unit.
std::string scatter_words(const Json &statistics, double unit, int digits) {
  const Spread spread = over_seeds(statistics, unit);
  const std::string mean = fmt::format("{:.{}g}", spread.mean, digits);
  if (spread.packings == 0) return mean;
  if (static_cast<std::size_t>(spread.packings) >= fewest_for_deviation)
    return mean + fmt::format(" +- {:.2g}", spread.high - spread.mean);
  if (spread.packings == 1) return mean + ", 1 packing";
  return (spread.high > spread.low
              ? fmt::format("{:.{}g} ... {:.{}g}", spread.low, digits, spread.high, digits)
              : mean) +
         fmt::format(", {} packings", spread.packings);
}

// Of a curve what decides whether it is met: how far the mean of the packings is off, root mean square over
// its largest stress.
std::string text_of(const Json &target, const char *key) {
  if (!target.contains(key) || !target.at(key).at("mean").is_number()) return "-";
  if (const double miss = number_in(target, std::string(key) + "_miss");
      is_curve(target) && !std::isnan(miss))
    return fmt::format("off by {:.4g} %", 100 * miss);
  return scatter_words(target.at(key), 1, 4);
}

std::string tolerance_of(const Json &target) {
  const double tolerance = number_in(target, "tolerance");
  return std::isnan(tolerance) ? "-" : fmt::format("{:.3g} %", 100 * tolerance);
}

TableOfFigures table_of_targets(const Json &summary) {
  TableOfFigures table{
      {"target (SI)", "wanted", "calibrated on", "unseen packings", "tolerance", "within its tolerance"}, {}};
  for (const Json &target : summary.at("targets"))
    table.rows.push_back(
        {target.at("key").get<std::string>(),
         is_curve(target) ? "the curve" : fmt::format("{:.4g}", target.at("wanted").get<double>()),
         text_of(target, "training"), text_of(target, "verification"), tolerance_of(target),
         target.value("met", target.value("met_in_training", false)) ? "yes" : "no"});
  return table;
}

std::string title_of(const fs::path &folder) {
  const Json summary = summary_of(folder);
  return true_title(summary.value("scene", folder.filename().string()), folder, summary);
}

bool has_targets(const Json &summary) {
  const auto found = [](const Json &target, const char *key) {
    return target.contains(key) && target.at(key).is_object() && target.at(key).contains("mean") &&
           target.at(key).at("mean").is_number();
  };
  if (!summary.contains("targets") || !summary.at("targets").is_array()) return false;
  return std::any_of(summary.at("targets").begin(), summary.at("targets").end(), [&](const Json &target) {
    return target.is_object() && (found(target, "training") || found(target, "verification"));
  });
}

} // namespace

bool holds_calibration(const fs::path &folder) {
  const Json summary = summary_of(folder);
  return summary.is_object() && text_in(summary, "app") == "platen-calibrate";
}

void draw_calibrated_curve(const fs::path &csv, const fs::path &png) {
  const CsvTable table = read_csv(csv);
  const bool gauge = table.has("strain_gauge");
  const std::vector<double> strain = scaled(table.column(gauge ? "strain_gauge" : "strain_platen"), 1e3);
  const auto curve = [&](const char *label, const char *column, Colour colour, Stroke stroke) {
    Curve one{label, {0}, {0}, colour, stroke}; // all begin at rest
    one.x.insert(one.x.end(), strain.begin(), strain.end());
    const std::vector<double> stress = scaled(table.column(column), 1 / pa_per_mpa);
    one.y.insert(one.y.end(), stress.begin(), stress.end());
    return one;
  };
  Chart chart;
  chart.x_title = gauge ? "Axial strain of the gauge (mm/m)" : "Axial strain between platens (mm/m)";
  chart.y_title = "Axial stress (MPa)";
  chart.curves = {curve("calibrated on", "calibrated_pa", colours::blue, Stroke::solid),
                  curve("unseen packings", "unseen_pa", colours::vermilion, Stroke::solid),
                  curve("wanted", "wanted_pa", colours::black, Stroke::dashed)};
  save_charts("Wanted and found", "Mean of the packings beside the curve that was wanted", {chart}, {900},
              png);
}

void draw_targets(const fs::path &folder, const fs::path &png) {
  std::vector<Bar> bars;
  const Json summary = summary_of(folder);
  for (const Json &target : summary.at("targets")) {
    const double wanted = target.at("wanted");
    for (const bool unseen : {false, true}) {
      const char *key = unseen ? "verification" : "training";
      if (!target.contains(key) || !target.at(key).at("mean").is_number() || wanted == 0) continue;
      const Json &of = target.at(key);
      const double ratio = of.at("mean").get<double>() / wanted;
      bars.push_back({target.at("key").get<std::string>() + (unseen ? ", unseen" : ""),
                      scatter_words(of, wanted, 3), std::max(ratio, 0.0),
                      unseen ? colours::vermilion : colours::blue});
    }
  }
  save_bars(title_of(folder), "Found over wanted; blue: packings calibrated on, red: unseen; line: as wanted",
            bars, 1, png);
}

void write_calibration_report(const fs::path &folder, const fs::path &pictures, std::ostream &out) {
  const Json summary = summary_of(folder);
  Album album(pictures);
  add_head(folder, album);
  std::vector<std::string> remarks;
  album.begin("Targets");
  if (has_targets(summary))
    album.add("targets.png",
              "Each target as it was found over what was wanted, mean of the packings: those that "
              "were calibrated on, and unseen ones.",
              draw_targets, folder);
  else
    remarks.emplace_back("summary.json tells no target that was found: there is no picture of them");
  album.begin("Curves");
  for (const fs::path &csv : curves_of(folder))
    album.add(
        csv.stem().string() + ".png",
        "Dashed: the curve that was wanted. Blue: mean of the packings that were calibrated on; red: of "
        "packings that were not.",
        draw_calibrated_curve, csv);
  try {
    for (const Json &line : summary.at("missed"))
      remarks.push_back("not met together: " + line.get<std::string>());
    for (const std::string &remark : remarks)
      out << remark << '\n';
    album.finish(title_of(folder), table_of_targets(summary), remarks, out);
  } catch (const Json::exception &error) {
    throw InputError((folder / "summary.json").string() + ": " + error.what());
  }
}

} // namespace platen::apps::report
