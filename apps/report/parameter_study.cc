#include "apps/report/parameter_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>

#include "apps/report/chart.h"
#include "apps/report/head.h"
#include "apps/scene/errors.h"

namespace platen::apps::report {
namespace {

namespace fs = std::filesystem;

// Those that a scene of such a study can vary.
const std::vector<VariedColumn> known_columns = {
    {"axial_rate_m_s", "Platen speed (mm/s)", 1e3, true},
    {"sphere_radius_m", "Sphere radius (mm)", 1e3, false},
    {"radius_m", "Radius of the specimen (mm)", 1e3, false},
    {"height_m", "Height of the specimen (mm)", 1e3, false},
    {"gap_over_radius", "Gap over the least sphere radius", 1, false},
    {"gap_m", "Gap (mm)", 1e3, false},
    {"radius_multiplier", "Radius multiplier of the bonds", 1, false},
    {"radius_spread", "Spread of the sphere radii", 1, false}};
constexpr const char *across = "spheres_across";

double label_of(const Json &one, const std::string &key) {
  if (key == across) return label_of(one, "radius_m") / label_of(one, "sphere_radius_m");
  return one.contains(key) ? number_or_nan(one.at(key)) : std::nan("");
}

bool differs(const Json &cases, const std::string &key) {
  double first = std::nan("");
  for (const Json &one : cases) {
    const double value = label_of(one, key);
    if (std::isnan(value)) continue;
    if (!std::isnan(first) && value != first) return true;
    first = value;
  }
  return false;
}

// What differs. Where specimens and spheres both do, the number of spheres across comes first.
std::vector<VariedColumn> columns_of(const Json &cases, const std::string &kind) {
  std::vector<VariedColumn> columns;
  for (const VariedColumn &column : known_columns)
    if (differs(cases, column.key)) columns.push_back(column);
  if (kind == "size" && differs(cases, across))
    columns.insert(columns.begin(), {across, "Diameter of the specimen over that of a sphere", 1, false});
  return columns;
}

// Speeds become rates of strain where the scene tells the height.
void take_strain_rates(ParameterStudy &study, const fs::path &folder) {
  const double height = number_of_scene(folder, "Specimen/Height", "m");
  if (study.kind != "rate" || study.columns.empty() || !(height > 0)) return;
  study.columns.front().title = "Axial strain rate (1/s)";
  for (ParameterCase &one : study.cases)
    one.labels.front() /= study.columns.front().factor * height;
  study.columns.front().factor = 1 / height;
}

Spread figure(const Json &one, const char *key, double unit) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  return one.contains(key) ? over_seeds(one.at(key), unit) : Spread{nan, nan, nan};
}

void remark_missing(ParameterStudy &study, const ParameterCase &one, const fs::path &folder) {
  const std::array<std::pair<const char *, const Spread *>, 3> wanted{
      {{"strength_pa", &one.strength},
       {"youngs_modulus_gauge_pa", &one.modulus},
       {"strain_at_peak_platen", &one.strain}}};
  for (const auto &[key, spread] : wanted) {
    if (!std::isnan(spread->mean)) continue;
    const std::string reasons = reasons_in_runs(folder, one.name, key);
    study.remarks.push_back(fmt::format("{}: no {}{}; a gap in the picture", one.name, key,
                                        !reasons.empty() ? ", " + reasons
                                        : one.failed > 0 && one.failed >= one.runs
                                            ? fmt::format(", {} of {} runs failed", one.failed, one.runs)
                                            : ""));
  }
}

// What all cases of a curve share: the labels beside the x axis. Of sizes the specimen, where several spheres
// fill it.
std::string curve_words(const ParameterStudy &study, const ParameterCase &one) {
  std::vector<std::string> words;
  const auto label = [&](const std::string &key) {
    for (std::size_t k = 0; k < study.columns.size(); ++k)
      if (study.columns[k].key == key) return one.labels[k];
    return std::nan("");
  };
  if (study.kind == "size" && !study.columns.empty() && study.columns.front().key == across) {
    if (!std::isnan(label("sphere_radius_m"))) {
      const bool shared =
          std::any_of(study.cases.begin(), study.cases.end(), [&](const ParameterCase &other) {
            for (std::size_t k = 0; k < study.columns.size(); ++k)
              if ((study.columns[k].key == "radius_m" || study.columns[k].key == "height_m") &&
                  other.labels[k] != one.labels[k])
                return false;
            return &other != &one;
          });
      if (!shared) return fmt::format("spheres of {:.3g} mm", label("sphere_radius_m"));
    }
    if (std::isnan(label("height_m"))) return "";
    return fmt::format("specimen {:.3g} mm high", label("height_m"));
  }
  for (std::size_t k = 1; k < study.columns.size(); ++k)
    if (!std::isnan(one.labels[k]))
      words.push_back(fmt::format("{} {:.4g}", study.columns[k].title, one.labels[k]));
  std::string text;
  for (const std::string &word : words)
    text += (text.empty() ? "" : ", ") + word;
  if (!text.empty()) text[0] = static_cast<char>(std::tolower(text[0]));
  return text;
}

Chart chart_of(const ParameterStudy &study, Spread ParameterCase::*of, const std::string &y_title) {
  constexpr double half_cap = 0.006; // of the x axis
  Chart chart;
  const bool logarithmic = study.columns.front().logarithmic;
  chart.scale = logarithmic ? Scale::logarithmic_x : Scale::linear;
  chart.x_title = study.columns.front().title;
  chart.y_title = y_title;
  std::map<std::string, std::vector<const ParameterCase *>> curves;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ParameterCase &one : study.cases) {
    curves[curve_words(study, one)].push_back(&one);
    if (const double x = one.labels.front(); !std::isnan(x)) low = std::min(low, x), high = std::max(high, x);
  }
  std::size_t colour = 0;
  for (auto &[words, cases] : curves) {
    std::sort(cases.begin(), cases.end(), [](const ParameterCase *a, const ParameterCase *b) {
      return a->labels.front() < b->labels.front();
    });
    Curve curve{words, {}, {}, run_colour(colour++)};
    for (const ParameterCase *one : cases) {
      const Spread &y = one->*of;
      const double x = one->labels.front();
      curve.x.push_back(x), curve.y.push_back(y.mean);
      if (std::isnan(y.mean)) continue;
      chart.marks.push_back({x, y.mean, cases.size() == 1 ? words : "", curve.colour, MarkShape::circle});
      add_bar(chart, x, y.low, y.high, logarithmic ? 0 : half_cap * (high - low), curve.colour);
    }
    chart.curves.push_back(std::move(curve));
  }
  if (!logarithmic && high >= low) chart.x_range = snug_range(low, high);
  return chart;
}

} // namespace

