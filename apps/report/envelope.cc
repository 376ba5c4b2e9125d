#include "apps/report/envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "apps/output/seed_statistics.h"
#include "apps/report/chart.h"
#include "apps/report/csv.h"
#include "base/pi.h"

namespace platen::apps::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double degree = pi / 180;

double or_zero(double value) { // keys that can be compared
  return std::isnan(value) ? 0 : value;
}

Spread over_lines(const std::vector<FailureLine> &lines, double FailureLine::*of) {
  SeedStatistics statistics;
  for (const FailureLine &line : lines)
    statistics.add(line.*of);
  return spread_of(statistics);
}

// Strengths of a study in MPa: by case, by seed.
using Strengths = std::map<std::string, std::map<unsigned long, double>>;

Strengths strengths_in(const std::filesystem::path &csv) {
  const CsvTable table = read_csv(csv, {"kind", "case", "surface", "status", "pattern"});
  const auto &names = table.words.find("case"), &status = table.words.find("status");
  Strengths strengths;
  if (names == table.words.end() || status == table.words.end()) return strengths;
  for (std::size_t row = 0; row < table.rows; ++row) {
    const double strength = table.column("strength_pa")[row];
    if (status->second[row] == "done" && !std::isnan(strength))
      strengths[names->second[row]][static_cast<unsigned long>(table.column("seed")[row])] =
          strength / pa_per_mpa;
  }
  return strengths;
}

Envelope envelope_of(const StudyResults &study, const std::vector<std::size_t> &cases,
                     const Strengths &strengths) {
  Envelope envelope;
  std::map<unsigned long, std::pair<std::vector<double>, std::vector<double>>> by_seed;
  for (const std::size_t k : cases) {
    const StudiedCase &one = study.cases[k];
    SeedStatistics statistics;
    if (const auto found = strengths.find(one.name); found != strengths.end())
      for (const auto &[seed, strength] : found->second) {
        statistics.add(strength);
        by_seed[seed].first.push_back(one.pressure / pa_per_mpa);
        by_seed[seed].second.push_back(strength);
      }
    if (statistics.count() > 0)
      envelope.points.push_back(
          {one.pressure / pa_per_mpa, spread_of(statistics), static_cast<int>(statistics.count())});
  }
  std::sort(envelope.points.begin(), envelope.points.end(),
            [](const EnvelopePoint &a, const EnvelopePoint &b) { return a.pressure < b.pressure; });
  for (const auto &[seed, values] : by_seed) {
    FailureLine line = line_through(values.first, values.second);
    line.seed = seed;
    if (!std::isnan(line.k)) envelope.lines.push_back(line);
  }
  envelope.q = over_lines(envelope.lines, &FailureLine::q);
  envelope.k = over_lines(envelope.lines, &FailureLine::k);
  envelope.cohesion = over_lines(envelope.lines, &FailureLine::cohesion);
  envelope.phi = over_lines(envelope.lines, &FailureLine::phi);
  return envelope;
}

std::string packings_of(const Envelope &envelope) {
  return envelope.lines.size() == 1 ? "1 packing" : fmt::format("{} packings", envelope.lines.size());
}

Chart failure_chart(const Envelope &envelope) {
  constexpr int stations = 40;
  constexpr double half_cap = 0.006;
  Chart chart;
  const double end = 1.05 * envelope.points.back().pressure, fc = envelope.unconfined();
  Curve mean{"", {}, {}, colours::blue, Stroke::dashed, 2};
  for (const EnvelopePoint &point : envelope.points) {
    mean.x.push_back(point.pressure), mean.y.push_back(point.strength.mean);
    add_bar(chart, point.pressure, point.strength.low, point.strength.high, half_cap * end, colours::blue);
    chart.marks.push_back({point.pressure, point.strength.mean,
                           &point == &envelope.points.front() ? "strength, mean of the packings" : "",
                           colours::blue, MarkShape::circle});
  }
  const auto add = [&](const std::string &label, Colour colour, Stroke stroke, const auto &law) {
    Curve curve{label, {}, {}, colour, stroke, 4};
    for (int k = 0; k <= stations; ++k) {
      const double p = end * k / stations;
      curve.x.push_back(p), curve.y.push_back(law(p));
    }
    chart.curves.push_back(std::move(curve));
  };
  if (!envelope.lines.empty())
    add(fmt::format("fitted: {:.1f} + {:.2f} p, mean of {}", envelope.q.mean, envelope.k.mean,
                    packings_of(envelope)),
        colours::blue, Stroke::solid, [&](double p) { return envelope.q.mean + envelope.k.mean * p; });
  if (!std::isnan(fc)) {
    add("EN 1998-3", colours::vermilion, Stroke::solid, [&](double p) { return strength_en_1998_3(fc, p); });
    add("Richart 1928: + 4.1 p", colours::green, Stroke::dashed,
        [&](double p) { return strength_richart(fc, p); });
  }
  chart.x_title = "Pressure on the sides, sigma 3 (MPa)";
  chart.y_title = "Axial stress at failure, sigma 1 (MPa)";
  return chart;
}

