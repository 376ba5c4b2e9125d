#include "apps/calibrate/found_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/calibrate/calibrate_section.h"
#include "apps/output/csv_writer.h"

namespace platen::apps {
namespace {

std::string row_of(const Goals &goals, std::size_t k, const Judged &judged) {
  const Goal &goal = goals.all()[k];
  const double wanted = goal.curve ? 0 : goal.target.value;
  const std::string goal_text = goal.wanted() ? fmt::format("{:.4g}", wanted / goal.unit) : "-";
  const Measured &by = judged.verified() ? judged.unseen : judged.training;
  const double off = goal.wanted() ? goals.miss(k, by) : not_given;
  const std::string verdict =
      std::isnan(off) ? "" : fmt::format("{:+.1f} %{}", 100 * off, goals.met(k, by) ? "" : " *");
  // Of a curve what it is judged by: how far the mean of the packings is off.
  const auto text = [&](const Measured &m) {
    if (!goal.curve) return text_of(m.numbers[k], goal.unit);
    const double miss = goals.miss(k, m);
    return std::isnan(miss) ? std::string("-") : fmt::format("{:.4g}", miss);
  };
  return fmt::format("  {:<30} {:>8} {:>26} {:>26} {:>10}\n", goal.words, goal_text, text(judged.training),
                     judged.verified() ? text(judged.unseen) : "-", verdict);
}

// A square or oblong table with a name for each row and column.
std::string matrix_text(const std::vector<std::string> &rows, const std::vector<std::string> &columns,
                        const Eigen::MatrixXd &numbers) {
  std::string text = fmt::format("  {:<30}", "");
  for (std::size_t k = 0; k < columns.size(); ++k)
    text += fmt::format(" {:>7}", fmt::format("({})", k + 1));
  text += "\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += fmt::format("  {:<30}", rows[r]);
    for (std::size_t k = 0; k < columns.size(); ++k)
      text += fmt::format(" {:>+7.2f}", numbers(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)));
    text += "\n";
  }
  for (std::size_t k = 0; k < columns.size(); ++k)
    text += fmt::format("    ({}) {}\n", k + 1, columns[k]);
  return text;
}

std::vector<std::string> words_of(const Calibrate &asked, const std::vector<FreeParameter> &free) {
  std::vector<std::string> words;
  for (const FreeParameter parameter : free)
    words.push_back(facts_of(asked, parameter).words);
  return words;
}

std::string listed(const char *what, const std::vector<std::string> &lines) {
  std::string text;
  for (const std::string &line : lines)
    text += fmt::format("{}: {}\n", what, line);
  return text;
}

Json json_of(const SeedStatistics &scatter) {
  return {{"mean", scatter.mean()},
          {"deviation", scatter.deviation()},
          {"low", scatter.least()},
          {"high", scatter.largest()},
          {"seeds", scatter.count()}};
}

Json json_of(const Goals &goals, const Measured &m) {
  Json all = Json::object();
  if (m.numbers.empty()) return all;
  for (std::size_t k = 0; k < goals.all().size(); ++k)
    all[goals.all()[k].key] = json_of(m.numbers[k]);
  all["youngs_modulus_platen_pa"] = json_of(m.platen_modulus);
  all["failed"] = m.failed;
  return all;
}

Json json_of(const Goals &goals, std::size_t k, const Judged &judged) {
  const Goal &goal = goals.all()[k];
  Json one;
  one["key"] = goal.key;
  one["name"] = goal.target.name();
  one["target"] = goal.target.text;
  one["wanted"] = goal.curve ? 0 : goal.target.value;
  one["tolerance"] = goal.target.tolerance;
  one["training"] = json_of(judged.training.numbers[k]);
  one["training_miss"] = goals.miss(k, judged.training);
  one["met_in_training"] = goals.met(k, judged.training);
  if (!judged.verified()) return one;
  one["verification"] = json_of(judged.unseen.numbers[k]);
  one["verification_miss"] = goals.miss(k, judged.unseen);
  one["met"] = goals.met(k, judged.unseen);
  return one;
}

// A row a parameter: {"parameter": "stiffness ratio", COLUMN: number, ...}.
Json json_of(const Calibrate &asked, const std::vector<FreeParameter> &free,
             const std::vector<std::string> &columns, const Eigen::MatrixXd &numbers) {
  Json rows = Json::array();
  for (std::size_t r = 0; r < free.size(); ++r) {
    Json row;
    row["parameter"] = facts_of(asked, free[r]).column;
    for (std::size_t k = 0; k < columns.size(); ++k)
      row[columns[k]] = numbers(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k));
    rows.push_back(row);
  }
  return rows;
}

} // namespace

std::string wishes(const Goals &goals) {
  std::string text;
  for (const std::size_t k : goals.wanted()) {
    const Goal &goal = goals.all()[k];
    if (goal.target.number > 0)
      text += fmt::format("  target {}: {} (tolerance {:.3g} %)\n", goal.target.number, goal.target.text,
                          100 * goal.target.tolerance);
    else
      text += fmt::format("  target: {} {:.5g} (tolerance {:.3g} %)\n", goal.words,
                          goal.target.value / goal.unit, 100 * goal.target.tolerance);
  }
  return text;
}

std::string table_of(const Goals &goals, const Judged &judged) {
  std::string text = fmt::format("  {:<30} {:>8} {:>26} {:>26} {:>10}\n", "", "target", "calibrated on",
                                 "unseen packings", "off");
  for (std::size_t k = 0; k < goals.all().size(); ++k)
    text += row_of(goals, k, judged);
  return text;
}

