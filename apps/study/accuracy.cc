#include "apps/study/accuracy.h"

#include <fmt/format.h>

#include <cmath>

#include "apps/scene/units.h"

namespace platen::apps {
namespace {

constexpr double percent = 0.01;
constexpr Measure priced[] = {Measure::strength, Measure::modulus};
constexpr const char *figures_of_run[] = {"energy_residual_relative", "kinetic_to_internal_max", "steps"};
constexpr double bounds[] = {0.05, 0.02, 0.01, 0.001};

const char *word(Measure measure) {
  constexpr const char *words[] = {"strength", "strain_at_peak", "modulus", "broken_bonds"};
  return words[static_cast<std::size_t>(measure)];
}

double measured(const RunOutcome &run, Measure measure) {
  const auto number = [&](const char *key) { return number_in(run.summary, key); };
  if (measure == Measure::broken_bonds) return number("broken_tension") + number("broken_shear");
  constexpr const char *keys[] = {"strength_pa", "strain_at_peak_platen", "youngs_modulus_gauge_pa"};
  return has_peaked(run.summary) ? number(keys[static_cast<std::size_t>(measure)]) : not_given;
}

// Of a run against that of the reference on the same seed.
double error(const RunOutcome &run, const RunOutcome &reference, Measure measure) {
  const double exact = measured(reference, measure);
  return exact == 0 ? not_given : measured(run, measure) / exact - 1;
}

// As for other figures, and the root of their mean square.
Json with_root(const SeedStatistics &s) {
  Json of = json_of(s, "runs");
  of.erase("runs");
  of["root_mean_square"] = s.root_mean_square();
  of["runs"] = s.count();
  return of;
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
    for (const SeedStatistics &number : of.numbers)
      row.push_back(number.count() == 0             ? "-"
                    : &number == &of.numbers.back() ? fmt::format("{:.0f}", number.mean())
                                                    : fmt::format("{:.1e}", number.mean()));
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

std::vector<ParameterErrors> errors_of(const StudyPlan &plan, const Outcomes &outcomes) {
  std::vector<ParameterErrors> all;
  for (const StudiedParameter &parameter : plan.parameters) {
    const std::vector<RunOutcome> &references = outcomes[parameter.values.back().of_case];
    ParameterErrors of;
    for (const StudiedParameter::Value &value : parameter.values) {
      ValueErrors errors;
      for (std::size_t seed = 0; seed < references.size(); ++seed) {
        const RunOutcome &run = outcomes[value.of_case][seed];
        for (const Measure m : all_measures)
          errors.errors[static_cast<std::size_t>(m)].add(error(run, references[seed], m));
        for (std::size_t k = 0; k < std::size(figures_of_run); ++k)
          errors.numbers[k].add(number_in(run.summary, figures_of_run[k]));
        errors.seconds.add(number_in(run.summary, "wall_seconds"));
      }
      of.values.push_back(std::move(errors));
    }
    for (const Measure m : all_measures) {
      SeedStatistics reference;
      for (const RunOutcome &run : references)
        reference.add(measured(run, m));
      of.scatter[static_cast<std::size_t>(m)] = reference.deviation() / reference.mean();
    }
    all.push_back(std::move(of));
  }
  return all;
}

void write_errors(const std::filesystem::path &csv, const StudyPlan &plan, const Outcomes &outcomes) {
  std::vector<std::string> columns{"knob", "value", "case", "seed", "status"};
  for (const Measure m : all_measures)
    columns.push_back(std::string(word(m)) + "_error");
  columns.insert(columns.end(), std::begin(figures_of_run), std::end(figures_of_run));
  WholeTable rows(csv, columns);
  for (const StudiedParameter &parameter : plan.parameters)
    for (const StudiedParameter::Value &value : parameter.values)
      for (std::size_t seed = 0; seed < plan.seeds.size(); ++seed) {
        const RunOutcome &run = outcomes[value.of_case][seed],
                         &reference = outcomes[parameter.values.back().of_case][seed];
        Json cells{parameter.name, value.text, plan.cases[value.of_case].name, plan.seeds[seed], word(run)};
        for (const Measure m : all_measures)
          cells.push_back(error(run, reference, m));
        for (const char *key : figures_of_run)
          cells.push_back(number_in(run.summary, key));
        write_row(rows, cells);
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
        value["errors"][word(m)] = with_root(of.of(m));
      for (std::size_t n = 0; n < std::size(figures_of_run); ++n)
        value[figures_of_run[n]] = with_root(of.numbers[n]);
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
      seconds.update(with_root(errors[k].values[v].seconds));
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
