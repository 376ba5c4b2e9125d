#include "apps/study/failure_envelope.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/output/seed_statistics.h"
#include "apps/study/tables.h"
#include "base/pi.h"

namespace platen::apps {
namespace {

constexpr const char *pressure_column = "confining_pressure_pa";

// Keys of study.json and columns of envelope.csv.
constexpr std::pair<const char *, double FailureLine::*> numbers_of_line[] = {
    {"pressure_low_pa", &FailureLine::pressure_low},
    {"pressure_high_pa", &FailureLine::pressure_high},
    {"cohesion_pa", &FailureLine::cohesion},
    {"cohesion_error_pa", &FailureLine::cohesion_error},
    {"friction_angle_deg", &FailureLine::friction_angle},
    {"friction_angle_error_deg", &FailureLine::friction_angle_error},
    {"q_pa", &FailureLine::q},
    {"q_error_pa", &FailureLine::q_error},
    {"k", &FailureLine::k},
    {"k_error", &FailureLine::k_error},
    {"residual_error_pa", &FailureLine::residual_error},
    {"largest_miss", &FailureLine::largest_miss},
    {"hoek_brown_sc_pa", &FailureLine::hoek_brown_sc},
    {"hoek_brown_m", &FailureLine::hoek_brown_m}};

void add_reason(FailureLine &line, const std::string &reason) {
  line.reason += (line.reason.empty() ? "" : "; ") + reason;
}

// y = start + slope s3 by least squares.
struct Regression {
  double mean = 0, squares = 0; // of s3: mean, sum of squared distances from it
  double start = 0, slope = 0;
};
template <class Ordinate>
Regression regress(const std::vector<FailurePoint> &points, const Ordinate &y) {
  const auto n = static_cast<double>(points.size());
  Regression r;
  double mean_y = 0, products = 0;
  for (const FailurePoint &point : points)
    r.mean += point.pressure / n, mean_y += y(point) / n;
  for (const FailurePoint &point : points) {
    const double off = point.pressure - r.mean;
    r.squares += off * off, products += off * (y(point) - mean_y);
  }
  r.slope = products / r.squares;
  r.start = mean_y - r.slope * r.mean;
  return r;
}

void set_errors(const std::vector<FailurePoint> &points, const Regression &r, FailureLine &line) {
  double squares = 0;
  for (const FailurePoint &point : points)
    squares += std::pow(point.strength - r.start - r.slope * point.pressure, 2);
  const auto n = static_cast<double>(points.size());
  line.residual_error = std::sqrt(squares / (n - 2));
  line.k_error = line.residual_error / std::sqrt(r.squares);
  line.q_error = line.residual_error * std::sqrt(1 / n + r.mean * r.mean / r.squares);
}

void set_mohr_coulomb(double mean_pressure, FailureLine &line) {
  if (line.k < 1 || line.q < 0) {
    add_reason(line, line.k < 1 ? "the strength grows by less than the pressure, k < 1: no c and phi"
                                : "the line is below zero without pressure, q < 0: no c and phi");
    return;
  }
  const double root = std::sqrt(line.k), degrees = 180 / pi;
  line.cohesion = line.q / (2 * root);
  line.friction_angle = degrees * std::asin((line.k - 1) / (line.k + 1));
  const double by_q = line.q_error / (2 * root), by_k = -line.q * line.k_error / (4 * line.k * root),
               covariance = -mean_pressure * line.k_error * line.k_error; // of q and k
  line.cohesion_error = std::sqrt(by_q * by_q + by_k * by_k - line.q / (4 * line.k * line.k) * covariance);
  line.friction_angle_error = degrees * line.k_error / (root * (line.k + 1));
}

// (s1 - s3)^2 = sc^2 + m sc s3.
void set_hoek_brown(const std::vector<FailurePoint> &points, FailureLine &line) {
  const Regression r = regress(
      points, [](const FailurePoint &p) { return (p.strength - p.pressure) * (p.strength - p.pressure); });
  if (r.start > 0 && r.slope > 0) {
    line.hoek_brown_sc = std::sqrt(r.start);
    line.hoek_brown_m = r.slope / line.hoek_brown_sc;
  } else
    add_reason(line, "no curve of Hoek and Brown goes through the strengths");
}

// "2 of 9 runs have no strength".
void say_missing(std::size_t runs, FailureLine &line) {
  if (line.runs < runs)
    add_reason(line, fmt::format("{} of {} runs have no strength", runs - line.runs, runs));
}

FailureEnvelope envelope_of(const StudyPlan &plan, const std::vector<std::size_t> &cases,
                            const std::vector<std::vector<double>> &strengths) {
  const std::string &name = plan.cases[cases.front()].envelope;
  FailureEnvelope envelope{name.empty() ? "all" : name, cases, {}, {}};
  std::vector<FailurePoint> all;
  for (std::size_t seed = 0; seed < plan.seeds.size(); ++seed) {
    std::vector<FailurePoint> points;
    for (const std::size_t c : cases)
      if (!std::isnan(strengths[c][seed]))
        points.push_back({plan.cases[c].labels[plan.place_of(pressure_column)], strengths[c][seed]});
    all.insert(all.end(), points.begin(), points.end());
    envelope.packings.push_back(fit_failure_line(points));
    say_missing(cases.size(), envelope.packings.back());
  }
  if (plan.seeds.size() == 1) envelope.packings.clear();
  envelope.line = fit_failure_line(all);
  say_missing(cases.size() * plan.seeds.size(), envelope.line);
  return envelope;
}

} // namespace

FailureLine fit_failure_line(const std::vector<FailurePoint> &points) {
  FailureLine line;
  line.runs = points.size();
  std::map<double, SeedStatistics> at; // strengths by pressure
  for (const FailurePoint &point : points)
    at[point.pressure].add(point.strength);
  if (at.size() < 2) {
    add_reason(line, "strengths at fewer than two pressures: no line");
    return line;
  }
  const Regression r = regress(points, [](const FailurePoint &point) { return point.strength; });
  line.pressure_low = at.begin()->first, line.pressure_high = at.rbegin()->first;
  line.q = r.start, line.k = r.slope;
  if (line.runs > 2)
    set_errors(points, r, line);
  else
    add_reason(line, "two runs: no standard errors");
  set_mohr_coulomb(r.mean, line);
  line.largest_miss = 0;
  for (const auto &[pressure, strengths] : at)
    line.largest_miss =
        std::max(line.largest_miss, std::abs((line.q + line.k * pressure) / strengths.mean() - 1));
  if (at.size() > 2)
    set_hoek_brown(points, line);
  else
    add_reason(line, "two pressures: no curve of Hoek and Brown");
  return line;
}

std::vector<FailureEnvelope> failure_envelopes(const StudyPlan &plan,
                                               const std::vector<std::vector<double>> &strengths) {
  const std::size_t place = plan.place_of(pressure_column);
  if (place == plan.varied.size()) return {};
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::string, std::size_t> group_of; // by name
  for (std::size_t c = 0; c < plan.cases.size(); ++c) {
    const auto [group, is_new] = group_of.emplace(plan.cases[c].envelope, groups.size());
    if (is_new) groups.emplace_back();
    groups[group->second].push_back(c);
  }
  std::vector<FailureEnvelope> envelopes;
  for (const auto &cases : groups)
    if (std::any_of(cases.begin(), cases.end(), [&](std::size_t c) {
          return plan.cases[c].labels[place] != plan.cases[cases.front()].labels[place];
        }))
      envelopes.push_back(envelope_of(plan, cases, strengths));
  return envelopes;
}

Json json_of(const StudyPlan &plan, const std::vector<FailureEnvelope> &envelopes) {
  const auto add = [](const FailureLine &line, Json &json) {
    json["runs"] = line.runs;
    for (const auto &[key, member] : numbers_of_line)
      json[key] = line.*member;
    if (!line.reason.empty()) json["reason"] = line.reason;
  };
  Json all = Json::array();
  for (const FailureEnvelope &envelope : envelopes) {
    const StudyCase &first = plan.cases[envelope.cases.front()];
    Json one{{"name", envelope.name}};
    for (const std::size_t c : envelope.cases)
      one["cases"].push_back(plan.cases[c].name);
    if (of_platens(plan.kind)) one["surface"] = first.surface;
    for (std::size_t k = 0; k < plan.varied.size(); ++k)
      if (plan.varied[k] != pressure_column) one[plan.varied[k]] = first.label(k);
    add(envelope.line, one);
    for (std::size_t seed = 0; seed < envelope.packings.size(); ++seed) {
      one["packings"].push_back({{"seed", plan.seeds[seed]}});
      add(envelope.packings[seed], one["packings"].back());
    }
    all.push_back(std::move(one));
  }
  return all;
}

void write_envelopes(const std::filesystem::path &csv, const StudyPlan &plan, const Json &envelopes) {
  std::vector<std::string> keys{"name"};
  if (of_platens(plan.kind)) keys.emplace_back("surface");
  for (const std::string &column : plan.varied)
    if (column != pressure_column) keys.push_back(column);
  keys.emplace_back("runs");
  for (const auto &[key, member] : numbers_of_line)
    keys.emplace_back(key);
  keys.emplace_back("reason");
  write_table(csv, keys, envelopes);
}

std::string text_of(const std::vector<FailureEnvelope> &envelopes) {
  const auto number = [](double value, double error) {
    return fmt::format("{:.4g}", value) + (std::isnan(error) ? "" : fmt::format(" +- {:.2g}", error));
  };
  std::string text;
  for (const auto &[name, cases, line, packings] : envelopes) {
    text += fmt::format("  envelope of {}: ", name);
    if (!std::isnan(line.cohesion))
      text += fmt::format("c = {} MPa, phi = {} degrees, ",
                          number(1e-6 * line.cohesion, 1e-6 * line.cohesion_error),
                          number(line.friction_angle, line.friction_angle_error));
    if (!std::isnan(line.k))
      text += fmt::format("{:.4g} to {:.4g} MPa, {} runs, largest miss {:.2g} %{}", 1e-6 * line.pressure_low,
                          1e-6 * line.pressure_high, line.runs, 100 * line.largest_miss,
                          line.reason.empty() ? "" : "; ");
    text += line.reason + '\n';
  }
  return text;
}

} // namespace platen::apps
