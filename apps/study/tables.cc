#include "apps/study/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "apps/output/numbers.h"
#include "apps/scene/values.h"

namespace platen::apps {
namespace {

// Numbers of summary.json that do not depend on the machine's speed; a member of an object after "/".
const std::vector<std::string> figures_of_study = cells_of(
    "particles,bonds,packing_fraction,coordination_number,strength_pa,strain_at_peak_platen,"
    "strain_at_peak_gauge,youngs_modulus_gauge_pa,youngs_modulus_platen_pa,poisson_ratio,broken_tension,"
    "broken_shear,end_damage_top,end_damage_bottom,middle_damage,end_spread,cone_top/half_angle_deg,"
    "cone_bottom/half_angle_deg,final_cone_top/half_angle_deg,final_cone_bottom/half_angle_deg,"
    "dead_zone_top/base_ratio,dead_zone_bottom/base_ratio,dead_zone_top/volume_fraction,"
    "dead_zone_bottom/volume_fraction,"
    "acoustic/b_before,acoustic/b_after,kinetic_to_internal_max,wave_crossings_to_peak,"
    "energy_residual_relative");
// And those that do.
const std::vector<std::string> costs_of_study{"steps", "wall_seconds", "setup_seconds",
                                              "particle_steps_per_second", "peak_memory_bytes"};
constexpr const char *pattern = "pattern"; // how the specimen failed, a word

std::vector<std::string> columns_of(const StudyPlan &plan, const std::vector<std::string> &numbers) {
  std::vector<std::string> columns{"kind", "case"};
  if (of_platens(plan.kind)) columns.emplace_back("surface");
  columns.insert(columns.end(), plan.varied.begin(), plan.varied.end());
  columns.insert(columns.end(), {"seed", "status"});
  columns.insert(columns.end(), numbers.begin(), numbers.end());
  if (&numbers == &figures_of_study) columns.emplace_back(pattern);
  return columns;
}

CsvCell cell_of(const Json &value) {
  if (value.is_string()) return value.get_ref<const std::string &>();
  if (value.is_number_integer()) return value.get<long long>();
  return value.is_number() ? value.get<double>() : not_given;
}

// Runs of this word: "done", "failed", "missing".
std::size_t count_of(const std::vector<RunOutcome> &runs, const std::string &status) {
  return static_cast<std::size_t>(
      std::count_if(runs.begin(), runs.end(), [&](const RunOutcome &one) { return word(one) == status; }));
}

SeedStatistics statistics_of(const std::vector<RunOutcome> &runs, const std::string &key) {
  SeedStatistics statistics;
  for (const RunOutcome &one : runs)
    statistics.add(number_in(one.summary, key));
  return statistics;
}

// With how many runs have the figure, where not all have.
std::string text_of_figure(const std::vector<RunOutcome> &runs, const std::string &key, double unit) {
  const SeedStatistics s = statistics_of(runs, key);
  return s.count() == count_of(runs, "done") ? short_text_of(s, unit) : text_of(s, unit);
}

// How a figure is shown.
struct Shown {
  const char *key, *head;
  double unit;
};
constexpr Shown shown_figures[] = {{"particles", "spheres", 1},
                                   {"packing_fraction", "packing", 1},
                                   {"coordination_number", "neighbours", 1},
                                   {"strength_pa", "strength, MPa", 1e6},
                                   {"strain_at_peak_platen", "strain, 1e-3", 1e-3},
                                   {"youngs_modulus_gauge_pa", "E, GPa", 1e9},
                                   {"poisson_ratio", "nu", 1},
                                   {"kinetic_to_internal_max", "kinetic", 1},
                                   {"wall_seconds", "seconds", 1}};

// Columns that any case has, by their place in it; where cases have names, those that differ.
std::vector<std::size_t> labels_of(const StudyPlan &plan, bool named) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < plan.varied.size(); ++k) {
    const auto any = [&](const auto &holds) {
      return std::any_of(plan.cases.begin(), plan.cases.end(),
                         [&](const StudyCase &of) { return holds(of.labels[k]); });
    };
    const CaseColumn *column = case_column(plan.varied[k]);
    const double first = plan.cases.front().labels[k];
    if (column != nullptr && column->head != nullptr &&
        any([](double value) { return !std::isnan(value); }) &&
        (!named || any([&](double value) { return value != first; })))
      places.push_back(k);
  }
  return places;
}

} // namespace

bool has_peaked(const Json &summary) {
  return summary.is_object() && summary.value("peak_reached", Json()) == true;
}

std::vector<std::vector<double>> strengths_of(const Outcomes &outcomes) {
  std::vector<std::vector<double>> all;
  for (const std::vector<RunOutcome> &runs : outcomes) {
    all.emplace_back();
    for (const RunOutcome &one : runs)
      all.back().push_back(has_peaked(one.summary) ? number_in(one.summary, "strength_pa") : not_given);
  }
  return all;
}

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

void write_row(CsvWriter &table, const Json &cells) {
  std::vector<CsvCell> row;
  for (const Json &one : cells)
    row.push_back(cell_of(one));
  table.row(row);
}

