#include "apps/study/accuracy.h"

#include <cmath>

#include "apps/io/csv_writer.h"
#include "apps/study/tables.h"

namespace platen::apps {
namespace {

constexpr const char *measure_words[measure_count] = {"strength", "strain_at_peak", "modulus",
                                                      "broken_bonds"};

SeedStatistics statistics(const std::vector<double> &values) {
  SeedStatistics s;
  for (const double value : values)
    s.add(value);
  return s;
}

} // namespace

const char *word(Measure measure) {
  return measure_words[static_cast<std::size_t>(measure)];
}

void Accuracy::add(const StudyRun &run, const RunOutcome &outcome) {
  const auto number = [&](const char *key) { return number_in(outcome.summary, key); };
  const bool peaked = StudyTables::peaked(outcome.summary);
  cases_[run.of].push_back(
      {outcome.done,
       {peaked ? number("strength_pa") : not_given, peaked ? number("strain_at_peak_platen") : not_given,
        peaked ? number("youngs_modulus_gauge_pa") : not_given,
        number("broken_tension") + number("broken_shear")},
       number("energy_residual_relative"),
       number("kinetic_to_internal_max"),
       number("steps"),
       number("wall_seconds")});
}

double Accuracy::error(const Knob &knob, std::size_t value, std::size_t seed, std::size_t measure) const {
  const auto measured = [&](const Knob::Value &v) { return cases_[v.of_case][seed].measures[measure]; };
  const double reference = measured(knob.values.back());
  return reference == 0 ? not_given : measured(knob.values[value]) / reference - 1;
}

std::vector<KnobErrors> Accuracy::errors() const {
  std::vector<KnobErrors> all;
  for (const Knob &knob : plan_.knobs) {
    KnobErrors of;
    for (std::size_t m = 0; m < measure_count; ++m) {
      std::vector<double> reference;
      for (const Run &run : cases_[knob.values.back().of_case])
        reference.push_back(run.measures[m]);
      const SeedStatistics s = statistics(reference);
      of.scatter[m] = s.deviation() / s.mean();
    }
    for (std::size_t v = 0; v < knob.values.size(); ++v) {
      ValueErrors errors;
      const std::vector<Run> &runs = cases_[knob.values[v].of_case];
      for (std::size_t seed = 0; seed < runs.size(); ++seed) {
        for (std::size_t m = 0; m < measure_count; ++m)
          errors.errors[m].add(error(knob, v, seed, m));
        errors.residual.add(runs[seed].residual);
        errors.kinetic.add(runs[seed].kinetic);
        errors.steps.add(runs[seed].steps);
        errors.seconds.add(runs[seed].seconds);
      }
      of.values.push_back(std::move(errors));
    }
    all.push_back(std::move(of));
  }
  return all;
}

void Accuracy::write_rows(const std::filesystem::path &csv) const {
  std::vector<std::string> columns{"knob", "value", "case", "seed", "status"};
  for (const char *measure : measure_words)
    columns.push_back(std::string(measure) + "_error");
  columns.insert(columns.end(), {"energy_residual_relative", "kinetic_to_internal_max", "steps"});
  WholeTable rows(csv, columns);
  for (const Knob &knob : plan_.knobs)
    for (std::size_t v = 0; v < knob.values.size(); ++v)
      for (std::size_t seed = 0; seed < plan_.seeds.size(); ++seed) {
        const Knob::Value &value = knob.values[v];
        const Run &run = cases_[value.of_case][seed];
        std::vector<CsvCell> cells{knob.name, value.text, plan_.cases[value.of_case].name, plan_.seeds[seed],
                                   run.done ? "done" : "failed"};
        for (std::size_t m = 0; m < measure_count; ++m)
          cells.emplace_back(error(knob, v, seed, m));
        cells.insert(cells.end(), {run.residual, run.kinetic, run.steps});
        rows.row(cells);
      }
  rows.finish();
}

std::optional<std::size_t> cheapest_within(const KnobErrors &of, Measure measure, double bound) {
  std::optional<std::size_t> cheapest;
  const std::size_t seeds = of.values.back().of(measure).count();
  for (std::size_t v = of.values.size() - 1; v-- > 0;) {
    const SeedStatistics &error = of.values[v].of(measure);
    if (error.count() < seeds || !(error.root_mean_square() <= bound)) break;
    if (!cheapest || of.values[v].seconds.mean() < of.values[*cheapest].seconds.mean()) cheapest = v;
  }
  return cheapest;
}

} // namespace platen::apps
