#include "apps/study/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/output/numbers.h"

namespace platen::apps {
namespace {

// Numbers of summary.json that do not depend on the machine's speed; a member of an object after "/".
const std::vector<std::string> figures = cells_of(
    "particles,bonds,packing_fraction,coordination_number,strength_pa,strain_at_peak_platen,"
    "strain_at_peak_gauge,youngs_modulus_gauge_pa,youngs_modulus_platen_pa,poisson_ratio,broken_tension,"
    "broken_shear,end_damage_top,end_damage_bottom,middle_damage,end_spread,cone_top/half_angle_deg,"
    "cone_bottom/half_angle_deg,final_cone_top/half_angle_deg,final_cone_bottom/half_angle_deg,"
    "dead_zone_top/base_ratio,dead_zone_bottom/base_ratio,dead_zone_top/volume_fraction,"
    "dead_zone_bottom/volume_fraction,"
    "acoustic/b_before,acoustic/b_after,kinetic_to_internal_max,wave_crossings_to_peak,"
    "energy_residual_relative");
// And those that do.
const std::vector<std::string> costs{"steps", "wall_seconds", "setup_seconds", "particle_steps_per_second",
                                     "peak_memory_bytes"};

std::vector<std::string> columns_of(const StudyPlan &plan, const std::vector<std::string> &numbers) {
  std::vector<std::string> columns{"kind", "case"};
  if (of_platens(plan.kind)) columns.emplace_back("surface");
  columns.insert(columns.end(), plan.varied.begin(), plan.varied.end());
  columns.insert(columns.end(), {"seed", "status"});
  columns.insert(columns.end(), numbers.begin(), numbers.end());
  if (&numbers == &figures) columns.emplace_back("pattern");
  return columns;
}

// How the specimen failed; empty where it was not told.
std::string pattern_in(const Json &summary) {
  const auto found = summary.find("pattern");
  return found != summary.end() && found->is_string() ? found->get<std::string>() : "";
}

Json json_of(const SeedStatistics &s) {
  return {{"mean", s.mean()},
          {"deviation", s.deviation()},
          {"low", s.least()},
          {"high", s.largest()},
          {"runs", s.count()}};
}

// With how many runs have the figure, where not all have.
std::string text_of_row(const SeedStatistics &s, double unit, int runs) {
  return s.count() == static_cast<std::size_t>(runs) ? short_text_of(s, unit) : text_of(s, unit);
}

// How a column is shown.
struct Shown {
  const char *column, *head;
  double unit;
};
constexpr Shown varied[] = {{"friction_static", "friction", 1},
                            {"slenderness", "height/width", 1},
                            {"confining_pressure_pa", "cell, MPa", 1e6},
                            {"sphere_radius_m", "sphere, mm", 1e-3},
                            {"height_m", "height, mm", 1e-3},
                            {"radius_m", "radius, mm", 1e-3},
                            {"gap_over_radius", "gap/R", 1},
                            {"gap_m", "gap, mm", 1e-3},
                            {"radius_multiplier", "multiplier", 1},
                            {"radius_spread", "spread", 1},
                            {"axial_rate_m_s", "rate, m/s", 1}};
constexpr Shown measured[] = {{"particles", "spheres", 1},
                              {"packing_fraction", "packing", 1},
                              {"coordination_number", "neighbours", 1},
                              {"strength_pa", "strength, MPa", 1e6},
                              {"strain_at_peak_platen", "strain, 1e-3", 1e-3},
                              {"youngs_modulus_gauge_pa", "E, GPa", 1e9},
                              {"poisson_ratio", "nu", 1},
                              {"kinetic_to_internal_max", "kinetic", 1}};

struct Label {
  const Shown *shown;
  std::size_t place; // in the case
};

// Those that any case has; where cases have names, those that differ.
std::vector<Label> labels_of(const StudyPlan &plan, bool named) {
  std::vector<Label> labels;
  for (std::size_t k = 0; k < plan.varied.size(); ++k) {
    const auto any = [&](const auto &holds) {
      return std::any_of(plan.cases.begin(), plan.cases.end(),
                         [&](const StudyCase &of) { return holds(of.labels[k]); });
    };
    const auto *found = std::find_if(std::begin(varied), std::end(varied),
                                     [&](const Shown &one) { return plan.varied[k] == one.column; });
    const double first = plan.cases.front().labels[k];
    if (found != std::end(varied) && any([](double value) { return !std::isnan(value); }) &&
        (!named || any([&](double value) { return value != first; })))
      labels.push_back({found, k});
  }
  return labels;
}

} // namespace

std::string aligned(const std::vector<std::vector<std::string>> &rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto &row : rows)
    for (std::size_t k = 0; k < row.size(); ++k)
      widths[k] = std::max(widths[k], row[k].size());
  std::string text;
  for (const auto &row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k)
      text += fmt::format("  {:>{}}", row[k], widths[k]);
    text += '\n';
  }
  return text;
}

StudyTables::StudyTables(const StudyPlan &plan, const OutputPaths &paths)
    : plan_(plan),
      study_(paths.study(), columns_of(plan, figures)),
      costs_(paths.costs(), columns_of(plan, costs)),
      cases_(plan.cases.size()) {
  for (OfCase &of : cases_) // those without a run too
    for (const auto &keys : {figures, costs})
      for (const std::string &key : keys)
        of.figures[key];
}