// Half circles from sigma 3 to sigma 1 and the tangent of the fitted line. One unit is as long on both axes:
// `height` (pixels) follows from the width of a plot.
Chart mohr_chart(const Envelope &envelope, int &height) {
  constexpr int stations = 90;
  constexpr double plot_width = 1370; // pixels, of all charts
  Chart chart;
  double most = 0, radius = 0;
  for (std::size_t k = 0; k < envelope.points.size(); ++k) {
    const double s3 = envelope.points[k].pressure, s1 = envelope.points[k].strength.mean, r = 0.5 * (s1 - s3);
    most = std::max(most, s1), radius = std::max(radius, r);
    Curve circle{fmt::format("{:.3g} MPa on the sides", s3), {}, {}, run_colour(k), Stroke::solid, 3};
    for (int n = 0; n <= stations; ++n) {
      const double angle = pi * n / stations;
      circle.x.push_back(s3 + r - r * std::cos(angle)), circle.y.push_back(r * std::sin(angle));
    }
    chart.curves.push_back(std::move(circle));
  }
  const double end = 1.04 * most;
  if (!std::isnan(envelope.cohesion.mean)) {
    const double slope = std::tan(envelope.phi.mean * degree), c = envelope.cohesion.mean;
    const double last = std::min(end, (1.3 * radius - c) / slope);
    chart.curves.push_back({fmt::format("c = {:.1f} MPa, phi = {:.1f} degrees, mean of {}",
                                        envelope.cohesion.mean, envelope.phi.mean, packings_of(envelope)),
                            {0, last},
                            {c, c + slope * last},
                            colours::black,
                            Stroke::dashed,
                            4});
  }
  chart.x_range = {0, end};
  const double room = 1.0 + 0.08 * static_cast<double>(chart.curves.size()); // for the legend
  height = static_cast<int>(std::clamp(plot_width * room * radius / end, 500.0, 1300.0));
  chart.y_range = {0, end * height / plot_width};
  chart.x_title = "Normal stress (MPa), compression positive";
  chart.y_title = "Shear stress (MPa)";
  return chart;
}

} // namespace

FailureLine line_through(const std::vector<double> &p, const std::vector<double> &s) {
  FailureLine line{0, static_cast<int>(p.size()), nan, nan, nan, nan};
  const double n = static_cast<double>(p.size());
  double mean_p = 0, mean_s = 0, pp = 0, ps = 0;
  for (std::size_t k = 0; k < p.size(); ++k)
    mean_p += p[k] / n, mean_s += s[k] / n;
  for (std::size_t k = 0; k < p.size(); ++k)
    pp += (p[k] - mean_p) * (p[k] - mean_p), ps += (p[k] - mean_p) * (s[k] - mean_s);
  if (!(pp > 0)) return line;
  line.k = ps / pp;
  line.q = mean_s - line.k * mean_p;
  if (line.k >= 1 && line.q >= 0) {
    line.phi = std::asin((line.k - 1) / (line.k + 1)) / degree;
    line.cohesion = line.q / (2 * std::sqrt(line.k));
  }
  return line;
}

double Envelope::unconfined() const {
  return !points.empty() && points.front().pressure == 0 ? points.front().strength.mean : nan;
}

