// What a study of accuracy leaves in study.json and on the screen.
#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "apps/study/accuracy.h"
#include "apps/study/tables.h"

namespace platen::apps {
namespace {

constexpr double percent = 0.01;
constexpr Measure all_measures[] = {Measure::strength, Measure::strain_at_peak, Measure::modulus,
                                    Measure::broken_bonds};
constexpr Measure priced[] = {Measure::strength, Measure::modulus};
constexpr double bounds[] = {0.05, 0.02, 0.01, 0.001};

Json statistics(const SeedStatistics &s) {
  return {{"mean", s.mean()},
          {"deviation", s.deviation()},
          {"root_mean_square", s.root_mean_square()},
          {"runs", s.count()}};
}

std::string with_unit(const Knob &knob, const Knob::Value &value) {
  return value.text + (knob.unit.empty() ? "" : " " + knob.unit);
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

std::string table(const StudyPlan &plan, const Knob &knob, const KnobErrors &errors) {
  std::vector<std::vector<std::string>> rows{{knob.name, "seeds", "strength, %", "strain, %", "E, %",
                                              "broken, %", "residual", "kinetic", "steps", "seconds"}};
  for (std::size_t v = 0; v < knob.values.size(); ++v) {
    const ValueErrors &of = errors.values[v];
    const bool reference = v + 1 == knob.values.size();
    std::vector<std::string> row{with_unit(knob, knob.values[v]), compared(of, plan.seeds.size())};
    for (const Measure m : all_measures)
      row.push_back(!reference ? text_of(of.of(m), percent)
                    : std::isnan(errors.scatter_of(m))
                        ? "-"
                        : fmt::format("({:.2g})", errors.scatter_of(m) / percent));
    row.push_back(of.residual.count() == 0 ? "-" : fmt::format("{:.1e}", of.residual.mean()));
    row.push_back(of.kinetic.count() == 0 ? "-" : fmt::format("{:.1e}", of.kinetic.mean()));
    row.push_back(of.steps.count() == 0 ? "-" : fmt::format("{:.0f}", of.steps.mean()));
    row.push_back(text_of(of.seconds, 1));
    rows.push_back(std::move(row));
  }
  return aligned(rows);
}

// "strength: 5 % costs 3.1 s (0.9), 1 % costs 6.2 s (0.4); 0.1 % not reached: 0.4 % at 0.2, 12 s".
std::string price(const Knob &knob, const KnobErrors &errors, Measure measure) {
  std::string reached, missed;
  for (const double bound : bounds) {
    const auto found = cheapest_within(errors, measure, bound);
    if (found)
      reached +=
          fmt::format("{} {:g} % costs {} ({})", reached.empty() ? "" : ",", bound / percent,
                      seconds_text(errors.values[*found].seconds), with_unit(knob, knob.values[*found]));
    else
      missed += fmt::format("{}{:g} %", missed.empty() ? "" : ", ", bound / percent);
  }
  const std::size_t finest = errors.values.size() - 2;
  const double error = errors.values[finest].of(measure).root_mean_square();
  if (!missed.empty())
    reached += fmt::format("{} {} not reached: {} % at {}, {}", reached.empty() ? "" : ";", missed,
                           std::isnan(error) ? "?" : fmt::format("{:.2g}", error / percent),
                           with_unit(knob, knob.values[finest]), seconds_text(errors.values[finest].seconds));
  return fmt::format("  {}:{}\n", measure == Measure::modulus ? "E" : word(measure), reached);
}

} // namespace

Json json_of(const StudyPlan &plan, const std::vector<KnobErrors> &errors) {
  Json all = Json::array();
  for (std::size_t k = 0; k < plan.knobs.size(); ++k) {
    const Knob &knob = plan.knobs[k];
    Json one{{"knob", knob.name}, {"entry", knob.entry}, {"unit", knob.unit}, {"ordered", knob.ordered}};
    one["reference"] = knob.values.back().text;
    for (const Measure m : all_measures)
      one["scatter_of_seeds"][word(m)] = errors[k].scatter_of(m);
    one["values"] = Json::array();
    for (std::size_t v = 0; v < knob.values.size(); ++v) {
      const ValueErrors &of = errors[k].values[v];
      Json value{{"value", knob.values[v].text},
                 {"number", knob.values[v].number},
                 {"case", plan.cases[knob.values[v].of_case].name}};
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

Json costs_of(const StudyPlan &plan, const std::vector<KnobErrors> &errors) {
  Json costs{{"wall_seconds", Json::array()}, {"prices", Json::array()}};
  for (std::size_t k = 0; k < plan.knobs.size(); ++k) {
    const Knob &knob = plan.knobs[k];
    for (std::size_t v = 0; v < knob.values.size(); ++v) {
      Json seconds{{"knob", knob.name}, {"value", knob.values[v].text}};
      seconds.update(statistics(errors[k].values[v].seconds));
      costs["wall_seconds"].push_back(std::move(seconds));
    }
    for (const Measure m : priced)
      for (const double bound : bounds) {
        if (!knob.ordered) continue;
        const auto found = cheapest_within(errors[k], m, bound);
        Json price{{"knob", knob.name}, {"of", word(m)}, {"within", bound}};
        price["value"] = found ? Json(knob.values[*found].text) : Json();
        price["seconds"] = found ? Json(errors[k].values[*found].seconds.mean()) : Json();
        costs["prices"].push_back(std::move(price));
      }
  }
  return costs;
}

std::string text_of(const StudyPlan &plan, const std::vector<KnobErrors> &errors) {
  std::string text;
  for (std::size_t k = 0; k < plan.knobs.size(); ++k) {
    text += table(plan, plan.knobs[k], errors[k]);
    if (plan.knobs[k].ordered)
      for (const Measure m : priced)
        text += price(plan.knobs[k], errors[k], m);
    text += '\n';
  }
  return text +
         "  errors: mean +- standard deviation over the seeds, each against the reference (last row) on its "
         "own seed.\n  In brackets: scatter of the reference's seeds; what is below it is lost among "
         "specimens.\n"
         "  \"1 % costs\": root mean square over the seeds, of that value and of all finer ones. Wall clock, "
         "a "
         "run\n";
}

} // namespace platen::apps
