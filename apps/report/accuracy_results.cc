#include "apps/report/accuracy_results.h"

#include <cmath>
#include <cstdio>

#include "apps/report/study_results.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {

const std::array<const char *, accuracy_measures> accuracy_titles{"strength", "strain at the peak",
                                                                  "Young's modulus", "broken bonds"};

namespace {

using Json = nlohmann::json;

constexpr std::array<const char *, accuracy_measures> keys{"strength", "strain_at_peak", "modulus",
                                                           "broken_bonds"};

double number(const Json &value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::string words(const char *format, double a, double b = 0) {
  char text[64];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string with_unit(const std::string &value, const std::string &unit) {
  return value + (unit.empty() ? "" : " " + unit);
}

AccuracyKnob knob_of(const Json &from) {
  AccuracyKnob knob;
  knob.name = from.at("knob");
  knob.unit = from.at("unit");
  knob.ordered = from.at("ordered");
  for (std::size_t m = 0; m < accuracy_measures; ++m)
    knob.scatter[m] = number(from.at("scatter_of_seeds").at(keys[m]));
  for (const Json &one : from.at("values")) {
    AccuracyValue value;
    value.text = one.at("value");
    for (std::size_t m = 0; m < accuracy_measures; ++m) {
      const Json &error = one.at("errors").at(keys[m]);
      value.errors[m] = {number(error.at("mean")), number(error.at("deviation")),
                         number(error.at("root_mean_square")), error.at("runs")};
    }
    value.seconds = std::nan("");
    knob.values.push_back(value);
  }
  return knob;
}

void add_seconds(AccuracyResults &results, const Json &wall_seconds) {
  for (const Json &one : wall_seconds)
    for (AccuracyKnob &knob : results.knobs)
      for (AccuracyValue &value : knob.values)
        if (one.at("knob") == knob.name && one.at("value") == value.text)
          value.seconds = number(one.at("mean"));
}

// "safety, strength: 5 % costs 3.1 s (0.9); 1 %, 0.1 % not reached", a line for each knob and measure.
void add_prices(AccuracyResults &results, const Json &prices) {
  const auto measure_title = [](const std::string &key) -> std::string {
    for (std::size_t m = 0; m < accuracy_measures; ++m)
      if (key == keys[m]) return accuracy_titles[m];
    return key;
  };
  std::string head, reached, missed;
  const auto flush = [&] {
    if (head.empty()) return;
    results.remarks.push_back(head + ": " + reached + (reached.empty() || missed.empty() ? "" : "; ") +
                              (missed.empty() ? "" : missed + " not reached"));
    reached.clear(), missed.clear();
  };
  for (const Json &one : prices) {
    const std::string knob = one.at("knob"), of = knob + ", " + measure_title(one.at("of"));
    if (of != head) flush();
    head = of;
    const std::string bound = words("%g %%", 100 * number(one.at("within")));
    if (one.at("value").is_null())
      missed += (missed.empty() ? "" : ", ") + bound;
    else
      reached += (reached.empty() ? "" : ", ") + bound + " costs " +
                 words("%.3g s", number(one.at("seconds"))) + " (" + one.at("value").get<std::string>() + ")";
  }
  flush();
}

std::string error_words(const ErrorOverSeeds &error) {
  if (error.runs == 0 || std::isnan(error.mean)) return "-";
  return std::isnan(error.deviation) ? words("%+.2g", 100 * error.mean)
                                     : words("%+.2g +- %.2g", 100 * error.mean, 100 * error.deviation);
}

} // namespace

AccuracyResults read_accuracy(const std::filesystem::path &folder) {
  const std::filesystem::path file = folder / "study.json";
  const Json study = finished_study(folder);
  AccuracyResults results;
  results.title = title_of_study(folder);
  try {
    for (const Json &one : study.at("accuracy"))
      results.knobs.push_back(knob_of(one));
    add_seconds(results, study.at("costs").at("wall_seconds"));
    add_prices(results, study.at("costs").at("prices"));
    if (const int failed = study.at("failed_runs"); failed > 0)
      results.remarks.push_back(std::to_string(failed) + " of " +
                                std::to_string(study.at("runs").get<int>()) +
                                " runs failed and count in no mean");
  } catch (const Json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  }
  return results;
}

TableOfFigures table_of_accuracy(const AccuracyResults &study) {
  TableOfFigures table;
  table.header = {"", "value", "seeds"};
  for (const char *title : accuracy_titles)
    table.header.push_back(std::string(title) + " (%)");
  table.header.emplace_back("seconds");
  for (const AccuracyKnob &knob : study.knobs)
    for (const AccuracyValue &value : knob.values) {
      const bool reference = &value == &knob.values.back();
      std::vector<std::string> row{knob.name, with_unit(value.text, knob.unit),
                                   std::to_string(value.errors[0].runs)};
      for (std::size_t m = 0; m < accuracy_measures; ++m)
        row.push_back(!reference                    ? error_words(value.errors[m])
                      : std::isnan(knob.scatter[m]) ? "reference"
                                                    : words("seeds +- %.2g", 100 * knob.scatter[m]));
      row.push_back(std::isnan(value.seconds) ? "-" : words("%.3g", value.seconds));
      table.rows.push_back(std::move(row));
    }
  return table;
}

} // namespace platen::apps::report
