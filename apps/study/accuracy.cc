#include "apps/study/accuracy.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/output/csv_writer.h"
#include "apps/scene/units.h"
#include "apps/study/tables.h"

namespace platen::apps {
namespace {

constexpr const char *measure_words[measure_count] = {"strength", "strain_at_peak", "modulus",
                                                      "broken_bonds"};
constexpr double percent = 0.01;
constexpr Measure all_measures[] = {Measure::strength, Measure::strain_at_peak, Measure::modulus,
                                    Measure::broken_bonds};
constexpr Measure priced[] = {Measure::strength, Measure::modulus};
constexpr double bounds[] = {0.05, 0.02, 0.01, 0.001};

Json statistics(const SeedStatistics &s) {
  return {{"mean", s.mean()},
          {"deviation", s.deviation()},
          {"low", s.least()},
          {"high", s.largest()},
          {"root_mean_square", s.root_mean_square()},
          {"runs", s.count()}};
}

std::string with_unit(const StudiedParameter &parameter, const StudiedParameter::Value &value) {
  return parameter.unit.empty() ? value.text : in_usual_unit(value.number, parameter.unit);
}

// Seconds, as few digits as tell them apart.
std::string seconds_text(const SeedStatistics &seconds) {
  return fmt::format("{:.3g} s", seconds.mean());
}

// Seeds whose strength could be compared.
std::string compared(const ValueErrors &of, std::size_t seeds) {
  const std::size_t count = of.of(Measure::strength).count();
  return count == seeds ? std::to_string(count) : fmt::format("{} of {}", count, seeds);
}

std::string table(const StudyPlan &plan, const StudiedParameter &parameter, const ParameterErrors &errors) {
  std::vector<std::vector<std::string>> rows{{parameter.name, "seeds", "strength, %", "strain, %", "E, %",
                                              "broken, %", "residual", "kinetic", "steps", "seconds"}};
  for (std::size_t v = 0; v < parameter.values.size(); ++v) {
    const ValueErrors &of = errors.values[v];
    const bool reference = v + 1 == parameter.values.size();
    std::vector<std::string> row{with_unit(parameter, parameter.values[v]), compared(of, plan.seeds.size())};
    for (const Measure m : all_measures)
      row.push_back(!reference ? short_text_of(of.of(m), percent)
                    : std::isnan(errors.scatter_of(m))
                        ? "-"
                        : fmt::format("({:.2g})", errors.scatter_of(m) / percent));
    row.push_back(of.residual.count() == 0 ? "-" : fmt::format("{:.1e}", of.residual.mean()));
    row.push_back(of.kinetic.count() == 0 ? "-" : fmt::format("{:.1e}", of.kinetic.mean()));
    row.push_back(of.steps.count() == 0 ? "-" : fmt::format("{:.0f}", of.steps.mean()));
    row.push_back(short_text_of(of.seconds, 1));
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

// "strength: 5 % costs 3.1 s (0.9), 1 % costs 6.2 s (0.4); 0.1 % not reached: 0.4 % at 0.2, 12 s".
std::string price(const StudiedParameter &parameter, const ParameterErrors &errors, Measure measure) {
  std::string reached, missed;
  for (const double bound : bounds) {
    const auto found = cheapest_within(errors, measure, bound);
    if (found)
      reached += fmt::format("{} {:g} % costs {} ({})", reached.empty() ? "" : ",", bound / percent,
                             seconds_text(errors.values[*found].seconds),
                             with_unit(parameter, parameter.values[*found]));
    else
      missed += fmt::format("{}{:g} %", missed.empty() ? "" : ", ", bound / percent);
  }
  const std::size_t finest = errors.values.size() - 2;
  const double error = errors.values[finest].of(measure).root_mean_square();
  if (!missed.empty())
    reached += fmt::format("{} {} not reached: {} % at {}, {}", reached.empty() ? "" : ";", missed,
                           std::isnan(error) ? "?" : fmt::format("{:.2g}", error / percent),
                           with_unit(parameter, parameter.values[finest]),
                           seconds_text(errors.values[finest].seconds));
  return fmt::format("  {}:{}\n", measure == Measure::modulus ? "E" : word(measure), reached);
}

} // namespace

const char *word(Measure measure) {
  return measure_words[static_cast<std::size_t>(measure)];
}

void Accuracy::add(const TestRun &run, const RunOutcome &outcome) {
  const auto number = [&](const char *key) { return number_in(outcome.summary, key); };
  const bool peaked = StudyTables::peaked(outcome.summary);
  cases_[run.of].push_back(
      {word(outcome),
       {peaked ? number("strength_pa") : not_given, peaked ? number("strain_at_peak_platen") : not_given,
        peaked ? number("youngs_modulus_gauge_pa") : not_given,
        number("broken_tension") + number("broken_shear")},
       number("energy_residual_relative"),
       number("kinetic_to_internal_max"),
       number("steps"),
       number("wall_seconds")});
}

double Accuracy::error(const StudiedParameter &parameter, std::size_t value, std::size_t seed,
                       std::size_t measure) const {
  const auto measured = [&](const StudiedParameter::Value &v) {
    return cases_[v.of_case][seed].measures[measure];
  };
  const double reference = measured(parameter.values.back());
  return reference == 0 ? not_given : measured(parameter.values[value]) / reference - 1;
}

std::vector<ParameterErrors> Accuracy::errors() const {
  std::vector<ParameterErrors> all;
  for (const StudiedParameter &parameter : plan_.parameters) {
    ParameterErrors of;
    for (std::size_t m = 0; m < measure_count; ++m) {
      SeedStatistics reference;
      for (const Run &run : cases_[parameter.values.back().of_case])
        reference.add(run.measures[m]);
      of.scatter[m] = reference.deviation() / reference.mean();
    }
    for (std::size_t v = 0; v < parameter.values.size(); ++v) {
      ValueErrors errors;
      const std::vector<Run> &runs = cases_[parameter.values[v].of_case];
      for (std::size_t seed = 0; seed < runs.size(); ++seed) {
        for (std::size_t m = 0; m < measure_count; ++m)
          errors.errors[m].add(error(parameter, v, seed, m));
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
  for (const StudiedParameter &parameter : plan_.parameters)
    for (std::size_t v = 0; v < parameter.values.size(); ++v)
      for (std::size_t seed = 0; seed < plan_.seeds.size(); ++seed) {
        const StudiedParameter::Value &value = parameter.values[v];
        const Run &run = cases_[value.of_case][seed];
        std::vector<CsvCell> cells{parameter.name, value.text, plan_.cases[value.of_case].name,
                                   plan_.seeds[seed], run.status};
        for (std::size_t m = 0; m < measure_count; ++m)
          cells.emplace_back(error(parameter, v, seed, m));
        cells.insert(cells.end(), {run.residual, run.kinetic, run.steps});
        rows.row(cells);
      }
  rows.finish();
}

std::optional<std::size_t> cheapest_within(const ParameterErrors &of, Measure measure, double bound) {
  std::optional<std::size_t> cheapest;
  const std::size_t seeds = of.values.back().of(measure).count();
  for (std::size_t v = of.values.size() - 1; v-- > 0;) {
    const SeedStatistics &error = of.values[v].of(measure);
    if (error.count() < seeds || !(error.root_mean_square() <= bound)) break;
    if (!cheapest || of.values[v].seconds.mean() < of.values[*cheapest].seconds.mean()) cheapest = v;
  }
  return cheapest;
}

Json json_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors) {
  Json all = Json::array();
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    const StudiedParameter &parameter = plan.parameters[k];
    Json one{{"knob", parameter.name},
             {"entry", parameter.entry},
             {"unit", parameter.unit},
             {"ordered", parameter.ordered}};
    one["reference"] = parameter.values.back().text;
    for (const Measure m : all_measures)
      one["scatter_of_seeds"][word(m)] = errors[k].scatter_of(m);
    one["values"] = Json::array();
    for (std::size_t v = 0; v < parameter.values.size(); ++v) {
      const ValueErrors &of = errors[k].values[v];
      Json value{{"value", parameter.values[v].text},
                 {"number", parameter.values[v].number},
                 {"case", plan.cases[parameter.values[v].of_case].name}};
      for (const Measure m : all_measures)
        value["errors"][word(m)] = statistics(of.of(m));
      value["energy_residual_relative"] = statistics(of.residual);
      value["kinetic_to_internal_max"] = statistics(of.kinetic);
      value["steps"] = statistics(of.steps);
      one["values"].push_back(std::move(value));
    }
    all.push_back(std::move(one));
  }
  return all;
}

Json costs_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors) {
  Json costs{{"wall_seconds", Json::array()}, {"prices", Json::array()}};
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    const StudiedParameter &parameter = plan.parameters[k];
    for (std::size_t v = 0; v < parameter.values.size(); ++v) {
      Json seconds{{"knob", parameter.name}, {"value", parameter.values[v].text}};
      seconds.update(statistics(errors[k].values[v].seconds));
      costs["wall_seconds"].push_back(std::move(seconds));
    }
    for (const Measure m : priced)
      for (const double bound : bounds) {
        if (!parameter.ordered) continue;
        const auto found = cheapest_within(errors[k], m, bound);
        Json price{{"knob", parameter.name}, {"of", word(m)}, {"within", bound}};
        price["value"] = found ? Json(parameter.values[*found].text) : Json();
        price["seconds"] = found ? Json(errors[k].values[*found].seconds.mean()) : Json();
        costs["prices"].push_back(std::move(price));
      }
  }
  return costs;
}

std::string text_of(const StudyPlan &plan, const std::vector<ParameterErrors> &errors) {
  std::string text;
  for (std::size_t k = 0; k < plan.parameters.size(); ++k) {
    text += table(plan, plan.parameters[k], errors[k]);
    if (plan.parameters[k].ordered)
      for (const Measure m : priced)
        text += price(plan.parameters[k], errors[k], m);
    text += '\n';
  }
  return text +
         "  errors: mean +- standard deviation over the seeds, of fewer than five their range, each against "
         "the "
         "reference (last row) on its own seed.\n  In brackets: standard deviation of the reference's seeds; "
         "what is below it is lost among "
         "specimens.\n"
         "  \"1 % costs\": root mean square over the seeds, of that value and of all finer ones. Wall clock, "
         "a "
         "run\n";
}

} // namespace platen::apps