bool is_parameter_study(const std::string &kind) {
  return kind == "size" || kind == "packing" || kind == "rate";
}

ParameterStudy read_parameter_study(const fs::path &folder) {
  const fs::path file = folder / "study.json";
  const Json study = finished_study(folder);
  ParameterStudy results;
  results.title = title_of_study(folder);
  results.folder = folder;
  try {
    results.kind = study.at("kind");
    const Json &cases = study.at("cases");
    results.columns = columns_of(cases, results.kind);
    for (const Json &one : cases) {
      ParameterCase read;
      read.name = one.at("name");
      read.runs = one.value("runs", 0), read.failed = one.value("failed", 0);
      for (const VariedColumn &column : results.columns)
        read.labels.push_back(label_of(one, column.key) * column.factor);
      read.particles = figure(one, "particles", 1);
      read.packing = figure(one, "packing_fraction", 1);
      read.strength = figure(one, "strength_pa", pa_per_mpa);
      read.modulus = figure(one, "youngs_modulus_gauge_pa", 1e9);
      read.poisson = figure(one, "poisson_ratio", 1);
      read.strain = figure(one, "strain_at_peak_platen", 1 / mm_per_m);
      remark_missing(results, read, folder);
      results.cases.push_back(std::move(read));
    }
    add_failed_runs(study, results.remarks);
  } catch (const Json::exception &error) {
    throw InputError(file.string() + ": " + error.what());
  }
  take_strain_rates(results, folder);
  return results;
}

TableOfFigures table_of(const ParameterStudy &study) {
  TableOfFigures table;
  table.header = {"case"};
  for (const VariedColumn &column : study.columns)
    table.header.push_back(column.title);
  table.header.insert(table.header.end(), {"runs", "spheres", "packing", "strength (MPa)", "E (GPa)",
                                           "Poisson's ratio", "strain at peak (mm/m)"});
  for (const ParameterCase &one : study.cases) {
    std::vector<std::string> row{one.name};
    for (const double label : one.labels)
      row.push_back(std::isnan(label) ? "-" : fmt::format("{:.4g}", label));
    row.insert(row.end(),
               {std::to_string(one.runs), words(one.particles, 0), words(one.packing, 3),
                words(one.strength, 1), words(one.modulus, 2), words(one.poisson, 3), words(one.strain, 3)});
    table.rows.push_back(std::move(row));
  }
  return table;
}

void draw_parameter_study(const ParameterStudy &study, const fs::path &png) {
  int most = 0;
  for (const ParameterCase &one : study.cases)
    most = std::max(most, one.runs - one.failed);
  std::vector<Chart> charts;
  std::vector<int> heights;
  for (const auto &[of, y_title] : {std::pair{&ParameterCase::strength, "Strength (MPa)"},
                                    {&ParameterCase::modulus, "Young's modulus (GPa)"},
                                    {&ParameterCase::strain, "Strain at peak (mm/m)"}})
    if (Chart chart = chart_of(study, of, y_title); !chart.marks.empty()) {
      heights.push_back(charts.empty() ? 700 : 500);
      charts.push_back(std::move(chart));
    }
  save_charts(study.title, "Strength, modulus (gauge) and strain at peak (platens)" + words_of_scatter(most),
              charts, heights, png);
}

void write_parameter_report(const ParameterStudy &study, const fs::path &folder, std::ostream &out) {
  Album album(folder);
  add_head(study.folder, album);
  std::vector<std::string> remarks = study.remarks;
  album.begin("");
  const bool any = std::any_of(study.cases.begin(), study.cases.end(), [](const ParameterCase &one) {
    return !std::isnan(one.strength.mean) || !std::isnan(one.modulus.mean) || !std::isnan(one.strain.mean);
  });
  if (study.columns.empty())
    remarks.emplace_back(study.cases.empty() ? "no case: there is no curve to draw"
                                             : "one case: there is no curve to draw");
  else if (!any)
    remarks.emplace_back("no case has a figure: there is no curve to draw");
  else
    album.add("study_" + study.kind + ".png",
              "Each point is the mean of the packings of a case; bars: their scatter. A case without "
              "a figure is a gap.",
              draw_parameter_study, study);
  for (const std::string &remark : remarks)
    out << remark << '\n';
  album.finish(study.title, table_of(study), remarks, out);
}

} // namespace platen::apps::report
