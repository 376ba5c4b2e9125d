#include "apps/calibrate/found_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/output/csv_writer.h"

namespace platen::apps {
namespace {

template <class Item, class Text>
std::vector<std::string> texts_of(const std::vector<Item> &items, const Text &text) {
  std::vector<std::string> all;
  for (const Item &item : items)
    all.push_back(text(item));
  return all;
}

// A table of parameters with a name for each column, which may begin with its own number, "(2) strength".
std::string matrix_text(const std::vector<ParameterFacts> &rows, const std::vector<std::string> &columns,
                        const Eigen::MatrixXd &numbers) {
  std::string text = fmt::format("  {:<30}", ""), names;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const bool numbered = columns[k].front() == '(';
    const std::string name = numbered ? columns[k] : fmt::format("({}) {}", k + 1, columns[k]);
    text += fmt::format(" {:>7}", name.substr(0, name.find(' ')));
    names += "    " + name + "\n";
  }
  text += "\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    text += fmt::format("  {:<30}", rows[r].words);
    for (std::size_t k = 0; k < columns.size(); ++k)
      text += fmt::format(" {:>+7.2f}", numbers(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)));
    text += "\n";
  }
  return text + names;
}

// A row a parameter: {"parameter": "stiffness ratio", COLUMN: number, ...}.
Json json_of(const std::vector<ParameterFacts> &rows, const std::vector<std::string> &columns,
             const Eigen::MatrixXd &numbers) {
  Json all = Json::array();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Json row;
    row["parameter"] = rows[r].column;
    for (std::size_t k = 0; k < columns.size(); ++k)
      row[columns[k]] = numbers(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k));
    all.push_back(row);
  }
  return all;
}

Json json_of(const Goals &goals, const Measured &m) {
  Json all = Json::object();
  if (m.numbers.empty()) return all;
  for (std::size_t k = 0; k < goals.all().size(); ++k)
    all[goals.all()[k].key] = json_of(m.numbers[k], "seeds");
  all["youngs_modulus_platen_pa"] = json_of(m.platen_modulus, "seeds");
  all["failed"] = m.failed;
  return all;
}

Json json_of(const Goals &goals, std::size_t k, const Judged &judged) {
  const Goal &goal = goals.all()[k];
  Json one{{"key", goal.key},
           {"name", goal.name},
           {"target", goal.text},
           {"wanted", goal.curve ? 0 : goal.value},
           {"tolerance", goal.tolerance},
           {"training", json_of(judged.training.numbers[k], "seeds")},
           {"training_miss", goals.miss(k, judged.training)},
           {"met_in_training", goals.met(k, judged.training)}};
  if (!judged.verified()) return one;
  one["verification"] = json_of(judged.unseen.numbers[k], "seeds");
  one["verification_miss"] = goals.miss(k, judged.unseen);
  one["met"] = goals.met(k, judged.unseen);
  return one;
}

} // namespace

std::string wishes(const Goals &goals) {
  std::string text;
  for (const std::size_t k : goals.wanted())
    text += fmt::format("  target {}: {} (tolerance {:.3g} %)\n", goals.all()[k].number, goals.all()[k].text,
                        100 * goals.all()[k].tolerance);
  return text;
}

std::string measured_text(const Goals &goals, std::size_t k, const Measured &m) {
  const Goal &goal = goals.all()[k];
  if (!goal.curve) return text_of(m.numbers[k], goal.unit());
  const double miss = goals.miss(k, m); // of the mean of the packings
  return std::isnan(miss) ? "-" : fmt::format("{:.4g}", miss);
}

std::string table_of(const Goals &goals, const Judged &judged) {
  const auto row = [](const std::string &name, const std::string &target, const std::string &training,
                      const std::string &unseen, const std::string &off) {
    return fmt::format("  {:<30} {:>8} {:>26} {:>26} {:>10}\n", name, target, training, unseen, off);
  };
  std::string text = row("", "target", "calibrated on", "unseen packings", "off");
  for (std::size_t k = 0; k < goals.all().size(); ++k) {
    const Goal &goal = goals.all()[k];
    const double miss = goal.wanted() ? goals.miss(k, judged.last()) : not_given;
    text += row(
        goal.words(), goal.wanted() ? fmt::format("{:.4g}", goal.curve ? 0 : goal.value / goal.unit()) : "-",
        measured_text(goals, k, judged.training),
        judged.verified() ? measured_text(goals, k, judged.unseen) : "-",
        std::isnan(miss) ? ""
                         : fmt::format("{:+.1f} %{}", 100 * miss, goals.met(k, judged.last()) ? "" : " *"));
  }
  return text;
}

