#include "apps/report/accuracy_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "apps/output/seed_statistics.h"
#include "apps/report/chart.h"
#include "apps/report/head.h"
#include "apps/report/platen_study.h"
#include "apps/report/run_folder.h"
#include "apps/scene/errors.h"
#include "apps/scene/units.h"

namespace platen::apps::report {
namespace {

struct MeasureWords {
  const char *key, *title;
};
constexpr std::array<MeasureWords, accuracy_measures> measures{{{"strength", "strength"},
                                                                {"strain_at_peak", "strain at the peak"},
                                                                {"modulus", "Young's modulus"},
                                                                {"broken_bonds", "broken bonds"}}};

AccuracyParameter parameter_of(const Json &from) {
  AccuracyParameter parameter;
  parameter.name = from.at("knob");
  parameter.unit = from.at("unit");
  parameter.ordered = from.at("ordered");
  for (std::size_t m = 0; m < accuracy_measures; ++m)
    parameter.scatter[m] = number_or_nan(from.at("scatter_of_seeds").at(measures[m].key));
  for (const Json &one : from.at("values")) {
    AccuracyValue value;
    value.text = one.at("value");
    value.number = number_or_nan(one.value("number", Json()));
    for (std::size_t m = 0; m < accuracy_measures; ++m) {
      const Json &error = one.at("errors").at(measures[m].key);
      value.errors[m] = {over_seeds(error, 1), number_or_nan(error.at("root_mean_square")), error.at("runs")};
    }
    value.seconds = std::nan("");
    parameter.values.push_back(value);
  }
  return parameter;
}

void add_seconds(AccuracyResults &results, const Json &wall_seconds) {
  for (const Json &one : wall_seconds)
    for (AccuracyParameter &parameter : results.parameters)
      for (AccuracyValue &value : parameter.values)
        if (one.at("knob") == parameter.name && one.at("value") == value.text)
          value.seconds = number_or_nan(one.at("mean"));
}

// "safety, strength: 5 % costs 3.1 s (0.9); 1 %, 0.1 % not reached", a line for each parameter and measure.
void add_prices(AccuracyResults &results, const Json &prices) {
  struct Price {
    std::string of;
    std::vector<std::string> reached, missed;
  };
  std::vector<Price> all;
  for (const Json &one : prices) {
    const std::string key = one.at("of");
    std::string of = one.at("knob").get<std::string>() + ", ";
    const auto measure =
        std::find_if(measures.begin(), measures.end(), [&](const MeasureWords &m) { return m.key == key; });
    of += measure == measures.end() ? key : measure->title;
    if (all.empty() || all.back().of != of) all.push_back({of, {}, {}});
    const std::string bound = fmt::format("{:g} %", 100 * number_or_nan(one.at("within")));
    if (one.at("value").is_null())
      all.back().missed.push_back(bound);
    else
      all.back().reached.push_back(fmt::format("{} costs {:.3g} s ({})", bound,
                                               number_or_nan(one.at("seconds")),
                                               one.at("value").get<std::string>()));
  }
  for (const Price &price : all)
    results.remarks.push_back(fmt::format("{}: {}{}{}{}", price.of, fmt::join(price.reached, ", "),
                                          price.reached.empty() || price.missed.empty() ? "" : "; ",
                                          fmt::join(price.missed, ", "),
                                          price.missed.empty() ? "" : " not reached"));
}

std::string error_words(const ErrorOverSeeds &error) {
  const Spread &s = error.error;
  if (error.runs == 0 || std::isnan(s.mean)) return "-";
  const std::string mean = fmt::format("{:+.2g}", 100 * s.mean);
  if (static_cast<std::size_t>(error.runs) >= fewest_for_deviation)
    return mean + fmt::format(" +- {:.2g}", 100 * (s.high - s.mean));
  return s.high > s.low ? fmt::format("{:+.2g} ... {:+.2g}", 100 * s.low, 100 * s.high) : mean;
}

// The last part of "Effects/Rotation = off".
std::string short_words(const std::string &change) {
  return change.substr(change.rfind('/') + 1);
}

// The mean over the references; NaN where none has two seeds.
double scatter_of(const AccuracyResults &study, std::size_t measure) {
  SeedStatistics references;
  for (const AccuracyParameter &parameter : study.parameters)
    references.add(parameter.scatter[measure]);
  return references.mean();
}

Chart chart_of(const AccuracyResults &study, std::size_t measure) {
  Chart chart;
  chart.scale = Scale::logarithmic;
  chart.x_title = "Seconds of a run";
  chart.y_title = fmt::format("Error of {} (%)", measures[measure].title);
  std::size_t colour = 0;
  for (const AccuracyParameter &parameter : study.parameters) {
    Curve joined{parameter.name, {}, {}, run_colour(colour)};
    for (std::size_t v = 0; v + 1 < parameter.values.size(); ++v) {
      const AccuracyValue &value = parameter.values[v];
      const double x = value.seconds, y = 100 * value.errors[measure].root_mean_square;
      if (!(x > 0 && y > 0)) continue; // no error at all has no place on such an axis
      const Colour own = run_colour(parameter.ordered ? colour : colour + v);
      chart.marks.push_back({x, y, parameter.ordered ? "" : short_words(value.text), own,
                             parameter.ordered ? MarkShape::circle : MarkShape::diamond});
      joined.x.push_back(x), joined.y.push_back(y);
    }
    colour += parameter.ordered ? 1 : parameter.values.size();
    if (!parameter.ordered || joined.x.empty()) continue;
    if (joined.x.size() == 1) chart.marks.back().label = parameter.name;
    chart.curves.push_back(std::move(joined));
  }
  chart.band_top = 100 * scatter_of(study, measure);
  chart.band_label = "within the scatter of the seeds";
  return chart;
}

} // namespace

AccuracyResults read_accuracy(const std::filesystem::path &folder) {
  const std::filesystem::path file = folder / "study.json";
  const Json study = finished_study(folder);
  AccuracyResults results;
  results.title = title_of_study(folder);
  results.folder = folder;
  try {
    for (const Json &one : study.at("accuracy"))
      results.parameters.push_back(parameter_of(one));
    add_seconds(results, study.at("costs").at("wall_seconds"));
    add_prices(results, study.at("costs").at("prices"));
    add_failed_runs(study, results.remarks);
  } catch (const Json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  }
  return results;
}

TableOfFigures table_of_accuracy(const AccuracyResults &study) {
  TableOfFigures table;
  table.header = {"", "value", "seeds"};
  for (const MeasureWords &measure : measures)
    table.header.push_back(fmt::format("{} (%)", measure.title));
  table.header.emplace_back("seconds");
  for (const AccuracyParameter &parameter : study.parameters)
    for (const AccuracyValue &value : parameter.values) {
      const bool reference = &value == &parameter.values.back();
      std::vector<std::string> row{parameter.name,
                                   !std::isnan(value.number)
                                       ? in_usual_unit(value.number, parameter.unit)
                                       : value.text + (parameter.unit.empty() ? "" : " " + parameter.unit),
                                   std::to_string(value.errors[0].runs)};
      for (std::size_t m = 0; m < accuracy_measures; ++m)
        row.push_back(
            !reference ? error_words(value.errors[m])
            : std::isnan(parameter.scatter[m])
                ? "reference"
                : fmt::format("reference; deviation of its seeds {:.2g}", 100 * parameter.scatter[m]));
      row.push_back(std::isnan(value.seconds) ? "-" : fmt::format("{:.3g}", value.seconds));
      table.rows.push_back(std::move(row));
    }
  return table;
}

void write_accuracy_report(const AccuracyResults &study, const std::filesystem::path &folder,
                           std::ostream &out) {
  Album album(folder);
  add_head(study.folder, album);
  album.begin("");
  for (std::size_t first = 0; first < accuracy_measures; first += 2) {
    std::vector<Chart> charts;
    for (const std::size_t measure : {first, first + 1})
      if (Chart chart = chart_of(study, measure); !chart.marks.empty()) charts.push_back(std::move(chart));
    if (!charts.empty())
      album.add(first == 0 ? "accuracy.png" : "accuracy_more.png",
                "Error against the reference of each knob, on the same seed, and seconds of a run; "
                "from coarse to fine along each line. Grey: within the scatter of the seeds (mean over "
                "the references), where more accuracy is lost among specimens.",
                save_charts, study.title, "Error against what it costs, root mean square over the seeds",
                charts, std::vector<int>(charts.size(), 700));
  }
  std::vector<std::string> remarks = study.remarks;
  if (album.size() == 0) remarks.emplace_back("no run errs: there is nothing to draw");
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(study.title, table_of_accuracy(study), remarks, out);
}

} // namespace platen::apps::report