void write_table(const std::filesystem::path &csv, const std::vector<std::string> &keys,
                 const Json &objects) {
  std::vector<std::string> columns = keys;
  for (std::string &column : columns)
    std::replace(column.begin(), column.end(), '/', '_');
  WholeTable table(csv, columns);
  for (const Json &object : objects) {
    Json cells = Json::array();
    for (const std::string &key : keys) {
      const Json::json_pointer member("/" + key);
      cells.push_back(object.contains(member) ? object[member] : Json());
    }
    write_row(table, cells);
  }
  table.finish();
}

StudyTables::StudyTables(const StudyPlan &plan, const OutputPaths &paths)
    : plan_(plan),
      study_(paths.study(), columns_of(plan, figures_of_study)),
      costs_(paths.costs(), columns_of(plan, costs_of_study)),
      outcomes_(plan.cases.size()) {}

void StudyTables::add(const TestRun &run, const RunOutcome &outcome) {
  const StudyCase &of = plan_.cases[run.of];
  Json cells{word(plan_.kind), of.name};
  if (of_platens(plan_.kind)) cells.push_back(of.surface);
  for (std::size_t k = 0; k < of.labels.size(); ++k)
    cells.push_back(of.label(k));
  cells.push_back(run.seed);
  cells.push_back(word(outcome));
  Json cost_cells = cells;
  for (const std::string &key : figures_of_study)
    cells.push_back(number_in(outcome.summary, key));
  cells.push_back(text_in(outcome.summary, pattern));
  for (const std::string &key : costs_of_study)
    cost_cells.push_back(number_in(outcome.summary, key));
  write_row(study_, cells);
  write_row(costs_, cost_cells);
  outcomes_[run.of].push_back(outcome);
}

std::size_t StudyTables::count(const std::string &status) const {
  return std::accumulate(
      outcomes_.begin(), outcomes_.end(), std::size_t{0},
      [&](std::size_t sum, const std::vector<RunOutcome> &runs) { return sum + count_of(runs, status); });
}

Json StudyTables::cases() const {
  Json all = Json::array();
  for (std::size_t c = 0; c < outcomes_.size(); ++c) {
    const std::vector<RunOutcome> &runs = outcomes_[c];
    if (runs.empty()) continue; // a speed that a target has not chosen
    const StudyCase &of = plan_.cases[c];
    Json one;
    one["name"] = of.name;
    if (of_platens(plan_.kind)) one["surface"] = of.surface;
    for (std::size_t k = 0; k < plan_.varied.size(); ++k)
      one[plan_.varied[k]] = of.label(k);
    one["overrides"] = of.overrides;
    one["runs"] = runs.size();
    one["failed"] = count_of(runs, "failed");
    if (const std::size_t missing = count_of(runs, "missing"); missing > 0) one["missing"] = missing;
    if (of_platens(plan_.kind))
      one["without_peak"] = std::count_if(runs.begin(), runs.end(), [](const RunOutcome &outcome) {
        return outcome.done && !has_peaked(outcome.summary);
      });
    for (const std::string &key : figures_of_study)
      one[key] = json_of(statistics_of(runs, key), "runs");
    std::map<std::string, int> patterns; // runs that failed so
    for (const RunOutcome &outcome : runs)
      if (const std::string how = text_in(outcome.summary, pattern); !how.empty()) ++patterns[how];
    one["patterns"] = patterns;
    all.push_back(std::move(one));
  }
  return all;
}

std::string StudyTables::text() const {
  const bool by_surface = of_platens(plan_.kind), by_name = plan_.kind == StudyKind::accuracy ||
                                                            plan_.kind == StudyKind::target ||
                                                            plan_.kind == StudyKind::vary;
  const std::vector<std::size_t> labels = labels_of(plan_, by_surface || by_name);
  std::vector<std::vector<std::string>> rows(1);
  if (by_surface || by_name) rows[0].emplace_back(by_name ? "case" : "platens");
  for (const std::size_t k : labels)
    rows[0].emplace_back(case_column(plan_.varied[k])->head);
  rows[0].emplace_back("runs");
  for (const Shown &column : shown_figures)
    rows[0].emplace_back(column.head);
  rows[0].emplace_back("MB");
  for (std::size_t c = 0; c < outcomes_.size(); ++c) {
    const std::vector<RunOutcome> &runs = outcomes_[c];
    const StudyCase &of = plan_.cases[c];
    if (runs.empty()) continue;
    std::vector<std::string> row;
    if (by_surface || by_name) row.push_back(by_name ? of.name : of.surface);
    for (const std::size_t k : labels)
      row.push_back(std::isnan(of.labels[k])
                        ? "-"
                        : fmt::format("{:.4g}", of.labels[k] / case_column(plan_.varied[k])->unit));
    const std::size_t done = count_of(runs, "done");
    row.push_back(done == runs.size() ? std::to_string(done) : fmt::format("{} of {}", done, runs.size()));
    for (const Shown &column : shown_figures)
      row.push_back(text_of_figure(runs, column.key, column.unit));
    const SeedStatistics bytes = statistics_of(runs, "peak_memory_bytes");
    row.push_back(bytes.count() > 0 ? fmt::format("{:.0f}", 1e-6 * bytes.mean()) : "-");
    rows.push_back(std::move(row));
  }
  return aligned(rows) + "  mean +- standard deviation over the packings, of fewer than five their range\n";
}

} // namespace platen::apps