std::vector<std::string> gaps(const Goals &goals, const Judged &judged) {
  constexpr double worth_a_factor = 1.5;
  const Measured &by = judged.last();
  std::vector<std::string> lines;
  for (const std::size_t k : goals.wanted()) {
    if (goals.met(k, by)) continue;
    const Goal &goal = goals.all()[k];
    const double miss = goals.miss(k, by), got = by.numbers[k].mean(), factor = got / goal.value;
    std::string off;
    if (std::isnan(miss))
      off = "was not measured";
    else if (goal.curve)
      off = fmt::format("off by {:.3g} % of its largest stress (root mean square: {})", 100 * miss,
                        branches_of_curve(*goal.curve, by.curves[k]));
    else
      off = fmt::format("target {:.4g}, calibrated {:.4g}, off by {:+.3g} %", goal.value / goal.unit(),
                        got / goal.unit(), 100 * miss);
    if (factor > worth_a_factor || (factor > 0 && factor < 1 / worth_a_factor))
      off += fmt::format(" (a factor of {:.3g})", std::max(factor, 1 / factor));
    lines.push_back(fmt::format("{}: {}, tolerance {:.3g} %", goal.words(), off, 100 * goal.tolerance));
  }
  return lines;
}

std::string findings(const Goals &goals, const Judged &judged) {
  const Sensitivities &at = judged.found.sensitivities;
  const Analysis &a = judged.analysis;
  const auto words = texts_of(at.free, [](const ParameterFacts &parameter) { return parameter.words; });
  std::string text = fmt::format(
      "  d ln target / d ln parameter, {}:\n",
      at.measured ? "by differences and trials" : "that of one concrete, corrected by the trials");
  text += matrix_text(at.free, texts_of(at.goals, [&](std::size_t k) { return goals.all()[k].words(); }),
                      a.sensitivities) +
          "  correlations of the parameters:\n" + matrix_text(at.free, words, a.correlations);
  for (const auto &[what, lines] : {std::pair{"hardly told apart", a.correlated},
                                    {"not determined by the targets", a.undetermined},
                                    {"not met together", a.missed},
                                    {"at its bound", judged.found.at_bounds}})
    for (const std::string &line : lines)
      text += fmt::format("{}: {}\n", what, line);
  return text;
}

void tell_found(const Goals &goals, const Judged &judged, Json &s) {
  const Sensitivities &at = judged.found.sensitivities;
  const Analysis &a = judged.analysis;
  for (const ParameterFacts &parameter : parameter_facts(goals.asked()))
    if (parameter.parameter != FreeParameter::poisson_ratio)
      s["found"][parameter.column] = judged.found.choice[parameter.parameter];
  s["training"] = json_of(goals, judged.training);
  s["verification"] = json_of(goals, judged.unseen);
  s["targets"] = Json::array();
  for (const std::size_t k : goals.wanted())
    s["targets"].push_back(json_of(goals, k, judged));
  const Json by = json_of(goals, judged.last());
  for (const auto &[key, of] : {std::pair{"youngs_modulus_gauge_pa", "youngs_modulus_gauge_pa"},
                                {"youngs_modulus_platen_pa", "youngs_modulus_platen_pa"},
                                {"poisson_ratio", "poisson_ratio"},
                                {"strength_pa", "compressive_strength_pa"},
                                {"tensile_strength_pa", "tensile_strength_pa"},
                                {"triaxial_strength_pa", "triaxial_strength_pa"}})
    s[key] = number_in(by, std::string(of) + "/mean");
  s["strength_trials"] = judged.found.trials;
  const auto columns = texts_of(at.free, [](const ParameterFacts &parameter) { return parameter.column; });
  s["sensitivities_measured"] = at.measured;
  s["sensitivities"] = json_of(at.free, texts_of(at.goals, [&](std::size_t k) { return goals.all()[k].key; }),
                               a.sensitivities);
  s["correlations"] = json_of(at.free, columns, a.correlations);
  s["correlated"] = a.correlated;
  s["undetermined"] = a.undetermined;
  s["targets_missed"] = gaps(goals, judged);
  s["missed"] = a.missed;
  s["at_bounds"] = judged.found.at_bounds;
}

void write_curves(const Goals &goals, const Judged &judged, const OutputPaths &paths) {
  int count = 0;
  for (std::size_t k = 0; k < goals.all().size(); ++k) {
    if (!goals.all()[k].curve) continue;
    const Curve &curve = *goals.all()[k].curve;
    const std::string name = ++count == 1 ? "curve.csv" : fmt::format("curve_{}.csv", count);
    WholeTable table(paths.folder / name, {curve.of_gauge ? "strain_gauge" : "strain_platen", "wanted_pa",
                                           "calibrated_pa", "unseen_pa"});
    const auto at = [&](const Measured &m, std::size_t point) {
      return m.curves.empty() || m.curves[k].empty() ? not_given : m.curves[k][point];
    };
    for (std::size_t point = 0; point < curve_points; ++point)
      table.row({Curve::strain_of(point + 1, curve.last_strain()), curve.sampled()[point],
                 at(judged.training, point), at(judged.unseen, point)});
    table.finish();
  }
}

} // namespace platen::apps