double strength_en_1998_3(double unconfined, double pressure) {
  return unconfined * (1 + 3.7 * std::pow(pressure / unconfined, 0.86));
}
double strength_richart(double unconfined, double pressure) {
  return unconfined + 4.1 * pressure;
}

std::vector<Envelope> envelopes_of(const StudyResults &study, const std::filesystem::path &folder,
                                   std::vector<std::string> &remarks) {
  std::map<std::tuple<std::string, double, double>, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < study.cases.size(); ++k)
    groups[{study.cases[k].surface, or_zero(study.cases[k].slenderness),
            or_zero(study.cases[k].sphere_radius)}]
        .push_back(k);
  std::vector<Envelope> envelopes;
  for (auto &[group, cases] : groups) {
    const auto &[surface, slenderness, radius] = group;
    std::set<double> pressures;
    for (const std::size_t k : cases)
      if (!std::isnan(study.cases[k].pressure)) pressures.insert(study.cases[k].pressure);
    if (pressures.size() < 2) continue;
    const std::string label = fmt::format("{}, height/width {:.3g}", surface, slenderness);
    cases.erase(std::remove_if(cases.begin(), cases.end(),
                               [&](std::size_t k) { return study.cases[k].without_peak > 0; }),
                cases.end());
    if (!std::filesystem::exists(folder / "study.csv")) {
      remarks.push_back("study.csv is not there: no line of failure is fitted");
      return envelopes;
    }
    Envelope envelope = envelope_of(study, cases, strengths_in(folder / "study.csv"));
    envelope.label = label;
    if (groups.size() > 1) envelope.label += fmt::format(", spheres of {:.3g} mm", mm_per_m * radius);
    if (envelope.points.size() < 2)
      remarks.push_back(label + ": strengths at fewer than two pressures, no line of failure");
    else
      envelopes.push_back(std::move(envelope));
  }
  return envelopes;
}

TableOfFigures table_of(const Envelope &envelope) {
  TableOfFigures table;
  table.header = {"pressure (MPa)",     "packings",        "strength (MPa)",
                  "(sigma 1 - fc) / p", "EN 1998-3 (MPa)", "Richart (MPa)"};
  const double fc = envelope.unconfined();
  for (const EnvelopePoint &point : envelope.points) {
    const double p = point.pressure;
    const bool beside = !std::isnan(fc) && p > 0;
    table.rows.push_back({fmt::format("{:.4g}", p), std::to_string(point.packings), words(point.strength, 1),
                          beside ? fmt::format("{:.2f}", (point.strength.mean - fc) / p) : "-",
                          beside ? fmt::format("{:.1f}", strength_en_1998_3(fc, p)) : "-",
                          beside ? fmt::format("{:.1f}", strength_richart(fc, p)) : "-"});
  }
  return table;
}

TableOfFigures table_of_lines(const Envelope &envelope) {
  TableOfFigures table;
  table.header = {"packing (seed)", "pressures", "q (MPa)", "k", "c (MPa)", "phi (degrees)"};
  const auto number = [](double value, int digits) {
    return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits);
  };
  for (const FailureLine &line : envelope.lines)
    table.rows.push_back({std::to_string(line.seed), std::to_string(line.pressures), number(line.q, 1),
                          number(line.k, 2), number(line.cohesion, 1), number(line.phi, 1)});
  table.rows.push_back({envelope.lines.size() >= fewest_for_deviation ? "mean and deviation"
                        : envelope.lines.size() > 1                   ? "range"
                                                                      : "one packing: no scatter known",
                        "", words(envelope.q, 1), words(envelope.k, 2), words(envelope.cohesion, 1),
                        words(envelope.phi, 1)});
  return table;
}

void draw_envelope(const StudyResults &study, const Envelope &envelope, const std::filesystem::path &png) {
  int most = 0, height = 0;
  for (const EnvelopePoint &point : envelope.points)
    most = std::max(most, point.packings);
  const Chart circles = mohr_chart(envelope, height);
  save_charts(study.title, "Failure under pressure, " + envelope.label + words_of_scatter(most),
              {failure_chart(envelope), circles}, {800, height}, png);
}

} // namespace platen::apps::report