void StudyTables::add(const TestRun &run, const RunOutcome &outcome) {
  const StudyCase &of = plan_.cases[run.of];
  OfCase &sums = cases_[run.of];
  std::vector<CsvCell> cells{word(plan_.kind), of.name};
  if (of_platens(plan_.kind)) cells.emplace_back(of.surface);
  for (std::size_t k = 0; k < of.labels.size(); ++k)
    cells.push_back(with_label(of, k, [](const auto &label) { return CsvCell(label); }));
  cells.insert(cells.end(), {run.seed, word(outcome)});
  std::vector<CsvCell> cost_cells = cells;
  for (const std::string &key : figures) {
    const double value = number_in(outcome.summary, key);
    cells.emplace_back(value);
    sums.figures[key].add(value);
  }
  const std::string pattern = pattern_in(outcome.summary);
  cells.emplace_back(pattern);
  if (!pattern.empty()) ++sums.patterns[pattern];
  for (const std::string &key : costs) {
    const double value = number_in(outcome.summary, key);
    cost_cells.emplace_back(value);
    sums.figures[key].add(value);
  }
  study_.row(cells);
  costs_.row(cost_cells);
  sums.strengths.push_back(peaked(outcome.summary) ? number_in(outcome.summary, "strength_pa") : not_given);
  if (outcome.done && !peaked(outcome.summary)) ++sums.without_peak;
  ++sums.runs;
  if (!outcome.done) ++(outcome.missing ? sums.missing : sums.failed);
}

bool StudyTables::peaked(const Json &summary) {
  return summary.is_object() && summary.value("peak_reached", Json()) == true;
}

int StudyTables::failed() const {
  return std::accumulate(cases_.begin(), cases_.end(), 0,
                         [](int sum, const OfCase &of) { return sum + of.failed; });
}

int StudyTables::missing() const {
  return std::accumulate(cases_.begin(), cases_.end(), 0,
                         [](int sum, const OfCase &of) { return sum + of.missing; });
}

Json StudyTables::cases() const {
  Json all = Json::array();
  for (std::size_t c = 0; c < cases_.size(); ++c) {
    if (cases_[c].runs == 0) continue; // a speed that a target has not chosen
    Json one;
    one["name"] = plan_.cases[c].name;
    if (of_platens(plan_.kind)) one["surface"] = plan_.cases[c].surface;
    for (std::size_t k = 0; k < plan_.varied.size(); ++k)
      one[plan_.varied[k]] = with_label(plan_.cases[c], k, [](const auto &label) { return Json(label); });
    one["overrides"] = plan_.cases[c].overrides;
    one["runs"] = cases_[c].runs;
    one["failed"] = cases_[c].failed;
    if (cases_[c].missing > 0) one["missing"] = cases_[c].missing;
    if (of_platens(plan_.kind)) one["without_peak"] = cases_[c].without_peak;
    for (const std::string &key : figures)
      one[key] = json_of(cases_[c].figures.at(key));
    one["patterns"] = cases_[c].patterns;
    all.push_back(std::move(one));
  }
  return all;
}

std::vector<std::vector<double>> StudyTables::strengths() const {
  std::vector<std::vector<double>> all;
  for (const OfCase &of : cases_)
    all.push_back(of.strengths);
  return all;
}

std::string StudyTables::text() const {
  const bool accuracy = plan_.kind == StudyKind::accuracy || plan_.kind == StudyKind::target ||
                        plan_.kind == StudyKind::vary,
             named = of_platens(plan_.kind) || accuracy;
  const std::vector<Label> labels = labels_of(plan_, named);
  std::vector<std::vector<std::string>> rows(1);
  if (named) rows[0].emplace_back(accuracy ? "case" : "platens");
  for (const Label &label : labels)
    rows[0].emplace_back(label.shown->head);
  rows[0].emplace_back("runs");
  for (const Shown &column : measured)
    rows[0].emplace_back(column.head);
  rows[0].insert(rows[0].end(), {"seconds", "MB"});
  for (std::size_t c = 0; c < cases_.size(); ++c) {
    const OfCase &of = cases_[c];
    if (of.runs == 0) continue;
    std::vector<std::string> row;
    if (named) row.push_back(accuracy ? plan_.cases[c].name : plan_.cases[c].surface);
    for (const Label &label : labels) {
      const double value = plan_.cases[c].labels[label.place] / label.shown->unit;
      row.push_back(std::isnan(value) ? "-" : fmt::format("{:.4g}", value));
    }
    const int absent = of.failed + of.missing;
    row.push_back(absent == 0 ? std::to_string(of.runs) : fmt::format("{} of {}", of.runs - absent, of.runs));
    for (const Shown &column : measured)
      row.push_back(text_of_row(of.figures.at(column.column), column.unit, of.runs - absent));
    row.push_back(text_of_row(of.figures.at("wall_seconds"), 1, of.runs - absent));
    const SeedStatistics &bytes = of.figures.at("peak_memory_bytes");
    row.push_back(bytes.count() > 0 ? fmt::format("{:.0f}", 1e-6 * bytes.mean()) : "-");
    rows.push_back(std::move(row));
  }
  return aligned(rows) + "  mean +- standard deviation over the packings, of fewer than five their range\n";
}

} // namespace platen::apps