std::vector<std::string> gaps(const Goals &goals, const Judged &judged) {
  const Measured &by = judged.verified() ? judged.unseen : judged.training;
  std::vector<std::string> lines;
  for (const std::size_t k : goals.wanted()) {
    if (goals.met(k, by)) continue;
    const Goal &goal = goals.all()[k];
    const double miss = goals.miss(k, by), got = by.numbers[k].mean(),
                 wanted = goal.curve ? 0 : goal.target.value;
    const std::string tolerance = fmt::format("tolerance {:.3g} %", 100 * goal.target.tolerance);
    if (std::isnan(miss)) {
      lines.push_back(fmt::format("{}: was not measured, {}", goal.words, tolerance));
    } else if (goal.curve) {
      lines.push_back(fmt::format("{}: off by {:.3g} % of its largest stress (root mean square: {}), {}",
                                  goal.words, 100 * miss, branches_of_curve(*goal.curve, by.curves[k]),
                                  tolerance));
    } else {
      const double factor = got / wanted;
      constexpr double worth_a_factor = 1.5;
      const bool far = factor > worth_a_factor || (factor > 0 && factor < 1 / worth_a_factor);
      lines.push_back(fmt::format(
          "{}: target {:.4g}, calibrated {:.4g}, off by {:+.3g} %{}, {}", goal.words, wanted / goal.unit,
          got / goal.unit, 100 * miss,
          far ? fmt::format(" (a factor of {:.3g})", std::max(factor, 1 / factor)) : "", tolerance));
    }
  }
  return lines;
}

std::string findings(const Goals &goals, const Scene &scene, const Judged &judged) {
  const Sensitivities &at = judged.found.sensitivities;
  const Analysis a = analyse(goals, calibrate_of(scene).tolerance, at);
  std::vector<std::string> targets;
  for (const std::size_t k : at.goals)
    targets.push_back(goals.all()[k].words);
  const std::vector<std::string> free = words_of(goals.asked(), at.free);
  std::string text = fmt::format(
      "  d ln target / d ln parameter, {}:\n",
      at.measured ? "by differences and trials" : "that of one concrete, corrected by the trials");
  text += matrix_text(free, targets, a.sensitivities);
  text += "  correlations of the parameters:\n" + matrix_text(free, free, a.correlations);
  text += listed("hardly told apart", a.correlated);
  text += listed("not determined by the targets", a.undetermined);
  text += listed("not met together", missed(goals, judged.found));
  text += listed("at its bound", judged.found.at_bounds);
  return text;
}

void tell_found(const Goals &goals, const Scene &scene, const Judged &judged, Json &s) {
  const Sensitivities &at = judged.found.sensitivities;
  const Analysis a = analyse(goals, calibrate_of(scene).tolerance, at);
  for (const ParameterFacts &parameter : parameter_facts(goals.asked()))
    if (parameter.parameter != FreeParameter::poisson_ratio)
      s["found"][parameter.column] = judged.found.choice[parameter.parameter];
  s["training"] = json_of(goals, judged.training);
  s["verification"] = json_of(goals, judged.unseen);
  s["targets"] = Json::array();
  for (const std::size_t k : goals.wanted())
    s["targets"].push_back(json_of(goals, k, judged));
  const Json by = s[judged.verified() ? "verification" : "training"]; // a copy: keys of s move
  const auto mean = [&](const char *key) {
    return by.contains(key) ? by[key]["mean"].get<double>() : not_given;
  };
  s["youngs_modulus_gauge_pa"] = mean("youngs_modulus_gauge_pa");
  s["youngs_modulus_platen_pa"] = mean("youngs_modulus_platen_pa");
  s["poisson_ratio"] = mean("poisson_ratio");
  s["strength_pa"] = mean("compressive_strength_pa");
  s["tensile_strength_pa"] = mean("tensile_strength_pa");
  s["triaxial_strength_pa"] = mean("triaxial_strength_pa");
  s["strength_trials"] = judged.found.trials;
  std::vector<std::string> columns, free;
  for (const std::size_t k : at.goals)
    columns.push_back(goals.all()[k].key);
  for (const FreeParameter parameter : at.free)
    free.push_back(facts_of(goals.asked(), parameter).column);
  s["sensitivities_measured"] = at.measured;
  s["sensitivities"] = json_of(goals.asked(), at.free, columns, a.sensitivities);
  s["correlations"] = json_of(goals.asked(), at.free, free, a.correlations);
  s["correlated"] = a.correlated;
  s["undetermined"] = a.undetermined;
  s["targets_missed"] = gaps(goals, judged);
  s["missed"] = missed(goals, judged.found);
  s["at_bounds"] = judged.found.at_bounds;
}

void write_curves(const Goals &goals, const Judged &judged, const OutputPaths &paths) {
  int count = 0;
  for (std::size_t k = 0; k < goals.all().size(); ++k) {
    const Goal &goal = goals.all()[k];
    if (!goal.curve) continue;
    const std::string name = ++count == 1 ? "curve.csv" : fmt::format("curve_{}.csv", count);
    WholeTable table(paths.folder / name, {goal.curve->of_gauge ? "strain_gauge" : "strain_platen",
                                           "wanted_pa", "calibrated_pa", "unseen_pa"});
    const std::vector<double> wanted = goal.curve->sampled();
    const auto at = [&](const Measured &m, std::size_t point) {
      return m.curves.empty() || m.curves[k].empty() ? not_given : m.curves[k][point];
    };
    for (std::size_t point = 0; point < curve_points; ++point)
      table.row({goal.curve->last_strain() * static_cast<double>(point + 1) / curve_points, wanted[point],
                 at(judged.training, point), at(judged.unseen, point)});
    table.finish();
  }
}

} // namespace platen::apps
